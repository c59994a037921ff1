import { scaleLinear, scaleLog } from 'd3-scale';

/** Marks for an axis: round numbers between two ends, about as many as wanted, with the digits that tell them apart. */
export function axisMarks(low: number, high: number, wanted: number): { at: number[]; digits: number } {
  const at = scaleLinear([low, high], [0, 1]).ticks(Math.max(wanted, 2));
  const step = at.length > 1 ? (at[1] as number) - (at[0] as number) : 1;
  return { at, digits: Math.max(0, -Math.floor(Math.log10(step) + 1e-9)) };
}

/** The values that colors cover: those of the points and a quarter more on each side, so that overshoot shows before it saturates. */
export function colorRange(values: readonly number[]): readonly [number, number] {
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const pad = high > low ? (high - low) / 4 : Math.max(1, Math.abs(high) / 1e4);
  const round = [low - pad, high + pad].map((end) => Number(end.toPrecision(6))) as [number, number];
  // What is close together at a large number needs all its digits.
  return round[0] < low && round[1] > high ? round : [low - pad, high + pad];
}

/** A slider's position, 0 to 1, for a number: even in the logarithm; with `zero`, the left end is 0. */
export function toLog(value: number, low: number, high: number, zero = false): number {
  if (zero && value <= 0) return 0;
  const part = scaleLog([low, high], [0, 1]).clamp(true)(value);
  return zero ? ZERO_END + part * (1 - ZERO_END) : part;
}

/** The inverse of `toLog`, to two digits. */
export function fromLog(position: number, low: number, high: number, zero = false): number {
  if (zero && position < ZERO_END / 2) return 0;
  const part = zero ? Math.max(0, (position - ZERO_END) / (1 - ZERO_END)) : position;
  return Number(scaleLog([low, high], [0, 1]).invert(part).toPrecision(2));
}

/** The part of a slider that stands for zero. */
const ZERO_END = 0.06;
