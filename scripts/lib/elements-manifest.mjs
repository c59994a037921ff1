/**
 * The custom-elements manifest, https://github.com/webcomponents/custom-elements-manifest, read from the sources of web/element: the tags
 * from HTMLElementTagNameMap, members from the classes, events from the interfaces that type `addEventListener`, attributes, slots, parts and
 * custom properties from the tags of the doc comments.
 *
 * Rejected: @custom-elements-manifest/analyzer 0.11, which brings a TypeScript of its own, five years of packages around it, and no types: it
 * sees neither events that an interface names nor what `@internal` hides.
 */
import path from 'node:path';
import ts from 'typescript';
import { at } from './paths.mjs';

/**
 * @typedef {{ name: string, description: string, type?: { text: string }, inheritedFrom?: { name: string, module: string } }} Entry
 * @typedef {Entry & { kind: 'field' | 'method', readonly?: boolean, parameters?: { name: string, type: { text: string } }[], return?: { type: { text: string } } }} Member
 * @typedef {object} Element
 * @property {string} tagName
 * @property {string} name of the class
 * @property {string} module
 * @property {string} description
 * @property {Member[]} members
 * @property {Entry[]} attributes
 * @property {Entry[]} events
 * @property {Entry[]} slots
 * @property {Entry[]} cssParts
 * @property {Entry[]} cssProperties
 */

const ENTRY = 'web/element/index.ts';
/** What the browser calls, and what listeners call. */
const NOT_MEMBERS = /^((dis)?connectedCallback|attributeChangedCallback|(add|remove)EventListener)$/;

/** @param {ts.Node} node @param {string} name */
const hasTag = (node, name) => ts.getJSDocTags(node).some(({ tagName }) => tagName.text === name);

/** "{type} name - words", less what is left out. @param {ts.JSDocTag} tag @returns {Entry} */
function readTag(tag) {
  const text = (ts.getTextOfJSDocComment(tag.comment) ?? '').replace(/\s+/g, ' ');
  const match = /^(?:\{(.+?)\} )?(\S+) - (.+)$/.exec(text);
  if (!match) throw new Error(`${tag.getSourceFile().fileName}: "@${tag.tagName.text} ${text}" is not "@tag name - words".`);
  const [, type, name = '', description = ''] = match;
  return { name, description, ...(type && { type: { text: type } }) };
}

/** Reads the elements from the sources. @returns {Element[]} */
export function readElements() {
  const { config } = ts.readConfigFile(at('tsconfig.json'), ts.sys.readFile);
  const { options } = ts.convertCompilerOptionsFromJson(config.compilerOptions, at());
  const program = ts.createProgram([at(ENTRY)], options);
  const checker = program.getTypeChecker();
  const moduleOf = (/** @type {ts.Node} */ node) =>
    path.relative(at(), node.getSourceFile().fileName).replaceAll('\\', '/').replace(/\.ts$/, '.js').replace(/^/, 'dist/');
  const words = (/** @type {ts.Symbol} */ symbol) =>
    ts
      .displayPartsToString(symbol.getDocumentationComment(checker))
      .replace(/```[\s\S]*/, '')
      .replace(/\s+/g, ' ')
      .trim();
  const textOf = (/** @type {ts.Symbol} */ symbol) =>
    checker.typeToString(checker.getTypeOfSymbol(symbol), undefined, ts.TypeFormatFlags.NoTruncation);
  const signatureOf = (/** @type {ts.Symbol} */ method) => {
    const [signature] = checker.getTypeOfSymbol(method).getCallSignatures();
    const parameters = signature?.getParameters() ?? [];
    return {
      parameters: parameters.map((each) => ({ name: each.name, type: { text: textOf(each) } })),
      ...(signature && { return: { type: { text: checker.typeToString(signature.getReturnType()) } } }),
    };
  };
  const isOurs = (/** @type {ts.Node} */ node) => node.getSourceFile().fileName.startsWith(at('web'));

  /** The class, then those of ours that it extends. @param {ts.ClassDeclaration} node @returns {ts.ClassDeclaration[]} */
  const lineage = (node) => {
    const [base] = node.heritageClauses?.find(({ token }) => token === ts.SyntaxKind.ExtendsKeyword)?.types ?? [];
    const symbol = base && checker.getTypeAtLocation(base).getSymbol();
    const parent = symbol?.declarations?.find(ts.isClassDeclaration);
    return parent && isOurs(parent) ? [node, ...lineage(parent)] : [node];
  };

  const map = checker.resolveName('HTMLElementTagNameMap', undefined, ts.SymbolFlags.Interface, false);
  const tags = [...(map?.members?.values() ?? [])].filter((tag) => tag.declarations?.some(isOurs));
  return tags.map((tag) => {
    const symbol = checker.getTypeOfSymbol(tag).getSymbol();
    const own = symbol?.declarations?.find(ts.isClassDeclaration);
    if (!own?.name || !symbol) throw new Error(`<${tag.name}> is of no class.`);
    const classes = lineage(own);
    const inherited = (/** @type {ts.Node} */ from) =>
      from === own
        ? {}
        : { inheritedFrom: { name: /** @type {ts.ClassDeclaration} */ (from).name?.text ?? '', module: moduleOf(from) } };
    const tagged = (/** @type {string} */ name) =>
      classes.flatMap((node) =>
        ts
          .getJSDocTags(node)
          .filter(({ tagName }) => tagName.text === name)
          .map((each) => ({ ...readTag(each), ...inherited(node) })),
      );
    const members = checker.getPropertiesOfType(checker.getTypeOfSymbol(tag)).flatMap((member) => {
      const [declaration] = member.declarations ?? [];
      if (!declaration || !isOurs(declaration) || NOT_MEMBERS.test(member.name) || !ts.isClassElement(declaration)) return [];
      const flags = ts.getCombinedModifierFlags(declaration);
      const isHidden = flags & (ts.ModifierFlags.Private | ts.ModifierFlags.Protected) || hasTag(declaration, 'internal');
      if (isHidden || ts.isPrivateIdentifier(declaration.name ?? declaration)) return [];
      const isMethod = ts.isMethodDeclaration(declaration);
      const isReadonly = !isMethod && !member.declarations?.some(ts.isSetAccessor);
      return /** @type {Member} */ ({
        kind: isMethod ? 'method' : 'field',
        name: member.name,
        description: words(member),
        ...(isMethod ? signatureOf(member) : { type: { text: textOf(member) } }),
        ...(isReadonly && { readonly: true }),
        ...inherited(declaration.parent),
      });
    });
    const listener = symbol.members?.get(ts.escapeLeadingUnderscores('addEventListener'))?.declarations?.[0];
    const names = listener && ts.isMethodSignature(listener) ? listener.typeParameters?.[0]?.constraint : undefined;
    if (!names || !ts.isTypeOperatorNode(names)) throw new Error(`${own.name.text} types no events.`);
    const events = checker
      .getPropertiesOfType(checker.getTypeFromTypeNode(names.type))
      .map((event) => ({ name: event.name, type: { text: textOf(event) }, description: words(event) }));
    return {
      tagName: tag.name,
      name: own.name.text,
      module: moduleOf(own),
      description: words(symbol),
      members,
      attributes: tagged('attr').map((each) => ({ type: { text: 'string' }, ...each })),
      events,
      slots: tagged('slot'),
      cssParts: tagged('csspart'),
      cssProperties: tagged('cssprop'),
    };
  });
}

/** The manifest's text. @param {Element[]} elements */
export function manifestOf(elements) {
  const modules = elements.map(({ module, tagName, name, attributes, members, ...rest }) => ({
    kind: 'javascript-module',
    path: module,
    declarations: [
      {
        kind: 'class',
        customElement: true,
        tagName,
        name,
        superclass: { name: 'HTMLElement' },
        ...rest,
        attributes: attributes.map((each) =>
          members.some((m) => m.name === each.name) ? { ...each, fieldName: each.name } : each,
        ),
        members,
      },
    ],
    exports: [
      { kind: 'js', name, declaration: { name, module } },
      { kind: 'custom-element-definition', name: tagName, declaration: { name, module } },
    ],
  }));
  return `${JSON.stringify({ schemaVersion: '1.0.0', readme: '', modules }, null, 2)}\n`;
}
