/**
 * Every function, constructor and method that the package exports, but for figures and elements, is called with things that are wrong for the documented type of each of its
 * arguments and options, read from the declarations: so a new export is tested without being listed. Each call must end in a
 * HandlebodyError whose message has the argument's or the option's name.
 */
import { existsSync } from 'node:fs';
import path from 'node:path';
import ts from 'typescript';
import { describe, expect, test } from 'vitest';
import manifest from '../../package.json' with { type: 'json' };
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { right, samples } from './support/samples.ts';
import { type Kind, WRONG } from './support/wrong-values.ts';

/** Entries that only a browser can import, whose attributes are text that tests/web tries; and figures, which are not tried yet. */
const ELEMENTS = /element|anywidget|standalone|bake-worker|figure/;

/** What cannot be tried so, by the names of calls, or of classes, and why: at most ten. */
const EXCEPTIONS: Readonly<Record<string, string>> = {
  'new HandlebodyError': 'it is the error',
  BodyExtension: 'glTF-Transform calls it, as it calls its own',
  BodyProperty: 'glTF-Transform calls it, as it calls its own',
  PoseSpaceExtension: 'glTF-Transform calls it, as it calls its own',
  PoseSpaceProperty: 'glTF-Transform calls it, as it calls its own',
  HandlebodyGLTFPlugin: 'GLTFLoader calls it',
  handlebodyPlugin: 'GLTFLoader calls it',
  HandleOverlay: 'draggable makes it, from options that it has checked',
  BareHandles: 'draggable makes it, from options that it has checked',
};
const exception = (title: string) =>
  title in EXCEPTIONS || (title.split(/[ .]/).find((word) => word !== 'new') ?? '') in EXCEPTIONS;

const { config } = ts.readConfigFile('tsconfig.json', ts.sys.readFile);
const entries = Object.entries(manifest.exports).flatMap(([entry, target]) => {
  const source = typeof target === 'object' ? target.types.replace(/^\.\/dist\//, '').replace(/\.d\.ts$/, '.ts') : '';
  return existsSync(source) && !ELEMENTS.test(entry) ? [[entry, source] as const] : [];
});
const program = ts.createProgram(
  entries.map(([, file]) => file),
  ts.convertCompilerOptionsFromJson(config.compilerOptions, '.').options,
);
const checker = program.getTypeChecker();

interface Call {
  readonly title: string;
  readonly parameters: readonly ts.Symbol[];
  readonly at: ts.Node;
  readonly run: (given: readonly unknown[]) => unknown;
}

const isHidden = (node: ts.Node) => ts.getJSDocTags(node).some(({ tagName }) => tagName.text === 'internal');
const isOurs = (node: ts.Node) => /^(wasm|web)\//.test(path.relative(process.cwd(), node.getSourceFile().fileName));

/** The calls that an export offers: itself, or its constructor, and its methods on a sample of its class. */
function callsOf(name: string, symbol: ts.Symbol, value: unknown): Call[] {
  const declaration = symbol.declarations?.[0];
  if (!declaration || !isOurs(declaration) || isHidden(declaration)) return [];
  if (ts.isFunctionDeclaration(declaration))
    return [
      {
        title: name,
        parameters: parametersOf(symbol, declaration),
        at: declaration,
        run: (given) => (value as (...all: unknown[]) => unknown)(...given),
      },
    ];
  if (!ts.isClassDeclaration(declaration)) return [];
  const constructed = declaration.members.find(ts.isConstructorDeclaration);
  const isPublic =
    constructed && !isHidden(constructed) && !(ts.getCombinedModifierFlags(constructed) & ts.ModifierFlags.Protected);
  const made: Call[] = isPublic
    ? [
        {
          title: `new ${name}`,
          parameters: constructed.parameters.map((each) => checker.getSymbolAtLocation(each.name) ?? named(each)),
          at: constructed,
          run: (given) => new (value as new (...all: unknown[]) => unknown)(...given),
        },
      ]
    : [];
  return [...made, ...methodsOf(name, checker.getDeclaredTypeOfSymbol(symbol))];
}

function methodsOf(name: string, type: ts.Type): Call[] {
  return checker.getPropertiesOfType(type).flatMap((member) => {
    const method = member.declarations?.find(ts.isMethodDeclaration);
    if (!method || !isOurs(method) || isHidden(method) || method.name.kind === ts.SyntaxKind.PrivateIdentifier) return [];
    if (ts.getCombinedModifierFlags(method) & (ts.ModifierFlags.Private | ts.ModifierFlags.Protected)) return [];
    if (method.parameters.length === 0 || ts.isComputedPropertyName(method.name)) return [];
    const run = async (given: readonly unknown[]) => {
      const object = (await sampleOf(name)) as Record<string, (...all: unknown[]) => unknown>;
      return (object[member.name] as (...all: unknown[]) => unknown).apply(object, [...given]);
    };
    return [{ title: `${name}.${member.name}`, parameters: parametersOf(member, method), at: method, run }];
  });
}

const named = (parameter: ts.ParameterDeclaration) => ({ name: parameter.name.getText() }) as ts.Symbol;

function parametersOf(symbol: ts.Symbol, at: ts.Node): readonly ts.Symbol[] {
  const [signature] = checker.getSignaturesOfType(checker.getTypeOfSymbolAtLocation(symbol, at), ts.SignatureKind.Call);
  return signature?.parameters ?? [];
}

async function sampleOf(name: string): Promise<unknown> {
  const make = samples[name];
  if (!make) throw new Error(`Give tests/ts/support/samples.ts a sample of ${name}.`);
  return make();
}

const typeName = (type: ts.Type) => type.aliasSymbol?.name ?? type.getSymbol()?.name ?? checker.typeToString(type);

/** What a type takes, by kind. */
function kindsOf(type: ts.Type): Set<Kind> {
  if (type.isUnion()) return new Set(type.types.flatMap((each) => [...kindsOf(each)]));
  const { flags } = type;
  const by: readonly (readonly [ts.TypeFlags, Kind])[] = [
    [ts.TypeFlags.NumberLike, 'number'],
    [ts.TypeFlags.StringLiteral, 'name'],
    [ts.TypeFlags.StringLike, 'string'],
    [ts.TypeFlags.BooleanLike, 'boolean'],
    [ts.TypeFlags.Undefined | ts.TypeFlags.Void, 'undefined'],
    [ts.TypeFlags.Null, 'null'],
    [ts.TypeFlags.Any | ts.TypeFlags.Unknown, 'any'],
  ];
  const simple = by.find(([mask]) => flags & mask);
  if (simple) return new Set([simple[1]]);
  if (flags & ts.TypeFlags.TypeParameter) return kindsOf(type.getConstraint() ?? checker.getAnyType());
  if (type.getCallSignatures().length > 0) return new Set(['function']);
  const isList = checker.isArrayLikeType(type) || type.getNumberIndexType() !== undefined;
  return new Set([isList ? 'list' : 'object']);
}

/** The properties of an object of options: of our own declarations only, so neither arrays nor three.js' objects. */
function optionsOf(type: ts.Type): readonly ts.Symbol[] {
  const parts = type.isUnion() ? type.types : [type];
  const records = parts.filter(
    (each) =>
      kindsOf(each).has('object') &&
      each.isClassOrInterface() === Boolean(each.getSymbol()?.declarations?.some(ts.isInterfaceDeclaration)),
  );
  const ours = records.filter((each) => /Options|Choices/.test(typeName(each)) && each.getSymbol()?.declarations?.every(isOurs));
  return ours.flatMap((each) => checker.getPropertiesOfType(each));
}

const isOptional = (symbol: ts.Symbol) =>
  Boolean(symbol.flags & ts.SymbolFlags.Optional) ||
  Boolean(
    symbol.valueDeclaration && ts.isParameter(symbol.valueDeclaration) && checker.isOptionalParameter(symbol.valueDeclaration),
  );

/** A value that the type takes. */
async function valid(type: ts.Type, at: ts.Node): Promise<unknown> {
  for (const each of [type, ...(type.isUnion() ? type.types : [])]) {
    const make = samples[typeName(each)];
    if (make) return make();
  }
  const kinds = kindsOf(type);
  if (kinds.has('undefined')) return undefined;
  if (kinds.has('number')) return 1;
  if (kinds.has('boolean')) return true;
  if (kinds.has('name'))
    return (
      type.isUnion()
        ? type.types.find((each) => each.isStringLiteral())
        : (type as ts.StringLiteralType | undefined as never as ts.StringLiteralType)
    )?.value;
  if (kinds.has('string')) return 'a';
  if (kinds.has('function')) return () => 1;
  if (kinds.has('list')) return [];
  const record: Record<string, unknown> = {};
  for (const property of checker.getPropertiesOfType(type))
    if (!isOptional(property)) record[property.name] = await valid(checker.getTypeOfSymbolAtLocation(property, at), at);
  return record;
}

/** Twenty and more things of kinds that the type does not take. */
function wrongFor(type: ts.Type, optional: boolean): readonly (readonly [string, unknown])[] {
  const kinds = kindsOf(type);
  if (kinds.has('any')) return [];
  // Bytes may come in any view.
  const takesViews = type.isUnion() && type.types.some((each) => typeName(each) === 'ArrayBufferView');
  return WRONG.filter(
    ({ kind, value }) =>
      !kinds.has(kind) &&
      !(takesViews && ArrayBuffer.isView(value)) &&
      !(kind === 'undefined' && optional) &&
      !(kind === 'string' && kinds.has('string')),
  ).map(({ told, value }) => [told, value] as const);
}

const counts = { calls: 0, arguments: 0, options: 0, tries: 0 };

/** What is not as it should be: nothing was thrown, or something else, or without the name. */
async function faultOf(work: () => unknown, name: string): Promise<string | undefined> {
  counts.tries++;
  try {
    await work();
  } catch (error) {
    if (!(error instanceof HandlebodyError))
      return `${(error as Error)?.constructor?.name}: ${String((error as Error)?.message).slice(0, 90)}`;
    return error.message.includes(name) ? undefined : `no "${name}" in: ${error.message.slice(0, 110)}`;
  }
  return 'is taken';
}

const calls: Call[] = [];
const seen = new Set<ts.Symbol>();
for (const [, file] of entries) {
  const module = (await import(path.resolve(file))) as Record<string, unknown>;
  const symbol = checker.getSymbolAtLocation(program.getSourceFile(file) as ts.SourceFile) as ts.Symbol;
  for (const exported of checker.getExportsOfModule(symbol)) {
    const original = exported.flags & ts.SymbolFlags.Alias ? checker.getAliasedSymbol(exported) : exported;
    if (seen.has(original)) continue;
    seen.add(original);
    const isType = original.declarations?.some(ts.isClassDeclaration) && !(exported.name in module);
    calls.push(
      ...(isType
        ? methodsOf(exported.name, checker.getDeclaredTypeOfSymbol(original))
        : callsOf(exported.name, original, module[exported.name])),
    );
  }
}

describe.each(calls.map((call) => [call.title, call] as const))('%s', (title, { parameters, at, run }) => {
  test.skipIf(exception(title))('names each argument and option that is wrong', { timeout: 60_000 }, async () => {
    counts.calls++;
    const faults: string[] = [];
    const types = parameters.map((parameter) => checker.getTypeOfSymbolAtLocation(parameter, at));
    const good: unknown[] = [...(right[title] ?? [])];
    for (const type of types.slice(good.length)) good.push(await valid(type, at));
    for (const [i, type] of types.entries()) {
      counts.arguments++;
      const declared = (parameters[i] as ts.Symbol).valueDeclaration as ts.ParameterDeclaration | undefined;
      const name = declared && !ts.isIdentifier(declared.name) ? '' : (parameters[i] as ts.Symbol).name;
      const optional = isOptional(parameters[i] as ts.Symbol);
      for (const [told, value] of wrongFor(type, optional)) {
        const fault = await faultOf(() => run(good.map((each, k) => (k === i ? value : each))), name);
        if (fault) faults.push(`${name} = ${told}: ${fault}`);
      }
      for (const option of optionsOf(type)) {
        counts.options++;
        const full = ((await valid(type, at)) ?? {}) as Record<string, unknown>;
        const withOption = (key: string, value: unknown) => () =>
          run(good.map((each, k) => (k === i ? { ...full, [key]: value } : each)));
        const optionType = checker.getTypeOfSymbolAtLocation(option, at);
        for (const [told, value] of wrongFor(optionType, isOptional(option))) {
          const fault = await faultOf(withOption(option.name, value), option.name);
          if (fault) faults.push(`${name}.${option.name} = ${told}: ${fault}`);
        }
        const misspelt = `${option.name}s`;
        if (option.name.length < 4 || optionsOf(type).some((other) => other.name === misspelt)) continue;
        const fault = await faultOf(withOption(misspelt, 1), misspelt);
        if (fault) faults.push(`${name}.${misspelt}: ${fault}`);
      }
    }
    if (faults.length > 0) expect.fail(faults.join('\n'));
  });
});

test('the exceptions are few, and most of the package is tried', () => {
  expect(Object.keys(EXCEPTIONS).length).toBeLessThanOrEqual(10);
  expect(Object.keys(EXCEPTIONS).filter((name) => !calls.some(({ title }) => title.includes(name)))).toEqual([]);
  console.log(`${counts.calls} calls, ${counts.arguments} arguments, ${counts.options} options, ${counts.tries} tries`);
});
