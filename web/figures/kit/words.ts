import { readable } from '../../ui/dom.ts';

/** A number as short as its size allows: 0.35, 12, 1e-5, with a true minus sign. */
export function brief(value: number): string {
  if (value === 0) return '0';
  if (!Number.isFinite(value)) return 'none';
  const size = Math.abs(value);
  if (size < 0.0095 || size >= 1e5) return scientific(value);
  return readable(Number(value.toPrecision(size < 1 ? 2 : 3)), size < 0.1 ? 3 : size < 10 ? 2 : size < 100 ? 1 : 0).replace(
    /(\.\d*?)0+$/,
    (_, digits: string) => (digits === '.' ? '' : digits),
  );
}

/** 2e14 and 1e−5. */
function scientific(value: number): string {
  return value.toExponential(0).replace('e+', 'e').replaceAll('-', '−');
}

type Health = 'fine' | 'delicate' | 'hopeless';

/** What a condition number means: as many of sixteen digits are lost as it has. */
export function health(condition: number): Health {
  if (condition < 1e8) return 'fine';
  return condition < 1e12 ? 'delicate' : 'hopeless';
}

/** "12", "1e5", or "infinite" for equations without a solution. */
export function conditionText(condition: number): string {
  if (!Number.isFinite(condition)) return 'infinite';
  return condition < 1000 ? brief(condition) : scientific(condition);
}
