import { ease } from '../../ui/motion.ts';
import type { Handle } from './experiment.ts';

/** Milliseconds that a pose takes to be struck. */
const DURATION = 700;

/** The way from one pose of handles to another. */
export class Ease {
  readonly #from: readonly Handle[];
  readonly #start = performance.now();

  constructor(from: readonly Handle[]) {
    this.#from = from;
  }

  get isOver(): boolean {
    return performance.now() - this.#start >= DURATION;
  }

  /** The handles on their way to a pose. */
  at(to: readonly Handle[]): readonly Handle[] {
    const part = ease((performance.now() - this.#start) / DURATION);
    const between = (a: number, b: number) => a + (b - a) * part;
    return to.map((handle, i) => {
      const from = this.#from[i] ?? handle;
      const move = [between(from.move[0], handle.move[0]), between(from.move[1], handle.move[1])] as const;
      return { ...handle, move, turn: between(from.turn, handle.turn) };
    });
  }
}
