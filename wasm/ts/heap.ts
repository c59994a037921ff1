import { CULPRIT_KINDS, ERROR_CODES, LAYOUT, type RuntimeExports } from './abi.generated.ts';
import { type Culprit, HandlebodyError } from './errors.ts';
import { HostKernels } from './host-kernels.ts';
import { type FreeName, Owned } from './owned.ts';

type NumberArray = ArrayLike<number> & { readonly length: number };

/**
 * The only code that touches wasm memory. Any call into the module may grow its memory, after which every earlier view silently reads as
 * empty: so views are made fresh by each method here and never kept. `Heap<Exports>` belongs to the whole solver and can be used wherever a
 * `Heap` can.
 */
export class Heap<E extends RuntimeExports = RuntimeExports> {
  /** Callers' kernels, which the solver calls back. */
  readonly kernels: HostKernels;
  /** None after `dispose()`: what a wasm instance holds is collected once nothing refers to its functions. */
  #exports: E | undefined;
  #trapped: unknown;
  #running = false;
  readonly #stack: number | undefined;
  /** Gives back what forgotten objects held; where there is none such, only `dispose()` does. */
  readonly #registry =
    typeof FinalizationRegistry === 'function' ? new FinalizationRegistry<Owned>((owned) => this.#forget(owned)) : undefined;
  /** Forgotten in the middle of a call, as where a kernel lets events in. */
  readonly #forgotten: Owned[] = [];

  constructor(exports: E, kernels = new HostKernels()) {
    this.#exports = exports;
    this.kernels = kernels;
    this.#stack = (exports as Stack).stackSave?.();
  }

  /** The instance's memory in bytes, now. */
  get byteLength(): number {
    return this.#exports?.memory.buffer.byteLength ?? 0;
  }

  /** Whether `dispose()` was called. */
  get disposed(): boolean {
    return this.#exports === undefined;
  }

  /** Neither disposed of nor poisoned by a trap. */
  get usable(): boolean {
    return !this.disposed && this.#trapped === undefined;
  }

  /** Ends the instance and lets go of its memory. Everything that needs it throws 'disposed' from then on. */
  dispose(): void {
    this.#exports = undefined;
    this.kernels.clear();
  }

  f64(pointer: number, length: number): Float64Array {
    return new Float64Array(this.#alive().memory.buffer, pointer >>> 0, length);
  }
  f32(pointer: number, length: number): Float32Array {
    return new Float32Array(this.#alive().memory.buffer, pointer >>> 0, length);
  }
  u32(pointer: number, length: number): Uint32Array {
    return new Uint32Array(this.#alive().memory.buffer, pointer >>> 0, length);
  }
  u8(pointer: number, length: number): Uint8Array {
    return new Uint8Array(this.#alive().memory.buffer, pointer >>> 0, length);
  }
  u16(pointer: number, length: number): Uint16Array {
    return new Uint16Array(this.#alive().memory.buffer, pointer >>> 0, length);
  }

  /** Reserves `bytes` of zeroed memory, 16-byte aligned. Throws 'out-of-memory' when there is none. */
  alloc(bytes: number): number {
    const pointer = bytes <= 0xffff_ffff ? this.call((e) => e.hb_alloc(Math.max(bytes, 16))) >>> 0 : 0;
    if (pointer === 0) {
      throw outOfMemory(bytes);
    }
    new Uint8Array(this.#alive().memory.buffer, pointer, bytes).fill(0);
    return pointer;
  }

  free(pointer: number): void {
    if (pointer !== 0 && this.#trapped === undefined) this.#exports?.hb_release(pointer);
  }

  /**
   * What `owner` holds from now on: what the solver made, as many blocks, and a user of the kernel of that number. Released by the owner's
   * `dispose()`, or when the owner is forgotten; and at once where a block cannot be had.
   */
  own(owner: object, free: FreeName, pointer: number, { blocks = [], kernel = 0 }: Owning = {}): Owned {
    const owned = new Owned(this, free, pointer, kernel);
    for (const bytes of blocks) owned.alloc(bytes);
    this.#registry?.register(owner, owned);
    return owned;
  }

  /** Calls what frees an object; with an instance that has ended, its objects are gone already. */
  release(run: (exports: E) => void): void {
    if (this.usable) this.call(run);
  }

  /**
   * Calls into the module. Where memory runs out on the way, what the call took is given back and 'out-of-memory' is thrown. Any other trap
   * is a defect, and poisons the instance: its state is unknown.
   */
  call<T>(run: (exports: E) => T): T {
    const exports = this.expectUsable();
    if (this.#running) {
      throw new HandlebodyError('invalid-option', {
        message: 'A kernel called the solver that was calling it.',
        remedy: 'Let a kernel compute its number by itself, or use a second instance in it.',
      });
    }
    this.#running = true;
    try {
      exports.hb_begin_call?.();
      return run(exports);
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError || error instanceof RangeError)) throw error;
      const wanted = this.#undo(exports);
      if (wanted > 0) throw outOfMemory(wanted);
      this.#trapped = error;
      throw this.#poisoned();
    } finally {
      this.#running = false;
      if (this.#forgotten.length > 0) for (const owned of this.#forgotten.splice(0)) this.#forget(owned);
    }
  }

  /** The bytes for want of which the call trapped; 0 where it trapped for something else. */
  #undo(exports: E): number {
    try {
      const wanted = (exports.hb_undo_call?.() ?? 0) >>> 0;
      // What a trap leaves on the stack nobody takes off.
      if (wanted > 0) (exports as Stack).stackRestore?.(this.#stack ?? 0);
      return wanted;
    } catch {
      return 0;
    }
  }

  /** Runs in a turn of its own, where nobody would hear of an error: an instance that stops here says so at the next call. */
  #forget(owned: Owned): void {
    try {
      if (this.#running) this.#forgotten.push(owned);
      else owned.release();
    } catch {}
  }

  /** Calls a function that returns a status; throws its error. */
  check(run: (exports: E) => number): void {
    if (this.call(run) !== 0) throw this.#lastError();
  }

  /**
   * Runs `body` with scratch memory that is released afterwards, whatever happens. `scratch.put(array)` copies an array in and
   * returns its address; `scratch.reserve(bytes)` is uninitialised output space.
   */
  scope<T>(body: (scratch: Scratch) => T): T {
    const scratch = new Scratch(this);
    try {
      return body(scratch);
    } finally {
      scratch.release();
    }
  }

  /** Throws 'disposed' or 'wasm-trapped' where the instance has ended. */
  expectUsable(): E {
    if (this.#trapped !== undefined && this.#exports) throw this.#poisoned();
    return this.#alive();
  }

  #alive(): E {
    if (this.#exports) return this.#exports;
    throw new HandlebodyError('disposed', {
      message: 'This solver was disposed of, and with it all that it made.',
      remedy: 'Call load() for another one.',
    });
  }

  #poisoned(): HandlebodyError {
    return new HandlebodyError('wasm-trapped', {
      message: 'The solver stopped unexpectedly and cannot be used any more.',
      remedy: 'Call load() again for a fresh one, and please report what led here.',
      cause: this.#trapped,
    });
  }

  #lastError(): HandlebodyError {
    const at = this.call((e) => e.hb_last_error()) >>> 0;
    const { buffer } = this.#alive().memory;
    const layout = LAYOUT.hb_error;
    const numbers = new Int32Array(buffer, at, 3);
    const [code = 1, kind = 0, index = -1] = numbers;
    const text = (offset: number, end: number) => {
      const bytes = new Uint8Array(buffer, at + offset, end - offset);
      return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
    };
    const name = CULPRIT_KINDS[kind as keyof typeof CULPRIT_KINDS];
    const culprit: Culprit | undefined = name === undefined || name === 'none' ? undefined : { kind: name, index };
    return new HandlebodyError(ERROR_CODES[code as keyof typeof ERROR_CODES] ?? 'internal', {
      message: text(layout.message, layout.remedy),
      remedy: text(layout.remedy, layout.sizeof),
      culprit,
    });
  }
}

/** What Emscripten exports besides. */
interface Stack {
  stackSave?(): number;
  stackRestore?(to: number): void;
}

function outOfMemory(bytes: number): HandlebodyError {
  return new HandlebodyError('out-of-memory', {
    message: `The solver could not reserve ${(bytes / 2 ** 20).toFixed(1)} MiB of memory.`,
    remedy: 'Use a smaller model, fewer centers or a coarser resolution, or dispose of objects that are no longer used.',
  });
}

interface Owning {
  /** Bytes of each. */
  readonly blocks?: readonly number[];
  readonly kernel?: number;
}

/** Memory for the arguments of one call. */
export class Scratch {
  readonly #heap: Heap;
  readonly #pointers: number[] = [];

  constructor(heap: Heap) {
    this.#heap = heap;
  }

  reserve(bytes: number): number {
    const pointer = this.#heap.alloc(bytes);
    this.#pointers.push(pointer);
    return pointer;
  }
  putF64(values: NumberArray): number {
    return this.#put(values, 8, (pointer, length) => this.#heap.f64(pointer, length));
  }
  putU32(values: NumberArray): number {
    return this.#put(values, 4, (pointer, length) => this.#heap.u32(pointer, length));
  }
  putU16(values: NumberArray): number {
    return this.#put(values, 2, (pointer, length) => this.#heap.u16(pointer, length));
  }
  putU8(values: NumberArray): number {
    return this.#put(values, 1, (pointer, length) => this.#heap.u8(pointer, length));
  }

  /** An array whose memory went to another thread has no numbers, and cannot even be read as none. */
  #put(values: NumberArray, bytes: number, view: (pointer: number, length: number) => { set(values: NumberArray): void }): number {
    const { length } = values;
    const pointer = this.reserve(length * bytes);
    if (length > 0) view(pointer, length).set(values);
    return pointer;
  }

  release(): void {
    for (const pointer of this.#pointers.splice(0)) this.#heap.free(pointer);
  }
}
