/** What objects hold of the solver's memory, and how it comes back when they are forgotten. */
import type { Exports, RuntimeExports } from './abi.generated.ts';

/** The functions that free an object: called by name, since a function made beside an object would hold it. */
export type FreeName = Extract<keyof Exports, `hb_${string}_free`>;

/** What is wanted of a `Heap`. */
interface Memory {
  readonly kernels: { remove(id: number): void };
  alloc(bytes: number): number;
  release(run: (exports: RuntimeExports) => void): void;
  expectUsable(): unknown;
}

/**
 * The solver's side of one object: what the solver made, blocks of memory beside it, and a user of a caller's kernel. It knows nothing of the
 * object that it belongs to, which can therefore be collected. Made by `Heap.own`.
 */
export class Owned {
  readonly #heap: Memory;
  readonly #free: FreeName;
  #pointer: number;
  /** Addresses of blocks; 0 for none. */
  readonly blocks: number[] = [];
  /** The number of a caller's kernel, of which this is a user; 0 for none. */
  kernel: number;

  constructor(heap: Memory, free: FreeName, pointer: number, kernel: number) {
    [this.#heap, this.#free, this.#pointer, this.kernel] = [heap, free, pointer, kernel];
  }

  /** What the solver made; 0 once it is released. Throws where the instance has ended: 'disposed', 'wasm-trapped'. */
  get pointer(): number {
    if (this.#pointer !== 0) this.#heap.expectUsable();
    return this.#pointer;
  }

  /** One more block, while the object is made: where there is none, all that it has is given back. */
  alloc(bytes: number): number {
    try {
      const block = this.#heap.alloc(bytes);
      this.blocks.push(block);
      return block;
    } catch (error) {
      this.release();
      throw error;
    }
  }

  /** Gives everything back; once. Of an instance that has ended, everything is gone already. */
  release(): void {
    const pointer = this.#pointer;
    if (pointer === 0) return;
    // In a kernel this throws, and nothing has changed then: what is running may need it.
    this.#heap.release((e) => {
      (e as Exports)[this.#free](pointer);
      for (const block of this.blocks) e.hb_release(block);
    });
    this.#pointer = 0;
    this.#heap.kernels.remove(this.kernel);
  }
}
