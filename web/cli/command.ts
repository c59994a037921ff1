import { setImmediate } from 'node:timers/promises';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { type Options, parseCommandLine, READS, usageError } from './arguments.ts';
import { BAKE_OPTIONS, bakeCommand } from './bake.ts';
import { Clock } from './clock.ts';
import { DEFORM_OPTIONS, deformCommand } from './deform.ts';
import { EMBED_OPTIONS, embedCommand } from './embed.ts';
import { EXIT } from './exit-codes.ts';
import { reason, STANDARD_OUTPUT, unwritable } from './files.ts';
import { HELP } from './help.ts';
import { inspectCommand } from './inspect.ts';
import { packageVersion } from './package.ts';
import { POSE_OPTIONS, poseCommand } from './pose.ts';
import { Report } from './report.ts';
import type { Run } from './run.ts';
import { isStandardOutput } from './special-files.ts';

const COMMANDS = new Map<string, { options: Options; run: (run: Run) => Promise<void> }>([
  ['bake', { options: BAKE_OPTIONS, run: bakeCommand }],
  ['deform', { options: DEFORM_OPTIONS, run: deformCommand }],
  ['pose', { options: POSE_OPTIONS, run: poseCommand }],
  ['embed', { options: EMBED_OPTIONS, run: embedCommand }],
  ['inspect', { options: READS, run: inspectCommand }],
]);

/** Runs the command with its arguments and returns the status that it ends with. Never throws. */
export async function runCommand(args: readonly string[]): Promise<number> {
  const report = new Report();
  // Whether errors are JSON has to be known before the arguments are understood.
  report.json = args.includes('--json');
  const interrupt = new AbortController();
  const stop = impatient(() => interrupt.abort());
  process.on('SIGINT', stop).on('SIGTERM', stop);
  // Where standard error cannot be written there is nobody to tell it to. The listeners stay: a stream may fail after all was said.
  if (!process.stdout.listeners('error').includes(noteLoss))
    for (const [stream, listen] of [[process.stdout, noteLoss] as const, [process.stderr, () => {}] as const])
      stream.on('error', listen);
  lost = undefined;
  try {
    const status = await dispatch(args, report, interrupt.signal).catch((error: unknown) =>
      report.error(interrupt.signal.aborted ? interrupted() : error),
    );
    await setImmediate();
    if (lost === undefined || status === EXIT.output) return status;
    report.leaveStandardOutput();
    return report.error(unwritable(STANDARD_OUTPUT, reason(lost), lost));
  } finally {
    process.off('SIGINT', stop).off('SIGTERM', stop);
  }
}

async function dispatch([name, ...args]: readonly string[], report: Report, signal: AbortSignal): Promise<number> {
  if (name === undefined) {
    process.stderr.write(`${HELP['']}\n`);
    return EXIT.usage;
  }
  if (name === '--version' || name === '-V') {
    process.stdout.write(`${packageVersion()}\n`);
    return EXIT.ok;
  }
  if (name === '--help' || name === '-h' || name === 'help') {
    const [asked = ''] = args.filter((word) => !word.startsWith('-'));
    if (asked !== '' && asked !== 'help' && !COMMANDS.has(asked)) throw unknownCommand(asked);
    process.stdout.write(`${HELP[asked] ?? HELP['']}\n`);
    return EXIT.ok;
  }
  const command = COMMANDS.get(name);
  if (!command) throw unknownCommand(name);
  if (args.includes('--help') || args.includes('-h')) {
    process.stdout.write(`${HELP[name]}\n`);
    return EXIT.ok;
  }
  const { values, words } = parseCommandLine(name, args, command.options);
  report.quiet = values.quiet === true;
  if (isStandardOutput(values.output)) report.leaveStandardOutput();
  await command.run({ values, words, report, signal, clock: new Clock() });
  return EXIT.ok;
}

function unknownCommand(name: string): HandlebodyError {
  return usageError(`There is no command "${name.slice(0, 80)}".`, `Use one of: ${[...COMMANDS.keys()].join(', ')}.`);
}

/** Ctrl-C lets the work end in order. One that comes a second later ends it at once: nothing half-written is ever there to clean up. */
function impatient(stop: () => void): () => void {
  let first = Number.POSITIVE_INFINITY;
  return () => {
    if (performance.now() - first > 1000) process.exit(EXIT.interrupted);
    first = Math.min(first, performance.now());
    stop();
  };
}

function interrupted(): HandlebodyError {
  return new HandlebodyError('aborted', {
    message: 'The work was interrupted; nothing was written.',
    remedy: 'Start it again when you need it.',
  });
}

/** Why standard output did not take what was said. */
let lost: unknown;

/** "handlebody inspect … | head" closes the pipe before all is said, which is no error. */
function noteLoss(error: NodeJS.ErrnoException): void {
  if (error.code !== 'EPIPE') lost ??= error;
}
