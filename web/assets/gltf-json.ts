/** An object of a glTF's JSON, of which nothing is known yet. */
export type GltfJson = Record<string, unknown>;

/** Asks that the number at `path` be a whole one from 0 to below `end`, and returns it. */
export type CheckIndex = (value: unknown, end: number, path: string) => number;

export function isObject(value: unknown): value is GltfJson {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

export function asObject(value: unknown): GltfJson | undefined {
  return isObject(value) ? value : undefined;
}

export function isNumber(value: unknown): value is number {
  return typeof value === 'number' && Number.isFinite(value);
}

/** A value as a message shows it, cut short. */
export function show(value: unknown): string {
  return (JSON.stringify(value) ?? 'undefined').slice(0, 40);
}
