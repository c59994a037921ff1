/**
 * Every function, constructor, method and settable property of the package, found in the declarations that it is published with, is given
 * things that are wrong for the documented type of each of its arguments and options: so a new export is tested without being listed. Each
 * must end in a HandlebodyError whose message has the argument's or the option's name; of an element, in the event that says the same.
 */
import ts from 'typescript';
import { describe, expect, test } from 'vitest';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { PageError } from '../../web/ui/page-error.ts';
import { checker, isOurs, publicCalls } from './support/public-calls.ts';
import { right, samples } from './support/samples.ts';
import { type Kind, WRONG } from './support/wrong-values.ts';

/** What cannot be tried so, by the names of calls, or of classes, and why: at most ten. */
const EXCEPTIONS: Readonly<Record<string, string>> = {
  HandlebodyError: 'it is the error',
  BodyExtension: 'glTF-Transform calls it, as it calls its own',
  BodyProperty: 'glTF-Transform calls it, as it calls its own',
  PoseSpaceExtension: 'glTF-Transform calls it, as it calls its own',
  PoseSpaceProperty: 'glTF-Transform calls it, as it calls its own',
  HandlebodyGLTFPlugin: 'GLTFLoader calls it',
  handlebodyPlugin: 'GLTFLoader calls it',
  'default.render': 'notebooks call it',
  attributeChangedCallback: 'the browser calls it',
};
const exception = (title: string) => [title, ...title.split(/[ .]/)].some((word) => Object.hasOwn(EXCEPTIONS, word));

/** Wrong things for each argument. */
const LEAST = 20;

const typeName = (type: ts.Type) => type.aliasSymbol?.name ?? type.getSymbol()?.name ?? checker.typeToString(type);

/** What a type takes, by kind. */
function kindsOf(type: ts.Type): Set<Kind> {
  if (type.isUnion()) return new Set(type.types.flatMap((each) => [...kindsOf(each)]));
  const { flags } = type;
  if (flags & ts.TypeFlags.Substitution) return kindsOf((type as ts.SubstitutionType).baseType);
  const by: readonly (readonly [ts.TypeFlags, Kind])[] = [
    [ts.TypeFlags.NumberLike, 'number'],
    [ts.TypeFlags.StringLiteral, 'name'],
    [ts.TypeFlags.StringLike, 'string'],
    [ts.TypeFlags.Index, 'string'],
    [ts.TypeFlags.BooleanLike, 'boolean'],
    [ts.TypeFlags.Undefined | ts.TypeFlags.Void, 'undefined'],
    [ts.TypeFlags.Null, 'null'],
    [ts.TypeFlags.Any | ts.TypeFlags.Unknown, 'any'],
  ];
  const simple = by.find(([mask]) => flags & mask);
  if (simple) return new Set([simple[1]]);
  if (flags & ts.TypeFlags.Intersection) {
    const parts = (type as ts.IntersectionType).types.flatMap((each) => [...kindsOf(each)]);
    if (parts.includes('string')) return new Set(['string']);
  }
  if (flags & ts.TypeFlags.TypeParameter) return kindsOf(type.getConstraint() ?? checker.getAnyType());
  if (type.getCallSignatures().length > 0) return new Set(['function']);
  const isList = checker.isArrayLikeType(type) || type.getNumberIndexType() !== undefined;
  return new Set([isList ? 'list' : 'object']);
}

const isOptional = (symbol: ts.Symbol) => Boolean(symbol.flags & ts.SymbolFlags.Optional);

/** The properties of an object of options: of our own declarations only, so neither arrays nor three.js' objects. */
function optionsOf(type: ts.Type): readonly ts.Symbol[] {
  const parts = type.isUnion() ? type.types : [type];
  return parts.flatMap((each) => {
    const declared = each.getSymbol()?.declarations ?? [];
    const isRecord = kindsOf(each).has('object') && declared.length > 0 && declared.every(isOurs);
    const isNamed = /Options|Choices|Figure$/.test(typeName(each)) && !declared.some(ts.isClassDeclaration);
    return isRecord && (isNamed || declared.every(ts.isTypeLiteralNode)) ? checker.getPropertiesOfType(each) : [];
  });
}

/** A value that the type takes. */
async function valid(type: ts.Type): Promise<unknown> {
  for (const each of [type, ...(type.isUnion() ? type.types : [])]) {
    const make = samples[typeName(each)];
    if (make) return make();
  }
  const kinds = kindsOf(type);
  if (kinds.has('undefined')) return undefined;
  if (kinds.has('number')) return 1;
  if (kinds.has('boolean')) return true;
  if (kinds.has('name')) return (type.isUnion() ? type.types : [type]).find((each) => each.isStringLiteral())?.value;
  if (kinds.has('string')) return 'a';
  if (kinds.has('function')) return () => 1;
  if (kinds.has('list')) return [];
  const record: Record<string, unknown> = {};
  for (const property of checker.getPropertiesOfType(type))
    if (!isOptional(property)) record[property.name] = await valid(checker.getTypeOfSymbol(property));
  return record;
}

/** The types that a type may be, each alone. */
const partsOf = (type: ts.Type): readonly ts.Type[] => (type.isUnion() ? type.types : [type]);

/** What an object has to have. Nothing where some kind of object has to have nothing. */
function wantedOf(type: ts.Type): readonly string[] {
  const objects = partsOf(type).filter((each) => kindsOf(each).has('object'));
  const wanted = objects.map((each) => checker.getPropertiesOfType(each).filter((one) => !isOptional(one)));
  return wanted.some((all) => all.length === 0) ? [] : wanted.flat().map(({ name }) => name);
}

/** Kinds of what a list may hold; nothing where that may be anything. */
function kindsIn(type: ts.Type): Set<Kind> {
  const lists = partsOf(type).filter((each) => kindsOf(each).has('list'));
  const held = lists.map((each) => checker.getIndexTypeOfType(each, ts.IndexKind.Number));
  return new Set(held.flatMap((each) => (each ? [...kindsOf(each)] : ['any' as const])));
}

interface Attempt {
  readonly told: string;
  readonly value: unknown;
  /** What the message may name: the argument, or what of it is missing. */
  readonly names: readonly string[];
}

/** Things that the type does not take: of other kinds, objects without what they have to have, lists of other things. */
function wrongFor(name: string, type: ts.Type, optional: boolean): readonly Attempt[] {
  const kinds = kindsOf(type);
  if (kinds.has('any')) return [];
  const [wanted, held] = [wantedOf(type), kindsIn(type)];
  // Bytes may come in any view.
  const takesViews = partsOf(type).some((each) => typeName(each) === 'ArrayBufferView');
  return WRONG.flatMap(({ kind, value, told }) => {
    if (takesViews && ArrayBuffer.isView(value)) return [];
    if (kind === 'undefined' && optional) return [];
    if (!kinds.has(kind)) return [{ told, value, names: [name] }];
    const missing = kind === 'object' ? wanted.filter((each) => !(each in (value as object))) : [];
    if (missing.length > 0) return [{ told, value, names: [name, ...missing] }];
    if (kind === 'list' && !held.has('any') && !held.has(kindOf((value as readonly unknown[])[0])))
      return [{ told, value, names: [name] }];
    return [];
  });
}

function kindOf(value: unknown): Kind {
  if (value === null) return 'null';
  return typeof value === 'bigint' ? 'none' : (typeof value as Kind);
}

const counts = { calls: 0, arguments: 0, options: 0, tries: 0, least: Number.POSITIVE_INFINITY };

/** What is not as it should be: nothing was thrown, or something else, or without the name. */
async function faultOf(work: () => unknown, ...names: readonly string[]): Promise<string | undefined> {
  counts.tries++;
  try {
    await work();
  } catch (error) {
    if (!(error instanceof HandlebodyError || error instanceof PageError))
      return `${(error as Error)?.constructor?.name}: ${String((error as Error)?.message).slice(0, 90)}`;
    return names.some((name) => error.message.includes(name)) ? undefined : `no "${names[0]}" in: ${error.message.slice(0, 110)}`;
  }
  return 'is taken';
}

/** Tries all that is wrong for one argument or option. */
async function faultsOf(name: string, type: ts.Type, optional: boolean, run: (value: unknown) => unknown): Promise<string[]> {
  const faults: string[] = [];
  const all = wrongFor(name, type, optional);
  if (all.length > 0) counts.least = Math.min(counts.least, all.length);
  for (const { told, value, names } of all) {
    const fault = await faultOf(() => run(value), ...names);
    if (fault) faults.push(`${name} = ${told}: ${fault}`);
  }
  return faults;
}

const calls = await publicCalls();

describe.each(calls.map((call) => [call.title, call] as const))('%s', (title, { given, run }) => {
  test.skipIf(exception(title))('names each argument and option that is wrong', { timeout: 60_000 }, async () => {
    counts.calls++;
    const faults: string[] = [];
    const good: unknown[] = [...(right[title] ?? [])];
    for (const { type } of given.slice(good.length)) good.push(await valid(type));
    for (const [i, { name, type, optional }] of given.entries()) {
      counts.arguments++;
      const put = (value: unknown) => run(good.map((each, k) => (k === i ? value : each)));
      faults.push(...(await faultsOf(name, type, optional, put)));
      const known = optionsOf(type);
      for (const option of known) {
        counts.options++;
        const full = ((await valid(type)) ?? {}) as Record<string, unknown>;
        const putOption = (key: string) => (value: unknown) => put({ ...full, [key]: value });
        faults.push(...(await faultsOf(option.name, checker.getTypeOfSymbol(option), isOptional(option), putOption(option.name))));
        const misspelt = `${option.name}s`;
        if (option.name.length < 4 || known.some((other) => other.name === misspelt)) continue;
        const fault = await faultOf(() => putOption(misspelt)(1), misspelt);
        if (fault) faults.push(`${name}.${misspelt}: ${fault}`);
      }
    }
    if (faults.length > 0) expect.fail(faults.join('\n'));
  });
});

test('the exceptions are few, and each argument is given enough', () => {
  expect(Object.keys(EXCEPTIONS).length).toBeLessThanOrEqual(10);
  expect(Object.keys(EXCEPTIONS).filter((name) => !calls.some(({ title }) => title.includes(name)))).toEqual([]);
  const { least, tries } = counts;
  console.log(
    `${counts.calls} calls, ${counts.arguments} arguments, ${counts.options} options, ${tries} tries, ${least} or more for each`,
  );
  expect(least).toBeGreaterThanOrEqual(LEAST);
});
