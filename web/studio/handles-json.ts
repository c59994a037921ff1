import { HandlebodyError } from '../../wasm/ts/errors.ts';
import type { Handle, Vec3 } from '../../wasm/ts/types.ts';

/** A handle and where a file wants it. */
export interface HandleOrder {
  readonly handle: Handle;
  readonly to: Vec3 | undefined;
}

/** Reads `{"handles": [{"vertex": 120} or {"at": [x, y, z]}, with "to": [x, y, z]]}`, in model units. The solver judges the values. */
export function readHandles(text: string): HandleOrder[] {
  let data: unknown;
  try {
    data = JSON.parse(text);
  } catch (cause) {
    throw invalid('The file is not valid JSON.', undefined, cause);
  }
  const list = (data as { handles?: unknown } | null)?.handles;
  if (!Array.isArray(list) || list.length === 0) throw invalid('The file has no list of "handles".');
  return list.map((entry: unknown, index) => {
    const { vertex, at, to } = (entry ?? {}) as { vertex?: unknown; at?: unknown; to?: unknown };
    if (typeof vertex !== 'number' && !isTriple(at))
      throw invalid(`Handle ${index} has neither a "vertex" number nor a place "at" (handles[${index}]).`, index);
    if (to !== undefined && !isTriple(to))
      throw invalid(`Handle ${index}'s "to" is not three numbers (handles[${index}].to).`, index);
    return { handle: typeof vertex === 'number' ? { vertex } : { at: at as Vec3 }, to };
  });
}

function isTriple(value: unknown): value is Vec3 {
  return Array.isArray(value) && value.length === 3 && value.every((v) => typeof v === 'number');
}

function invalid(message: string, index?: number, cause?: unknown): HandlebodyError {
  return new HandlebodyError('file-invalid', {
    message,
    remedy: 'Write it as {"handles": [{"vertex": 120, "to": [0, 1, 0]}]}, in the model’s own units.',
    culprit: index === undefined ? undefined : { kind: 'handle', index },
    cause,
  });
}
