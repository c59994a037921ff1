/** How long the parts of the work took, in milliseconds. */
export class Clock {
  readonly #start = performance.now();
  readonly #laps: [string, number][] = [];
  #last = this.#start;

  /** What went by since the last lap was this. */
  lap(name: string): void {
    const now = performance.now();
    this.#laps.push([name, now - this.#last]);
    this.#last = now;
  }

  total(): number {
    return performance.now() - this.#start;
  }

  laps(): Record<string, number> {
    const rounded = ([name, time]: [string, number]) => [name, Math.round(time * 10) / 10] as const;
    return Object.fromEntries([...this.#laps, ['total', this.total()] as [string, number]].map(rounded));
  }
}
