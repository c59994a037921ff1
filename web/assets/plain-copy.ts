import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { isDeep, MAX_DEPTH } from './gltf-json.ts';

/** A copy of what an extension says. Throws 'file-invalid' where it is nested too deep to be copied. */
export function plainCopy(json: object, name: string): Record<string, unknown> {
  if (!isDeep(json)) return structuredClone(json) as Record<string, unknown>;
  throw new HandlebodyError('file-invalid', {
    message: `The extension ${name} of the glTF has lists and objects nested more than ${MAX_DEPTH} deep.`,
    remedy: 'Export the model again; a glTF validator says more.',
  });
}
