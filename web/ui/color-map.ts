/** Colors for numbers: viridis, and blue for positive and orange for negative around a pale zero. Both are safe for color-blind eyes. */
type ColorMapName = 'viridis' | 'around-zero';

const STOPS: Record<ColorMapName, readonly string[]> = {
  // Sixteen of viridis' 256 colors (van der Walt and Smith, CC0); what lies between is off by 2 of 255 at the most.
  viridis: '440154 481a6c 472f7d 414487 39568c 31688e 2a788e 23888e 1f988b 22a884 35b779 54c568 7ad151 a5db36 d2e21b fde725'.split(
    ' ',
  ),
  'around-zero': '7a3803 a85409 d9812b f0ba83 f3f1ec 9dc1ee 4a86d3 1f5fc4 123f8a'.split(' '),
};

const SIZE = 256;

/** A table of colors over a range of values; beyond its ends the end colors go on. */
export class ColorMap {
  readonly low: number;
  readonly high: number;
  /** As canvases store them: red in the lowest byte. */
  readonly #table: Uint32Array;

  constructor(name: ColorMapName, low: number, high: number) {
    // Zero lies in the middle, whatever the range.
    const most = Math.max(Math.abs(low), Math.abs(high));
    [this.low, this.high] = name === 'viridis' ? [low, high] : [-most, most];
    this.#table = table(name);
  }

  /** The packed color of a value; none, transparent, for what is no number. */
  packed(value: number): number {
    if (Number.isNaN(value)) return 0;
    const at = ((value - this.low) / (this.high - this.low)) * (SIZE - 1);
    return this.#table[at <= 0 ? 0 : at >= SIZE - 1 ? SIZE - 1 : Math.round(at)] as number;
  }

  css(value: number): string {
    const color = this.packed(value);
    return `rgb(${color & 255} ${(color >> 8) & 255} ${(color >> 16) & 255})`;
  }

  /** Whether dark lines show better than light ones over this value. */
  isLight(value: number): boolean {
    const color = this.packed(value);
    return 0.299 * (color & 255) + 0.587 * ((color >> 8) & 255) + 0.114 * ((color >> 16) & 255) > 130;
  }

  /** For a style sheet, from left to right. */
  get gradient(): string {
    const steps = 24;
    const colors = Array.from({ length: steps + 1 }, (_, i) => this.css(this.low + ((this.high - this.low) * i) / steps));
    return `linear-gradient(90deg, ${colors.join(', ')})`;
  }
}

const tables = new Map<ColorMapName, Uint32Array>();

function table(name: ColorMapName): Uint32Array {
  const known = tables.get(name);
  if (known) return known;
  const stops = STOPS[name].map((hex) => [0, 2, 4].map((at) => Number.parseInt(hex.slice(at, at + 2), 16)));
  const made = new Uint32Array(SIZE);
  for (let i = 0; i < SIZE; i++) {
    const at = (i / (SIZE - 1)) * (stops.length - 1);
    const k = Math.min(Math.floor(at), stops.length - 2);
    const [r, g, b] = [0, 1, 2].map((c) => {
      const [from, to] = [stops[k]?.[c] ?? 0, stops[k + 1]?.[c] ?? 0];
      return Math.round(from + (to - from) * (at - k));
    }) as [number, number, number];
    made[i] = (255 << 24) | (b << 16) | (g << 8) | r;
  }
  tables.set(name, made);
  return made;
}
