// What a source file asks for: the includes of C++, the imports of TypeScript and JavaScript.
import path from 'node:path';
import ts from 'typescript';

/**
 * One import or include.
 * @typedef {object} Reference
 * @property {string} text what is written: './x.ts', 'three', 'core/mesh/mesh.hpp'
 * @property {number} line
 * @property {boolean} dynamic an import() that runs only when it is reached
 * @property {string} [file] the file of the project that it leads to
 */

export const isCpp = (/** @type {string} */ file) => /\.(cpp|hpp|h)$/.test(file);
export const isScript = (/** @type {string} */ file) => /\.(ts|mts|js|mjs)$/.test(file);

/** @param {string} file @param {string} code @param {{ has(file: string): boolean }} files @returns {Reference[]} */
export function references(file, code, files) {
  if (isCpp(file)) return includes(file, code, files);
  return isScript(file) ? imports(file, code, files) : [];
}

/** @param {string} file @param {string} code @param {{ has(file: string): boolean }} files @returns {Reference[]} */
function includes(file, code, files) {
  return code.split('\n').flatMap((row, index) => {
    const text = row.match(/^\s*#\s*include\s*[<"]([^>"]+)[>"]/)?.[1];
    if (!text) return [];
    const candidates = [path.posix.join(path.posix.dirname(file), text), path.posix.join('wasm', text)];
    const target = candidates.find((candidate) => files.has(candidate));
    return [{ text, line: index + 1, dynamic: false, ...(target ? { file: target } : {}) }];
  });
}

/** @param {string} file @param {string} code @param {{ has(file: string): boolean }} files @returns {Reference[]} */
function imports(file, code, files) {
  const source = ts.createSourceFile(file, code, ts.ScriptTarget.Latest, true);
  /** @type {Reference[]} */
  const found = [];
  /** @param {ts.Node} node @param {ts.Node | undefined} specifier @param {boolean} dynamic */
  const add = (node, specifier, dynamic) => {
    if (!specifier || !ts.isStringLiteralLike(specifier)) return;
    const text = specifier.text;
    const target = text.startsWith('.') ? path.posix.join(path.posix.dirname(file), text.replace(/[?#].*$/, '')) : undefined;
    const line = source.getLineAndCharacterOfPosition(node.getStart()).line + 1;
    found.push({ text, line, dynamic, ...(target && files.has(target) ? { file: target } : {}) });
  };
  /** @param {ts.Node} node */
  const visit = (node) => {
    if (ts.isImportDeclaration(node) || ts.isExportDeclaration(node)) add(node, node.moduleSpecifier, false);
    else if (ts.isCallExpression(node) && node.expression.kind === ts.SyntaxKind.ImportKeyword) add(node, node.arguments[0], true);
    else if (ts.isImportTypeNode(node) && ts.isLiteralTypeNode(node.argument)) add(node, node.argument.literal, false);
    else if (
      ts.isNewExpression(node) &&
      node.expression.getText() === 'URL' &&
      node.arguments?.[1]?.getText() === 'import.meta.url'
    ) {
      add(node, node.arguments[0], true);
    }
    ts.forEachChild(node, visit);
  };
  visit(source);
  return found;
}

/** Lines where a script reads a property of one of these globals. @param {string} file @param {string} code @param {string[]} names */
export function globalUses(file, code, names) {
  const source = ts.createSourceFile(file, code, ts.ScriptTarget.Latest, true);
  /** @type {{ name: string, line: number }[]} */
  const found = [];
  /** @param {ts.Node} node */
  const visit = (node) => {
    if ((ts.isPropertyAccessExpression(node) || ts.isElementAccessExpression(node)) && ts.isIdentifier(node.expression)) {
      const name = node.expression.text;
      if (names.includes(name)) found.push({ name, line: source.getLineAndCharacterOfPosition(node.getStart()).line + 1 });
    }
    ts.forEachChild(node, visit);
  };
  visit(source);
  return found;
}

/** The first circle of references, as the files along it. @param {Map<string, Reference[]>} graph @returns {string[] | undefined} */
export function findCycle(graph) {
  /** @type {Map<string, 'open' | 'done'>} */
  const state = new Map();
  /** @type {string[]} */
  const trail = [];
  /** @param {string} file @returns {string[] | undefined} */
  const walk = (file) => {
    state.set(file, 'open');
    trail.push(file);
    for (const { file: next } of graph.get(file) ?? []) {
      if (!next || state.get(next) === 'done') continue;
      const cycle = state.get(next) === 'open' ? [...trail.slice(trail.indexOf(next)), next] : walk(next);
      if (cycle) return cycle;
    }
    trail.pop();
    state.set(file, 'done');
    return undefined;
  };
  for (const file of graph.keys()) {
    const cycle = state.has(file) ? undefined : walk(file);
    if (cycle) return cycle;
  }
  return undefined;
}
