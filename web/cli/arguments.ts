/** The command line as checked values. What cannot be meant is a 'usage' error. */
import { type ParseArgsConfig, parseArgs } from 'node:util';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { isSpecial, isStandardOutput } from './special-files.ts';

export type Options = NonNullable<ParseArgsConfig['options']>;
export type Values = Record<string, string | boolean | (string | boolean)[] | undefined>;

/** What every subcommand takes. */
const COMMON: Options = {
  json: { type: 'boolean' },
  quiet: { type: 'boolean', short: 'q' },
  help: { type: 'boolean', short: 'h' },
};

/** And those that write a file. */
export const WRITES: Options = { output: { type: 'string', short: 'o' }, force: { type: 'boolean', short: 'f' } };

/** And those that read a model of any format. */
export const READS: Options = { strict: { type: 'boolean' } };

export function usageError(message: string, remedy: string): HandlebodyError {
  return new HandlebodyError('usage', { message, remedy });
}

/** Options and words of a subcommand. An option given twice is refused, since one of the two would be silently lost. */
export function parseCommandLine(command: string, args: string[], own: Options): { values: Values; words: string[] } {
  const remedy = `Run "handlebody ${command} --help" to see what it takes.`;
  try {
    const { values, positionals, tokens } = parseArgs({
      args: joinPlace(args),
      options: { ...COMMON, ...own },
      allowPositionals: true,
      tokens: true,
    });
    const names = tokens.flatMap((token) => (token.kind === 'option' ? [token.name] : []));
    const twice = names.find((name, i) => names.indexOf(name) !== i);
    if (twice) throw usageError(`--${twice} is given twice.`, 'Give it once.');
    return { values: values as Values, words: positionals };
  } catch (error) {
    if (error instanceof HandlebodyError) throw error;
    // Node's own sentence, without the advice on "--" that follows it.
    const [sentence = ''] = (error instanceof Error ? error.message : String(error)).split(/(?<=')\. |\n/);
    throw usageError(`${sentence.replace(/\.$/, '')}.`, remedy);
  }
}

/** The one file that a subcommand works on. */
export function theFile(command: string, words: readonly string[], what: string): string {
  const [file, ...rest] = words;
  if (file === undefined || file === '')
    throw usageError(`"handlebody ${command}" needs ${what}.`, `See "handlebody ${command} --help".`);
  if (rest.length > 0)
    throw usageError(
      `There is more than one file: "${file}" and "${rest[0]}".`,
      command === 'pose'
        ? 'Give one; the output comes after -o, and a place without blanks after --at: NAME=X,NAME=Y.'
        : 'Give one; the output comes after -o.',
    );
  return file;
}

/** Names of other formats, under which a page would not be looked for. */
const NO_HTML = /\.(obj|ply|glb|gltf|stl|off|fbx|usdz|json)$/i;

/** The output, which has to be asked for, and not by the name of a format that is not written; devices and pipes have any name. */
export function theOutput(command: string, values: Values, format: 'glb' | 'html' = 'glb'): string {
  const output = values.output;
  if (typeof output !== 'string' || output === '') {
    throw usageError(`"handlebody ${command}" needs to know where to write.`, `Add -o and the name of a .${format} file.`);
  }
  const fits = format === 'glb' ? /\.glb$/i.test(output) : !NO_HTML.test(output);
  if (!fits && !isStandardOutput(output) && !isSpecial(output)) {
    const written = format.toUpperCase();
    throw usageError(`"${output}" would not be what its name says: ${written} is written.`, `Let its name end in .${format}.`);
  }
  return output;
}

/** A positive whole number, or undefined where the option is not given. */
export function count(values: Values, name: string): number | undefined {
  const value = values[name];
  if (value === undefined) return undefined;
  const number = Number(value);
  if (typeof value === 'string' && /^\d+$/.test(value) && number >= 1 && number <= 0x7fff_ffff) return number;
  throw usageError(`--${name} is "${value}".`, 'Give a positive whole number.');
}

/** A number from a least to a greatest, or undefined where the option is not given. */
export function numberBetween(values: Values, name: string, least: number, greatest: number): number | undefined {
  const value = values[name];
  if (value === undefined) return undefined;
  const number = Number(value);
  if (typeof value === 'string' && value.trim() !== '' && number >= least && number <= greatest) return number;
  throw usageError(`--${name} is "${value}".`, `Give a number from ${least} to ${greatest}.`);
}

/** One of some words, or undefined where the option is not given. */
export function oneOf<T extends string>(values: Values, name: string, known: readonly T[]): T | undefined {
  const value = values[name];
  if (value === undefined || known.includes(value as T)) return value as T | undefined;
  throw usageError(`--${name} is "${value}".`, `Use one of: ${known.join(', ')}.`);
}

/** What may be a part of a place: "valence=0.6", or a number, which is told to lack its name. */
const PART = /=|^[-+]?\.?\d[^/\\]*$/;

/**
 * A place may be several words, "--at valence=0.6 arousal=0.4", and begin with a dash, "--at -x=1", which Node takes for an option: both
 * become one word.
 */
function joinPlace(args: readonly string[]): string[] {
  const out: string[] = [];
  let isPlace = false;
  for (const arg of args) {
    const isPart = PART.test(arg) && !arg.startsWith('--');
    if (out.at(-1) === '--at' && (isPart || !arg.startsWith('-'))) out[out.length - 1] = `--at=${arg}`;
    else if (isPlace && isPart) out[out.length - 1] += `,${arg}`;
    else out.push(arg);
    isPlace = /^--at=/.test(out.at(-1) ?? '');
  }
  return out;
}
