// Compiling with CMake: as many compilers at once as the machine bears, and a line now and then that says how far it is.
import { availableParallelism, totalmem } from 'node:os';
import { run } from './run.mjs';

/** What one compiler takes of Eigen's templates at its worst, with room for the linker: most take a third of it. */
export const JOB_BYTES = 700e6;

/**
 * How many compilers may run at once: one a core, as far as memory goes. Without a number make has no limit, and eighty compilers stop a laptop.
 * @param {{ cores: number, memory: number }} [machine] `memory` in bytes, what is free of it
 */
export function buildJobs({ cores, memory } = thisMachine()) {
  return Math.max(1, Math.min(cores, Math.floor(memory / JOB_BYTES)));
}

/** Free memory is read low where the system keeps old files in it: a quarter of all there is can always be had. */
function thisMachine() {
  return { cores: availableParallelism(), memory: Math.max(process.availableMemory(), totalmem() / 4) };
}

/**
 * Builds targets, all where none is named, with a line of progress for every tenth of the work; what a compiler says comes through whole.
 * @param {string} folder configured before
 * @param {{ targets?: readonly string[], env?: NodeJS.ProcessEnv }} [options]
 * @returns {Promise<number>} CMake's status
 */
export async function cmakeBuild(folder, { targets = [], env } = {}) {
  const jobs = buildJobs();
  console.log(`Compiling${targets.length > 0 ? ` ${targets.join(', ')}` : ''}, ${jobs} at once …`);
  const start = performance.now();
  const progress = new BuildProgress((line) => console.log(line));
  const status = await run(
    'cmake',
    ['--build', folder, '--parallel', `${jobs}`, ...(targets.length > 0 ? ['--target', ...targets] : [])],
    {
      ...(env && { env }),
      behind: true,
      stdio: ['ignore', 'pipe', 'inherit'],
      onOutput: (text) => progress.add(text),
    },
  );
  progress.end();
  console.log(`${status === 0 ? 'Compiled' : 'Not compiled'} (${((performance.now() - start) / 1000).toFixed(0)} s).`);
  return status;
}

/** Reads what ninja or make say and passes on every tenth of their steps, and all that is not a step. */
export class BuildProgress {
  #rest = '';
  #told = 0;
  #write;

  /** @param {(line: string) => void} write */
  constructor(write) {
    this.#write = write;
  }

  /** @param {string} text */
  add(text) {
    const lines = (this.#rest + text).split(/\r?\n/);
    this.#rest = lines.pop() ?? '';
    for (const line of lines) this.#read(line);
  }

  end() {
    if (this.#rest) this.#read(this.#rest);
    this.#rest = '';
  }

  /** @param {string} line */
  #read(line) {
    const steps = line.match(/^\[(\d+)\/(\d+)\] /);
    const percent = line.match(/^\[ *(\d+)%\] /);
    if (!steps && !percent) {
      // Make names the folders that it enters and what it scans; ninja says when there is nothing to do.
      if (line !== '' && !/^(make|gmake)(\[\d+\])?: |^(Scanning|Consolidate) |^ninja: (no work|Entering)|^-- /.test(line))
        this.#write(line);
      return;
    }
    const tenth = Math.floor(steps ? (10 * Number(steps[1])) / Number(steps[2]) : Number(percent?.[1]) / 10);
    if (steps && tenth < this.#told) this.#told = 0; // ninja looked for new sources first, and counts again
    if (tenth <= this.#told) return;
    this.#told = tenth;
    this.#write(`  ${(this.#told * 10).toString().padStart(3)} %${steps ? ` (${steps[1]} of ${steps[2]})` : ''}`);
  }
}

/**
 * Does it to each, so many at once as there may be compilers.
 * @template T @param {readonly T[]} items @param {(item: T) => Promise<void>} work
 */
export async function sideBySide(items, work) {
  const queue = [...items];
  const worker = async () => {
    for (let item = queue.shift(); item !== undefined; item = queue.shift()) await work(item);
  };
  await Promise.all(Array.from({ length: buildJobs() }, worker));
}
