import { existsSync } from 'node:fs';
import path from 'node:path';
import ts from 'typescript';
import { beforeAll, expect, it } from 'vitest';
import manifest from '../../package.json' with { type: 'json' };

/** The package's entries that have types, and the source of each; some types are generated. */
const entries = Object.entries(manifest.exports).flatMap(([entry, target]) => {
  const source = typeof target === 'object' ? target.types.replace(/^\.\/dist\//, '').replace(/\.d\.ts$/, '.ts') : '';
  return existsSync(source) ? [[entry, source] as const] : [];
});

let checker: ts.TypeChecker;
let program: ts.Program;
beforeAll(() => {
  const { config } = ts.readConfigFile('tsconfig.json', ts.sys.readFile);
  const { options } = ts.convertCompilerOptionsFromJson(config.compilerOptions, '.');
  program = ts.createProgram(
    entries.map(([, file]) => file),
    options,
  );
  checker = program.getTypeChecker();
}, 60_000);

const original = (symbol: ts.Symbol) => (symbol.flags & ts.SymbolFlags.Alias ? checker.getAliasedSymbol(symbol) : symbol);

function exportsOf(file: string): ts.Symbol[] {
  const module = checker.getSymbolAtLocation(program.getSourceFile(file) as ts.SourceFile);
  return checker.getExportsOfModule(module as ts.Symbol).map(original);
}

/** Whether a declaration is of our own source, and can be exported: not a type parameter, say. */
function isOurs(declaration: ts.Declaration): boolean {
  const file = path.relative(process.cwd(), declaration.getSourceFile().fileName);
  return /^(wasm|web)\//.test(file.replaceAll('\\', '/')) && ts.isSourceFile(topOf(declaration).parent);
}

/** The statement of a module that a declaration is, or is in. */
function topOf(declaration: ts.Node): ts.Node {
  return ts.isVariableDeclaration(declaration) ? declaration.parent.parent : declaration;
}

function isHidden(node: ts.Node): boolean {
  if (ts.getJSDocTags(node).some(({ tagName }) => tagName.text === 'internal')) return true;
  if (!ts.isClassElement(node)) return false;
  const modifiers = ts.getCombinedModifierFlags(node);
  return Boolean(modifiers & ts.ModifierFlags.Private) || (node.name !== undefined && ts.isPrivateIdentifier(node.name));
}

/** Calls `visit` with the name of every type that the declaration shows its reader: bodies and initial values are not looked into. */
function eachType(node: ts.Node, visit: (name: ts.EntityName | ts.Expression) => void): void {
  if (isHidden(node) || ts.isBlock(node)) return;
  if (ts.isTypeReferenceNode(node)) visit(node.typeName);
  else if (ts.isExpressionWithTypeArguments(node)) visit(node.expression);
  const hasValue = ts.isVariableDeclaration(node) || ts.isPropertyDeclaration(node) || ts.isParameter(node);
  ts.forEachChild(node, (child) => {
    if (!(hasValue && child === node.initializer)) eachType(child, visit);
  });
}

it('there is a lot to look at', () => expect(exportsOf('wasm/ts/index.ts').length).toBeGreaterThan(80));

it.each(entries)('every type that the exports of "%s" name is exported too', (_, file) => {
  const shown = exportsOf(file);
  // What all entries share is the solver's: it may be imported from there.
  const known = new Set([...shown, ...exportsOf('wasm/ts/index.ts')]);
  const missing = new Set<string>();
  for (const symbol of shown) {
    for (const declaration of symbol.declarations ?? []) {
      if (ts.isModuleBlock(declaration.parent)) continue; // merged in by an entry that exports it
      eachType(declaration, (name) => {
        const named = checker.getSymbolAtLocation(name);
        const target = named && original(named);
        if (!target || known.has(target) || !target.declarations?.some(isOurs)) return;
        missing.add(`${symbol.name} names ${target.name}`);
      });
    }
  }
  expect([...missing]).toEqual([]);
});
