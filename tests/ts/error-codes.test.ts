import { readdirSync, readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import { ERROR_CODES } from '../../wasm/ts/abi.generated.ts';
import { type ErrorCode, HandlebodyError } from '../../wasm/ts/errors.ts';

const words = { message: 'It is no GLB.', remedy: 'Give one.' };

it('are typed: a misspelt one does not compile, in whatever room it is thrown', () => {
  const sound: ErrorCode[] = ['mesh-open', 'disposed', 'file-not-glb', 'outline-crosses', 'usage'];
  // @ts-expect-error of the files' codes
  const misspelt = new HandlebodyError('file-nto-glb', words);
  // @ts-expect-error of the solver's
  const unknown: ErrorCode = 'mesh-opened';
  expect(sound.map((code) => new HandlebodyError(code, words).code)).toEqual(sound);
  expect(sound).not.toContain(misspelt.code);
  expect(sound).not.toContain(unknown);
});

it('of the solver are those that its C++ returns, and no others', () => {
  const returned = new Set<string>();
  for (const folder of ['wasm/core', 'wasm/abi']) {
    for (const name of readdirSync(folder, { recursive: true, encoding: 'utf8' })) {
      if (!/\.[ch]pp$/.test(name)) continue;
      for (const [, code = ''] of readFileSync(`${folder}/${name}`, 'utf8').matchAll(/HB_ERROR_([A-Z_]+)/g))
        returned.add(code.toLowerCase().replaceAll('_', '-'));
    }
  }
  expect(Object.values(ERROR_CODES).sort()).toEqual([...returned].sort());
});
