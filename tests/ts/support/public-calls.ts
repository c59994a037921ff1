/** Everything of the package that can be called, found in its declarations: functions, constructors, methods, and properties that are set. */
import path from 'node:path';
import ts from 'typescript';
import { PageError } from '../../../web/ui/page-error.ts';
import { declarations } from './declarations.ts';
import { fakePage } from './fake-page.ts';
import { samples } from './samples.ts';

const { entries, program } = declarations();
export const checker = program.getTypeChecker();

/** An argument: its name, which a message about it has; nothing where it is taken apart at once. */
export interface Argument {
  readonly name: string;
  readonly type: ts.Type;
  readonly optional: boolean;
}

export interface Call {
  readonly title: string;
  readonly given: readonly Argument[];
  readonly run: (given: readonly unknown[]) => unknown;
}

const isHidden = (node: ts.Node) => ts.getJSDocTags(node).some(({ tagName }) => tagName.text === 'internal');
export const isOurs = (node: ts.Node) => path.relative('dist', node.getSourceFile().fileName).match(/^(wasm|web)\//) !== null;
const has = (node: ts.Declaration, flags: ts.ModifierFlags) => (ts.getCombinedModifierFlags(node) & flags) !== 0;
const NOT_PUBLIC = ts.ModifierFlags.Private | ts.ModifierFlags.Protected;

function argument(symbol: ts.Symbol, at: ts.Node, name = symbol.name): Argument {
  const declared = symbol.valueDeclaration as ts.ParameterDeclaration | undefined;
  const isApart = declared && ts.isParameter(declared) && !ts.isIdentifier(declared.name);
  return {
    name: isApart ? '' : name,
    type: checker.getTypeOfSymbolAtLocation(symbol, at),
    optional: declared !== undefined && ts.isParameter(declared) && checker.isOptionalParameter(declared),
  };
}

function argumentsOf(type: ts.Type, at: ts.Node, kind = ts.SignatureKind.Call): Argument[] {
  const [signature] = checker.getSignaturesOfType(type, kind);
  return (signature?.parameters ?? []).map((symbol) => argument(symbol, at));
}

type Function = (...all: unknown[]) => unknown;

/** What an export offers: itself, or its constructor; and the functions of an object. */
function ownCalls(name: string, symbol: ts.Symbol, value: unknown): Call[] {
  const at = symbol.declarations?.[0];
  if (!at || !isOurs(at) || isHidden(at)) return [];
  const type = checker.getTypeOfSymbolAtLocation(symbol, at);
  if (ts.isFunctionDeclaration(at))
    return [{ title: name, given: argumentsOf(type, at), run: (given) => (value as Function)(...given) }];
  if (ts.isClassDeclaration(at)) {
    const made = at.members.find(ts.isConstructorDeclaration);
    if (!made || isHidden(made) || has(made, NOT_PUBLIC)) return [];
    const run = (given: readonly unknown[]) => new (value as new (...all: unknown[]) => unknown)(...given);
    return [{ title: `new ${name}`, given: argumentsOf(type, made, ts.SignatureKind.Construct), run }];
  }
  if (!ts.isVariableDeclaration(at) && !ts.isExportAssignment(at)) return [];
  return checker.getPropertiesOfType(type).flatMap((member) => {
    if (!member.declarations?.every(isOurs)) return [];
    const given = argumentsOf(checker.getTypeOfSymbolAtLocation(member, at), at);
    const run = (all: readonly unknown[]) => ((value as Record<string, Function>)[member.name] as Function)(...all);
    return given.length > 0 ? [{ title: `${name}.${member.name}`, given, run }] : [];
  });
}

async function sampleOf(name: string): Promise<Record<string, Function>> {
  const make = samples[name];
  if (!make) throw new Error(`Give tests/ts/support/samples.ts a sample of ${name}.`);
  return (await make()) as Record<string, Function>;
}

/** Methods of a class, and properties that can be set, tried on a sample of it. What an element tells by its event, it throws here. */
function membersOf(name: string, type: ts.Type): Call[] {
  return checker.getPropertiesOfType(type).flatMap((member): Call[] => {
    const at = member.declarations?.find((each) => ts.isMethodDeclaration(each) || ts.isSetAccessorDeclaration(each));
    if (!at || !isOurs(at) || isHidden(at) || has(at, NOT_PUBLIC)) return [];
    if (ts.isComputedPropertyName(at.name as ts.PropertyName) || ts.isPrivateIdentifier(at.name as ts.PropertyName)) return [];
    const isSet = ts.isSetAccessorDeclaration(at);
    // As an attribute that is left out.
    const optional = checker.getPropertyOfType(type, 'attributeChangedCallback') !== undefined;
    const parameter = isSet && checker.getSymbolAtLocation((at.parameters[0] as ts.ParameterDeclaration).name);
    const given = parameter
      ? [{ ...argument(parameter, at, member.name), optional }]
      : argumentsOf(checker.getTypeOfSymbolAtLocation(member, at), at);
    const run = async (all: readonly unknown[]) => {
      const object = await sampleOf(name);
      const told: PageError[] = [];
      if (object instanceof EventTarget)
        object.addEventListener('error', (event) => {
          const { code, message, remedy } = (event as CustomEvent).detail;
          told.push(new PageError(code, message, remedy));
        });
      if (isSet) Object.assign(object, { [member.name]: all[0] });
      else await (object[member.name] as Function).apply(object, [...all]);
      if (told[0]) throw told[0];
    };
    return given.length > 0 ? [{ title: `${name}.${member.name}${isSet ? ' =' : ''}`, given, run }] : [];
  });
}

export async function publicCalls(): Promise<readonly Call[]> {
  fakePage();
  const calls: Call[] = [];
  const seen = new Set<ts.Symbol>();
  for (const [, types] of entries) {
    const file = program.getSourceFile(types);
    const symbol = file && checker.getSymbolAtLocation(file);
    if (!symbol) throw new Error(`${types} is no module.`);
    const exported = checker.getExportsOfModule(symbol);
    const source = path.relative('dist', types).replace(/\.d\.ts$/, '.ts');
    // A worker's script exports nothing, and is not for pages to import.
    const module: Record<string, unknown> = exported.length > 0 ? await import(path.resolve(source)) : {};
    for (const each of exported) {
      const original = each.flags & ts.SymbolFlags.Alias ? checker.getAliasedSymbol(each) : each;
      if (seen.has(original)) continue;
      seen.add(original);
      if (each.name in module) calls.push(...ownCalls(each.name, original, module[each.name]));
      if (original.declarations?.some((at) => ts.isClassDeclaration(at) && isOurs(at) && !isHidden(at)))
        calls.push(...membersOf(each.name, checker.getDeclaredTypeOfSymbol(original)));
    }
  }
  return calls;
}
