/** A typed array that grows, from one of a length that was checked, or of none. Its length is bounded by what the file holds, since every number pushed was read from it. */
export class NumberList<T extends Float64Array | Float32Array | Uint32Array> {
  length = 0;
  #array: T;

  constructor(room: T) {
    this.#array = room;
  }

  push(value: number): void {
    if (this.length === this.#array.length) {
      const larger = new (this.#array.constructor as new (length: number) => T)(Math.max(this.length * 2, 1024));
      larger.set(this.#array);
      this.#array = larger;
    }
    this.#array[this.length++] = value;
  }

  at(index: number): number {
    return this.#array[index] as number;
  }

  /** Exactly what was pushed. */
  finish(): T {
    return (this.length === this.#array.length ? this.#array : this.#array.slice(0, this.length)) as T;
  }
}
