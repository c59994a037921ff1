// The reference of the API, from the sources' doc comments, as pages of the site.
import { existsSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { at } from './paths.mjs';

/** Tags of the elements' manifest, which say nothing of the API. */
const ELEMENT_TAGS = /** @type {const} */ (['@attr', '@csspart', '@cssprop', '@slot']);

/** What the names of types hang on, and nobody needs. */
const INNER = ['CULPRIT_KINDS', 'ERROR_CODES', 'WARNING_CODES', 'BODY_ACCESSORS'];

/**
 * The source of each of the package's entries that has one and exports something, and the name that it is imported by.
 * @param {{ exports: Record<string, string | { types: string }> }} manifest
 */
function entriesOf({ exports }) {
  /** @type {Map<string, string>} */
  const entries = new Map();
  for (const [entry, target] of Object.entries(exports)) {
    const source = typeof target === 'string' ? '' : target.types.replace('./dist/', '').replace(/\.d\.ts$/, '.ts');
    const isOne = source && existsSync(at(source)) && /^export /m.test(readFileSync(at(source), 'utf8'));
    if (isOne && !entries.has(source)) entries.set(source, path.posix.join('handlebody', entry));
  }
  return entries;
}

/** Writes the pages; a warning fails. @param {string} folder */
export async function buildApiReference(folder) {
  const { Application, OptionDefaults } = await import('typedoc');
  const manifest = JSON.parse(readFileSync(at('package.json'), 'utf8'));
  /** Where the sources are to be seen: `repository` in package.json, absent until there is one. @type {string | undefined} */
  const repository = (manifest.repository?.url ?? manifest.repository)?.replace(/^git\+|\.git$/g, '');
  const entries = entriesOf(manifest);
  const app = await Application.bootstrap({
    entryPoints: [...entries.keys()].map((source) => at(source)),
    name: 'Handlebody',
    out: folder,
    tsconfig: at('tsconfig.build.json'),
    readme: 'none',
    excludeInternal: true,
    excludePrivate: true,
    excludeProtected: true,
    excludeExternals: true,
    excludeTags: [...ELEMENT_TAGS],
    blockTags: [...OptionDefaults.blockTags, ...ELEMENT_TAGS],
    intentionallyNotExported: INNER,
    externalSymbolLinkMappings: { '@gltf-transform/core': { '*': 'https://gltf-transform.dev/' } },
    treatWarningsAsErrors: true,
    logLevel: 'Warn',
    hideGenerator: true,
    navigationLinks: { 'The site': '../' },
    githubPages: false,
    ...(repository
      ? { sourceLinkTemplate: `${repository}/blob/v${manifest.version}/{path}#L{line}`, disableGit: true }
      : { disableSources: true }),
  });
  const project = await app.convert();
  if (!project) throw new Error('The sources do not compile, so there is no reference of the API.');
  // By what it is imported by, and not by its file.
  for (const module of project.children ?? []) {
    const [source] = [...entries].find(([file]) => [file, file.replace('/index.ts', '.ts')].includes(`${module.name}.ts`)) ?? [];
    if (!source) throw new Error(`The reference of the API has a module "${module.name}", which is no entry.`);
    module.name = entries.get(source) ?? '';
  }
  app.validate(project);
  await app.generateOutputs(project);
  const { warningCount, errorCount } = app.logger;
  if (warningCount + errorCount > 0)
    throw new Error(`The reference of the API has ${warningCount} warnings and ${errorCount} errors.`);
}
