// Every export of wasm/ts, web and scripts is imported by another file, or is public: exported by an entry of package.json's `exports`.
// What nobody imports is dead code, or is nobody else's business.
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import ts from 'typescript';
import { isScript } from './lib/imports.mjs';
import { at } from './lib/paths.mjs';
import { runMain } from './lib/run.mjs';
import { sourceFiles } from './lib/sources.mjs';

const CHECKED = /^(wasm\/ts|web|scripts)\//;
const EVERYTHING = '*';

/**
 * @typedef {object} Module
 * @property {Map<string, number>} exports name and line of each
 * @property {string[]} stars files whose exports it passes on whole
 * @property {{ file: string, name: string }[]} uses what it takes from other files, EVERYTHING for all that there is
 */

/**
 * Exports that nobody imports, as one line each.
 * @param {Map<string, string>} files every script of the project with its text; paths with '/', from the project's folder
 * @param {readonly string[]} entries files whose exports are public
 */
export function lintExports(files, entries) {
  const modules = new Map([...files].map(([file, code]) => [file, readModule(file, code, files)]));
  /** @type {Set<string>} */
  const used = new Set();
  /** @param {string} file @param {string} name */
  const use = (file, name) => {
    const module = modules.get(file);
    if (!module || used.has(`${file} ${name}`)) return;
    used.add(`${file} ${name}`);
    if (name === EVERYTHING) for (const own of module.exports.keys()) use(file, own);
    if (!module.exports.has(name)) for (const star of module.stars) use(star, name);
  };
  for (const { uses } of modules.values()) for (const { file, name } of uses) use(file, name);
  for (const entry of entries) use(entry, EVERYTHING);
  return [...modules].flatMap(([file, { exports }]) =>
    [...exports]
      .filter(([name]) => CHECKED.test(file) && !used.has(`${file} ${name}`))
      .map(([name, line]) => `${file}:${line}: nothing imports ${name}: delete it, or do not export it`),
  );
}

/** Sources behind the modules that package.json exports. @param {{ exports: Record<string, string | { default: string }> }} manifest */
export function publicEntries({ exports }) {
  return Object.values(exports).map((target) =>
    toSource(path.posix.normalize(typeof target === 'string' ? target : target.default)),
  );
}

/** What tsc wrote stands for what it was made of. @param {string} file */
function toSource(file) {
  return file.startsWith('dist/') ? file.slice('dist/'.length).replace(/\.js$/, '.ts') : file;
}

/** @param {string} file @param {string} code @param {{ has(file: string): boolean }} files @returns {Module} */
function readModule(file, code, files) {
  const source = ts.createSourceFile(file, code, ts.ScriptTarget.Latest, true);
  /** @type {Module} */
  const module = { exports: new Map(), stars: [], uses: [] };
  /** @param {ts.Node | undefined} specifier */
  const resolve = (specifier) => {
    if (!specifier || !ts.isStringLiteralLike(specifier) || !specifier.text.startsWith('.')) return undefined;
    const target = toSource(path.posix.join(path.posix.dirname(file), specifier.text.replace(/[?#].*$/, '')));
    return files.has(target) ? target : undefined;
  };
  /** @param {string} name @param {ts.Node} node */
  const give = (name, node) => module.exports.set(name, source.getLineAndCharacterOfPosition(node.getStart()).line + 1);
  /** @param {string | undefined} target @param {string[]} names */
  const take = (target, names) => {
    if (target) module.uses.push(...names.map((name) => ({ file: target, name })));
  };

  /** @param {ts.Node} node */
  const visit = (node) => {
    if (ts.isImportDeclaration(node)) take(resolve(node.moduleSpecifier), importedNames(node.importClause));
    else if (ts.isExportDeclaration(node)) exportList(node);
    else if (ts.isExportAssignment(node)) give('default', node);
    else if (ts.isCallExpression(node) && node.expression.kind === ts.SyntaxKind.ImportKeyword)
      take(resolve(node.arguments[0]), awaitedNames(node));
    else if (ts.isImportTypeNode(node) && ts.isLiteralTypeNode(node.argument))
      take(resolve(node.argument.literal), [node.qualifier ? leftmost(node.qualifier) : EVERYTHING]);
    else if (ts.canHaveModifiers(node) && ts.getModifiers(node)?.some(({ kind }) => kind === ts.SyntaxKind.ExportKeyword))
      for (const name of declaredNames(node)) give(name, node);
    // Types of scripts stand in their comments.
    for (const comment of ts.getJSDocCommentsAndTags(node)) if (comment.parent === node) visit(comment);
    ts.forEachChild(node, visit);
  };
  /** @param {ts.ExportDeclaration} node */
  const exportList = ({ moduleSpecifier, exportClause }) => {
    const target = resolve(moduleSpecifier);
    if (!exportClause) {
      if (target) module.stars.push(target);
    } else if (ts.isNamespaceExport(exportClause)) {
      give(exportClause.name.text, exportClause);
      take(target, [EVERYTHING]);
    } else {
      for (const element of exportClause.elements) {
        give(element.name.text, element);
        take(target, [(element.propertyName ?? element.name).text]);
      }
    }
  };
  visit(source);
  return module;
}

/** @param {ts.ImportClause | undefined} clause */
function importedNames(clause) {
  const names = clause?.name ? ['default'] : [];
  const bindings = clause?.namedBindings;
  if (!bindings) return names;
  if (ts.isNamespaceImport(bindings)) return [EVERYTHING];
  return [...names, ...bindings.elements.map(({ propertyName, name }) => (propertyName ?? name).text)];
}

/** What is taken of `await import(…)`: `const { a, b } = …`, or `(…).a`; everything where it is handed on. @param {ts.CallExpression} call */
function awaitedNames(call) {
  /** @type {ts.Node} */
  let value = call;
  while (ts.isAwaitExpression(value.parent) || ts.isParenthesizedExpression(value.parent)) value = value.parent;
  const { parent } = value;
  if (ts.isPropertyAccessExpression(parent) && value !== call) return [parent.name.text];
  if (ts.isExpressionStatement(parent)) return [];
  if (!ts.isVariableDeclaration(parent) || !ts.isObjectBindingPattern(parent.name) || value === call) return [EVERYTHING];
  return parent.name.elements.map(({ propertyName, name }) => (propertyName ?? name).getText());
}

/** @param {ts.EntityName} name @returns {string} */
function leftmost(name) {
  return ts.isIdentifier(name) ? name.text : leftmost(name.left);
}

/** @param {ts.Node} node @returns {string[]} */
function declaredNames(node) {
  const modifiers = ts.canHaveModifiers(node) ? (ts.getModifiers(node) ?? []) : [];
  if (modifiers.some(({ kind }) => kind === ts.SyntaxKind.DefaultKeyword)) return ['default'];
  if (ts.isVariableStatement(node)) return node.declarationList.declarations.flatMap(({ name }) => boundNames(name));
  const { name } = /** @type {{ name?: ts.Node }} */ (node);
  return name && ts.isIdentifier(name) ? [name.text] : [];
}

/** @param {ts.BindingName} name @returns {string[]} */
function boundNames(name) {
  if (ts.isIdentifier(name)) return [name.text];
  return name.elements.flatMap((element) => (ts.isBindingElement(element) ? boundNames(element.name) : []));
}

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
  await runMain(async () => {
    const scripts = sourceFiles().filter(isScript);
    const entries = publicEntries(JSON.parse(readFileSync(at('package.json'), 'utf8')));
    const found = lintExports(new Map(scripts.map((file) => [file, readFileSync(at(file), 'utf8')])), entries);
    for (const line of found) console.error(line);
    console.log(`exports: ${scripts.length} files, ${found.length} that nobody imports`);
    return found.length === 0 ? 0 : 1;
  });
}
