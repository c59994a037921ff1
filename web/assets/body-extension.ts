/** The glTF extension HANDLEBODY_body for glTF-Transform. What stands in the file: `schema.ts`. */
import {
  type Accessor,
  Extension,
  ExtensionProperty,
  type Nullable,
  PropertyType,
  type ReaderContext,
  WriterContext,
} from '@gltf-transform/core';
import { BODY_ACCESSORS, HANDLEBODY_BODY } from './schema.ts';

export interface IBodyProperty {
  name: string;
  extras: Record<string, unknown>;
  header: Record<string, unknown>;
  voxels: Accessor;
  centers: Accessor;
  order: Accessor;
  distances: Accessor;
  spheres: Accessor;
  sphereAxes: Accessor;
  skeletonNodes: Accessor;
  skeletonBranches: Accessor;
  sphereBranches: Accessor;
}

export type BodyAccessorName = keyof typeof BODY_ACCESSORS;

const NAMES = Object.keys(BODY_ACCESSORS) as BodyAccessorName[];

/**
 * A baked body in a glTF-Transform document. Use `attachBody` and `readBody`, which check what they handle.
 *
 * ```ts
 * await attachBody(document, body);
 * const property = document.getRoot().getExtension<BodyProperty>('HANDLEBODY_body');
 * property?.getAccessor('centers')?.getCount();
 * ```
 */
export class BodyProperty extends ExtensionProperty<IBodyProperty> {
  static override readonly EXTENSION_NAME = HANDLEBODY_BODY;
  declare readonly extensionName: typeof HANDLEBODY_BODY;
  declare readonly propertyType: 'HandlebodyBody';
  declare readonly parentTypes: [PropertyType.ROOT];

  protected override init(): void {
    Object.assign(this, { extensionName: HANDLEBODY_BODY, propertyType: 'HandlebodyBody', parentTypes: [PropertyType.ROOT] });
  }

  protected override getDefaults(): Nullable<IBodyProperty> {
    return Object.assign(super.getDefaults(), {
      header: {},
      ...Object.fromEntries(NAMES.map((name) => [name, null])),
    });
  }

  /** All but the accessors, as the JSON has it: not yet checked, see `parseBodyHeader`. */
  getHeader(): Record<string, unknown> {
    return this.get('header');
  }

  setHeader(header: object): this {
    return this.set('header', { ...header });
  }

  getAccessor(name: BodyAccessorName): Accessor | null {
    return this.getRef(name);
  }

  setAccessor(name: BodyAccessorName, accessor: Accessor | null): this {
    return this.setRef(name, accessor, { usage: WriterContext.BufferViewUsage.OTHER });
  }
}

/**
 * Lets glTF-Transform read and write baked bodies.
 *
 * ```ts
 * const io = new NodeIO().registerExtensions([BodyExtension, PoseSpaceExtension]);
 * ```
 */
export class BodyExtension extends Extension {
  static override readonly EXTENSION_NAME = HANDLEBODY_BODY;
  override readonly extensionName = HANDLEBODY_BODY;

  createBody(): BodyProperty {
    return new BodyProperty(this.document.getGraph());
  }

  /** Takes what is there, compressed as it is, so that a damaged body does not keep the model from opening; `readBody` checks it. */
  override read(context: ReaderContext): this {
    const json = (context.jsonDoc.json.extensions as Record<string, unknown> | undefined)?.[HANDLEBODY_BODY];
    if (typeof json !== 'object' || json === null) return this;
    const header: Record<string, unknown> = { ...json };
    const body = this.createBody();
    for (const name of NAMES) {
      body.setAccessor(name, context.accessors[header[name] as number] ?? null);
      delete header[name];
    }
    this.document.getRoot().setExtension(HANDLEBODY_BODY, body.setHeader(header));
    return this;
  }

  override write(context: WriterContext): this {
    const body = this.document.getRoot().getExtension<BodyProperty>(HANDLEBODY_BODY);
    if (!body) return this;
    const json = body.getHeader();
    const accessors = NAMES.flatMap((name) => {
      const accessor = body.getAccessor(name);
      return accessor ? [[name, context.accessorIndexMap.get(accessor)]] : [];
    });
    const root = context.jsonDoc.json;
    root.extensions = { ...root.extensions, [HANDLEBODY_BODY]: { ...json, ...Object.fromEntries(accessors) } };
    return this;
  }
}
