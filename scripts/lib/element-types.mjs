// Types of the tags for what writes HTML by program: React's JSX, Vue's templates and Svelte's, from the same reading of the sources as the
// manifest. Each is asked for by an import of its own, so that none of the three has to be installed.

/** @typedef {import('./elements-manifest.mjs').Element} Element */

/** @param {string} className */
const stem = (className) => className.replace(/Element$/, '');

/** A text type of the manifest, as a property of the element takes it. @param {Element} element @param {string} name @param {string} text */
function propOf({ name: className, members }, name, text) {
  const member = members.find((each) => each.name === name && !each.readonly);
  const isPlain = !member || ['string', 'boolean'].includes(member.type?.text ?? '');
  return isPlain ? text : `${text} | ${className}['${name}']`;
}

/** What each tag takes: attributes, and properties that can be set. @param {Element[]} elements */
function propsFile(elements) {
  const names = elements.map(({ name }) => `${name}, ${stem(name)}Events`).join(', ');
  const blocks = elements.map((element) => {
    const attributes = element.attributes.map(({ name, description, type }) => ({
      name,
      description,
      type: propOf(element, name, type?.text ?? 'string'),
    }));
    const properties = element.members
      .filter(({ kind, readonly, name }) => kind === 'field' && !readonly && !attributes.some((each) => each.name === name))
      .map(({ name, description }) => ({ name, description, type: `${element.name}['${name}']` }));
    const lines = [...attributes, ...properties].map(
      ({ name, description, type }) => `  /** ${description} */\n  ${name}?: ${type} | undefined;\n`,
    );
    return `export interface ${stem(element.name)}Props {\n${lines.join('')}}\n`;
  });
  return `import type { ${elements.map(({ name }) => name).join(', ')} } from './index.js';
export type { ${names} } from './index.js';
${blocks.join('')}`;
}

/** @param {Element[]} elements @param {(element: Element) => string} typeOf */
const tagLines = (elements, typeOf) => elements.map((each) => `    '${each.tagName}': ${typeOf(each)};\n`).join('');

/** @param {Element[]} elements */
const importLine = (elements) =>
  `import type { ${elements.flatMap(({ name }) => [name, `${stem(name)}Events`, `${stem(name)}Props`]).join(', ')} } from './props.js';\n`;

/** @param {Element} element */
const three = ({ name }) => `${name}, ${stem(name)}Props, ${stem(name)}Events`;

/** React 18 and 19. Event properties (\`onchange\`, as custom elements have them) are heard by 19 alone. @param {Element[]} elements */
const reactFile = (elements) => `import type { DetailedHTMLProps, HTMLAttributes } from 'react';
${importLine(elements)}
type Listeners<Events> = { [K in keyof Events as \`on\${K & string}\`]?: (event: Events[K]) => void };
type Tag<E, Props, Events> = Omit<DetailedHTMLProps<HTMLAttributes<E>, E>, keyof Props> & Props & Listeners<Events> & { class?: string };
declare module 'react' {
  namespace JSX {
    interface IntrinsicElements {
${tagLines(elements, (each) => `Tag<${three(each)}>`)
  .replace(/^/gm, '  ')
  .trimEnd()}
    }
  }
}
`;

/** @param {Element[]} elements */
const vueFile = (elements) => `import type { HTMLAttributes, ReservedProps } from 'vue';
${importLine(elements)}
type Listeners<Events> = { [K in keyof Events as \`on\${Capitalize<K & string>}\`]?: (event: Events[K]) => void };
type Props<P, L> = Omit<HTMLAttributes, keyof P | keyof L> & ReservedProps & P & L;
type Tag<E, P, Events> = new () => E & { $props: Props<P, Listeners<Events>> };
declare module 'vue' {
  interface GlobalComponents {
${tagLines(elements, (each) => `Tag<${three(each)}>`)}  }
}
`;

/** Svelte 4's \`on:change\` and 5's \`onchange\`. @param {Element[]} elements */
const svelteFile = (elements) => `import type { HTMLAttributes } from 'svelte/elements';
${importLine(elements)}
type Listeners<Events> = { [K in keyof Events as \`on\${K & string}\` | \`on:\${K & string}\`]?: (event: Events[K]) => void };
type Props<E extends EventTarget, P, L> = Omit<HTMLAttributes<E>, keyof P | keyof L> & P & L;
type Tag<E extends EventTarget, P, Events> = Props<E, P, Listeners<Events>>;
declare module 'svelte/elements' {
  interface SvelteHTMLElements {
${tagLines(elements, (each) => `Tag<${three(each)}>`)}  }
}
`;

/** The files, by their names; the scripts say nothing, since the types are all there is. @param {Element[]} elements @returns {Record<string, string>} */
export function elementTypes(elements) {
  const nothing = 'export {};\n';
  return {
    'props.d.ts': propsFile(elements),
    'react.d.ts': reactFile(elements),
    'vue.d.ts': vueFile(elements),
    'svelte.d.ts': svelteFile(elements),
    'react.js': nothing,
    'vue.js': nothing,
    'svelte.js': nothing,
  };
}
