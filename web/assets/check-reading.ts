import { HandlebodyError } from '../../wasm/ts/errors.ts';
import type { MeshReading } from '../../wasm/ts/types.ts';
import { asObject, isNumber } from './gltf-json.ts';

/** More parts than real scenes have. */
export const MAX_PARTS = 1 << 16;

/** What a file says of how its scene was read. Throws 'body-invalid' for what no reader wrote. */
export function checkReading(json: unknown): MeshReading {
  const { skipped = [], morphs = {}, skins = {}, origin } = asObject(json) ?? refuse();
  if (!Array.isArray(skipped) || skipped.length > MAX_PARTS || !skipped.every(isPart)) return refuse();
  const place = origin === undefined ? undefined : isPlace(origin) ? origin : refuse();
  return { skipped, morphs: rowsOf(morphs), skins: rowsOf(skins, 16), ...(place && { origin: place }) };
}

/** Numbers by part: so many each, where that is given. */
function rowsOf(json: unknown, length?: number): Record<number, number[]> {
  const entries = Object.entries(asObject(json) ?? refuse());
  const isRow = (row: unknown) => Array.isArray(row) && row.every(isNumber) && (length === undefined || row.length === length);
  if (entries.length > MAX_PARTS || !entries.every(([part, row]) => isPart(Number(part)) && isRow(row))) return refuse();
  return Object.fromEntries(entries) as Record<number, number[]>;
}

function isPlace(value: unknown): value is [number, number, number] {
  return Array.isArray(value) && value.length === 3 && value.every(isNumber);
}

function isPart(part: unknown): boolean {
  return Number.isInteger(part) && (part as number) >= 0 && (part as number) < MAX_PARTS;
}

function refuse(): never {
  throw new HandlebodyError('body-invalid', {
    message: 'The baked body does not say how its scene was read (HANDLEBODY_body.reading).',
    remedy: 'The file is damaged or was edited: bake the model again.',
  });
}
