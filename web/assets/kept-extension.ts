/**
 * Extensions that nobody registered: what they say of nodes, meshes, materials and the like is carried through a document as it stands.
 * That can only be done where it points at nothing by number, since writing a document numbers its accessors and textures anew.
 */
import {
  type ExtensibleProperty,
  Extension,
  ExtensionProperty,
  type Nullable,
  PropertyType,
  type ReaderContext,
  type WriterContext,
} from '@gltf-transform/core';
import { asObject, type GltfJson } from './gltf-json.ts';
import type { GltfWarning } from './gltf-warnings.ts';
import { plainCopy } from './plain-copy.ts';

/** Names of things that glTF numbers, as they occur in the keys of extensions. */
const NUMBERED =
  /(accessor|buffer|view|texture|image|sampler|source|mesh|primitive|node|bone|joint|skin|skeleton|material|scene|camera|light|animation|channel|index|indices|attribute|target)/i;

/** Lists of the JSON whose members glTF-Transform keeps, and where its writer says which number each gets. */
const PLACES = {
  scenes: 'sceneIndexMap',
  nodes: 'nodeIndexMap',
  meshes: 'meshIndexMap',
  materials: 'materialIndexMap',
  skins: 'skinIndexMap',
  cameras: 'cameraIndexMap',
  animations: 'animationIndexMap',
  accessors: 'accessorIndexMap',
  images: 'imageIndexMap',
} as const;

interface IKeptProperty {
  name: string;
  extras: Record<string, unknown>;
  json: Record<string, unknown>;
}

abstract class KeptProperty extends ExtensionProperty<IKeptProperty> {
  declare readonly propertyType: 'HandlebodyKept';
  declare readonly parentTypes: PropertyType[];

  protected override getDefaults(): Nullable<IKeptProperty> {
    return Object.assign(super.getDefaults(), { json: {} });
  }

  getJson(): Record<string, unknown> {
    return this.get('json');
  }

  setJson(json: object): this {
    return this.set('json', plainCopy(json, this.extensionName));
  }
}

/** What all of them do; each has its name, which glTF-Transform looks for on the class. */
abstract class KeptExtension extends Extension {
  abstract createKept(): KeptProperty;

  override read(context: ReaderContext): this {
    const take = (owner: unknown, property: ExtensibleProperty | undefined) => {
      const said = asObject(asObject(asObject(owner)?.extensions)?.[this.extensionName]);
      if (said && property) property.setExtension(this.extensionName, this.createKept().setJson(said));
    };
    const { json } = context.jsonDoc;
    take(json, this.document.getRoot());
    for (const place of Object.keys(PLACES) as (keyof typeof PLACES)[]) {
      const properties: readonly ExtensibleProperty[] = context[place === 'images' ? 'textures' : place];
      (json[place] ?? []).forEach((owner, i) => {
        take(owner, properties[i]);
      });
    }
    (json.meshes ?? []).forEach(({ primitives }, i) => {
      for (const [k, property] of context.meshes[i]?.listPrimitives().entries() ?? []) take(primitives[k], property);
    });
    return this;
  }

  override write(context: WriterContext): this {
    const put = (owner: { extensions?: Record<string, unknown> } | undefined, property: ExtensibleProperty) => {
      const kept = property.getExtension<KeptProperty>(this.extensionName);
      if (kept && owner) owner.extensions = { ...owner.extensions, [this.extensionName]: kept.getJson() };
    };
    const { json } = context.jsonDoc;
    put(json, this.document.getRoot());
    for (const [place, map] of Object.entries(PLACES) as [keyof typeof PLACES, (typeof PLACES)[keyof typeof PLACES]][]) {
      for (const [property, index] of context[map]) put(json[place]?.[index], property);
    }
    for (const [mesh, index] of context.meshIndexMap) {
      for (const [k, primitive] of mesh.listPrimitives().entries()) put(json.meshes?.[index]?.primitives[k], primitive);
    }
    return this;
  }
}

/** A class of its own for an extension's name. */
function keptExtension(name: string): typeof Extension {
  class Property extends KeptProperty {
    static override readonly EXTENSION_NAME = name;
    declare readonly extensionName: string;

    protected override init(): void {
      const parentTypes = Object.values(PropertyType);
      Object.assign(this, { extensionName: name, propertyType: 'HandlebodyKept', parentTypes });
    }
  }
  class Kept extends KeptExtension {
    static override readonly EXTENSION_NAME = name;
    override readonly extensionName = name;

    createKept(): KeptProperty {
      return new Property(this.document.getGraph());
    }
  }
  return Kept as unknown as typeof Extension;
}

/** Extensions that keep the unknown ones as far as that goes; what cannot be kept is told. */
export function keepUnknown(json: GltfJson, names: readonly string[], tell: (warning: GltfWarning) => void): (typeof Extension)[] {
  const { lost, kept } = sortUnknown(json, names);
  if (lost.length > 0) {
    tell({
      code: 'extension-lost',
      message: `What the model says in ${lost.slice(0, NAMED).join(', ')}${lost.length > NAMED ? ` and ${lost.length - NAMED} more extensions` : ''} is not known here and gets lost.`,
      remedy: 'Apply such extensions after baking, if they leave the vertices alone.',
    });
  }
  return kept.map(keptExtension);
}

const KEPT_PATHS = new Set(['', ...Object.keys(PLACES).map((place) => `${place}/[]`), 'meshes/[]/primitives/[]']);

/** A file that names more than these is no model; each costs a look at everything. */
const MOST = 30;
/** As many names are told; one that every object has, such as "constructor", glTF-Transform cannot keep. */
const NAMED = 10;

/** An extension is lost whole where one of its uses would be: half of it may say the opposite. */
function sortUnknown(json: GltfJson, names: readonly string[]): { lost: string[]; kept: string[] } {
  const [asked, lost] = [new Set(names), new Set([...new Set(names)].filter((name, i) => i >= MOST || name in {}))];
  const visit = (value: unknown, path: readonly string[]) => {
    if (Array.isArray(value)) {
      for (const member of value) visit(member, [...path, '[]']);
      return;
    }
    for (const [key, member] of Object.entries(asObject(value) ?? {})) {
      if (key === 'extras') continue;
      visit(member, [...path, key]);
      if (key !== 'extensions') continue;
      const isPlace = KEPT_PATHS.has(path.join('/'));
      for (const [name, said] of Object.entries(asObject(member) ?? {})) {
        if (asked.has(name) && !(isPlace && asObject(said) && !pointsAtNumbers(said))) lost.add(name);
      }
    }
  };
  visit(json, []);
  return { lost: [...lost], kept: [...asked].filter((name) => !lost.has(name)) };
}

/** Whether whole numbers stand under the name of what glTF numbers, or a pointer ("/nodes/3/…") does. */
function pointsAtNumbers(value: unknown, key = ''): boolean {
  if (typeof value === 'string') return /^\/\w+\/\d/.test(value);
  if (typeof value === 'number') return Number.isInteger(value) && value >= 0 && NUMBERED.test(key);
  if (Array.isArray(value)) return value.some((member) => pointsAtNumbers(member, key));
  return Object.entries(asObject(value) ?? {}).some(([name, member]) => pointsAtNumbers(member, name));
}
