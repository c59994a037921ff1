import { existsSync } from 'node:fs';
import path from 'node:path';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { fileFormat } from '../assets/file-format.ts';
import { readBody, readMesh, readPoseSpaces } from '../assets/index.ts';
import { openAsGlb } from '../assets/open-gltf.ts';
import { FIGURES, type Listed } from '../figures/list.ts';
import { type Options, theFile, theOutput, usageError, type Values, WRITES } from './arguments.ts';
import { type Content, embedPage } from './embed-page.ts';
import { prepareOutput, readInput, writeOutput } from './files.ts';
import { filesBeside } from './files-beside.ts';
import { naming, readModel } from './model.ts';
import { nearest } from './nearest.ts';
import type { Run } from './run.ts';

export const EMBED_OPTIONS: Options = { ...WRITES, state: { type: 'string' }, title: { type: 'string' } };

/** What is embedded, and what the result says of it. */
interface Found {
  readonly content: Content;
  readonly facts: object;
  readonly line: string;
}

/** `handlebody embed`: a figure, or a model with its element, as one page that needs nothing else. */
export async function embedCommand({ values, words, report, signal, clock }: Run): Promise<void> {
  const word = theFile('embed', words, 'the name of a figure, or a model');
  const figure = figureOf(word);
  const name = theOutput('embed', values, 'html');
  const output = prepareOutput(name, { inputs: figure ? [] : [word], force: values.force === true });
  const { content, facts, line } = figure ? describeFigure(figure, values) : await describeModel(word, values);
  if (content.kind === 'handle-body' && !content.baked)
    report.note(`"${word}" is not baked: the page does that each time it opens. "handlebody bake" does it once.`);
  clock.lap('read');
  const { bytes, modules } = embedPage(content);
  await writeOutput(output, bytes, signal);
  clock.lap('write');
  report.result(
    { command: 'embed', ...facts, title: content.title, output: output.name, bytes: bytes.length, modules, timings: clock.laps() },
    [`${output.name}: ${line}, ${(bytes.length / 1e6).toFixed(2)} MB; it needs no other file and no network`],
  );
}

/** A figure of the list by "course-12", "course-12?v1&narrow" or with "#" or "&" instead; nothing where a file is meant. */
function figureOf(word: string): { readonly listed: Listed; readonly state: string | undefined } | undefined {
  const [, name = '', state] = /^([^?#&]*)(?:[?#&](.*))?$/s.exec(word) ?? [];
  const listed = FIGURES.find(({ id }) => id === name);
  if (listed) return { listed, state };
  if (existsSync(word) || /[./\\]/.test(name)) return undefined;
  const ids = FIGURES.map(({ id }) => id);
  throw new HandlebodyError('unknown-figure', {
    message: `There is no figure "${name}", and no file of that name.`,
    remedy: `Did you mean ${nearest(name, ids).join(' or ')}? There are: ${ids.join(', ')}.`,
  });
}

function describeFigure({ listed, state }: NonNullable<ReturnType<typeof figureOf>>, values: Values): Found {
  if (state !== undefined && values.state !== undefined)
    throw usageError('The state is given twice: after the name, and by --state.', 'Give it once.');
  const text = (state ?? (values.state as string | undefined) ?? '').replace(/^#/, '');
  const title = (values.title as string | undefined) ?? listed.title;
  return {
    content: { kind: 'handle-figure', id: listed.id, state: text, title },
    facts: { figure: listed.id, ...(text && { state: text }) },
    line: `the figure ${listed.id}`,
  };
}

async function describeModel(file: string, values: Values): Promise<Found> {
  if (values.state !== undefined) throw usageError('--state is for figures; a model has none.', 'Leave it out.');
  const bytes = await readInput(file);
  const format = fileFormat(bytes, file);
  if (format !== 'GLB' && format !== 'glTF') {
    throw new HandlebodyError('file-not-glb', {
      message: `"${file}" is ${format === 'PLY' ? 'a' : 'an'} ${format} model, and pages show GLB.`,
      remedy: 'Bake it with "handlebody bake", which makes a GLB of it, and embed that.',
    });
  }
  try {
    // A page that works offline fetches nothing, and its elements read GLB: everything goes inside, plain.
    const glb = await openAsGlb(bytes, { resource: filesBeside(file) });
    const { document } = await readModel(glb, file);
    const baked = (await readBody(document)) !== undefined;
    // A body is dragged, though it have a face, too.
    const kind = !baked && readPoseSpaces(document).length > 0 ? 'pose-space' : 'handle-body';
    // What has no surface is refused here, not by the page.
    readMesh(document);
    const title = (values.title as string | undefined) ?? path.basename(file, path.extname(file));
    const element = { 'handle-body': 'a model to drag', 'pose-space': 'a model with a pose space' }[kind];
    return { content: { kind, glb, title, baked }, facts: { input: file, element: kind, baked }, line: element };
  } catch (error) {
    throw naming(file, error);
  }
}
