import { readFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { build, type Rolldown } from 'vite';
import { beforeAll, describe, expect, it } from 'vitest';
import { load as loadExternal } from '../../wasm/ts/external.ts';
import * as whole from '../../wasm/ts/index.ts';
import * as runtime from '../../wasm/ts/runtime.ts';
import { load as loadRuntimeExternal } from '../../wasm/ts/runtime-external.ts';
import { dogHandles, readDog } from './support/dog.ts';

const wasmFile = new URL('../../wasm/handlebody.wasm', import.meta.url);
const runtimeFile = new URL('../../wasm/handlebody.runtime.wasm', import.meta.url);

/** The functions of the header behind one of its markers. */
function functionsBehind(marker: 'HB_API' | 'HB_WHOLE_API'): string[] {
  const header = readFileSync(new URL('../../wasm/abi/handlebody.h', import.meta.url), 'utf8');
  return [...header.matchAll(new RegExp(`^${marker} .*?(hb_\\w+)\\(`, 'gm'))].map((match) => match[1] ?? '');
}

const bits = (numbers: Float32Array | Float64Array) => Buffer.from(numbers.buffer, numbers.byteOffset, numbers.byteLength);

let hb: runtime.HandlebodyRuntime;
let other: whole.Handlebody;
beforeAll(async () => {
  [hb, other] = await Promise.all([runtime.load(), whole.load()]);
});

describe('handlebody.runtime.wasm', () => {
  it('exports what the header marks for both links, and nothing of the whole', () => {
    const exported = (file: URL) =>
      WebAssembly.Module.exports(new WebAssembly.Module(readFileSync(file)))
        .map(({ name }) => name)
        .filter((name) => name.startsWith('hb_'))
        .sort();
    expect(exported(runtimeFile)).toEqual(functionsBehind('HB_API').sort());
    expect(exported(wasmFile)).toEqual([...functionsBehind('HB_API'), ...functionsBehind('HB_WHOLE_API')].sort());
  });

  it('is started from inside, from bytes, from a module and from a file URL', async () => {
    const bytes = readFileSync(runtimeFile);
    for (const wasm of [bytes, await WebAssembly.compile(bytes), runtimeFile]) {
      expect((await runtime.load({ wasm })).memory).toBeGreaterThan(0);
      expect((await loadRuntimeExternal({ wasm })).memory).toBeGreaterThan(0);
    }
    const { WASM_BYTES } = await import('../../wasm/ts/runtime-binary.generated.ts');
    expect(WASM_BYTES).toBe(bytes.length);
  });

  it('stops when its signal is aborted', async () => {
    await expect(runtime.load({ signal: AbortSignal.abort() })).rejects.toMatchObject({ code: 'aborted' });
  });
});

describe('the wrong link', () => {
  it.each([
    ['handlebody', whole.load],
    ['handlebody/external', loadExternal],
  ])('%s refuses the smaller file and says what to do', async (_, load) => {
    const error = await load({ wasm: readFileSync(runtimeFile) }).catch((e: unknown) => e);
    expect(error).toBeInstanceOf(whole.HandlebodyError);
    expect(error).toMatchObject({
      code: 'wasm-unavailable',
      message: expect.stringContaining('handlebody.runtime.wasm'),
      remedy: expect.stringMatching(/Serve the handlebody\.wasm .*"handlebody\/runtime"/),
    });
  });

  it.each([
    ['handlebody/runtime', runtime.load],
    ['handlebody/runtime/external', loadRuntimeExternal],
  ])('%s refuses the whole file and says what to do', async (_, load) => {
    const error = await load({ wasm: readFileSync(wasmFile) }).catch((e: unknown) => e);
    expect(error).toBeInstanceOf(runtime.HandlebodyError);
    expect(error).toMatchObject({
      code: 'wasm-unavailable',
      message: expect.stringContaining('handlebody.wasm'),
      remedy: expect.stringMatching(/Serve the handlebody\.runtime\.wasm .*"handlebody"/),
    });
  });

  it('is no link at all: a module of something else', async () => {
    const empty = new Uint8Array([0, 0x61, 0x73, 0x6d, 1, 0, 0, 0]);
    for (const load of [whole.load, runtime.load]) {
      const error = await load({ wasm: empty }).catch((e: unknown) => e);
      expect(error).toMatchObject({ code: 'wasm-unavailable', remedy: expect.stringContaining('same release') });
    }
  });
});

describe('what both links do', () => {
  it('the served dog moves to the same bits', async () => {
    const body = await readDog();
    const { leftFront, rightFront, leftHind, rightHind, nose, tail } = dogHandles(body.mesh.positions);
    const move = (solver: runtime.HandlebodyRuntime) => {
      const irbf = solver.irbf(body);
      irbf.setHandles([leftFront, rightFront, leftHind, rightHind, nose, tail].map((vertex) => ({ vertex })));
      const start = irbf.targets.slice(0, 3);
      irbf.targets[1] = (irbf.targets[1] ?? 0) + 0.2 * body.normalization.diagonal;
      const { energy, iterations } = irbf.solve();
      const positions = new Float32Array(body.mesh.positions.length);
      const normals = new Float32Array(body.mesh.positions.length);
      irbf.deform(positions, normals);
      const moved = Math.hypot(...start.map((x, axis) => (positions[3 * leftFront + axis] ?? 0) - x));
      const result = { energy, iterations, moved, positions: bits(positions), normals: bits(normals), report: irbf.report() };
      irbf.dispose();
      return result;
    };
    const [here, there] = [move(hb), move(other)];
    expect(here.moved).toBeCloseTo(0.2 * body.normalization.diagonal, 2);
    expect(here.energy).toBeGreaterThan(0);
    expect(here.positions.equals(there.positions)).toBe(true);
    expect(here.normals.equals(there.normals)).toBe(true);
    expect({ ...here, positions: 0, normals: 0 }).toEqual({ ...there, positions: 0, normals: 0 });
  });

  const data = { dimension: 2, points: [0, 0, 1, 0, 0, 1, 1, 1, 0.4, 0.6, 0.7, 0.3], values: [0, 1, 1, 0, 2, -1] };
  const queries = Float64Array.from({ length: 40 }, (_, i) => (i * 0.618) % 1);
  const interpolants: Record<string, (solver: runtime.HandlebodyRuntime) => runtime.Interpolant> = {
    rbf: (solver) => solver.rbf({ ...data, kernel: 'thin-plate', degree: 1 }),
    'rbf of a kernel of the host': (solver) => solver.rbf({ ...data, kernel: (s) => Math.exp(-s * s), width: 0.5 }),
    'rbf of a width by leave-one-out': (solver) => solver.rbf({ ...data, kernel: 'gaussian', width: 'leave-one-out' }),
    shepard: (solver) => solver.shepard(data),
    'moving least squares': (solver) => solver.movingLeastSquares({ ...data, degree: 1 }),
    'simplex linear': (solver) => solver.simplexLinear(data),
    'natural neighbor': (solver) => solver.naturalNeighbor(data),
    'tension spline': (solver) => solver.tensionSpline(data),
  };
  it.each(Object.entries(interpolants))('%s meets its points, and gives the same bits', (_, make) => {
    const values = make(hb).evaluate(data.points);
    data.values.forEach((value, i) => {
      expect(values[i]).toBeCloseTo(value, 6);
    });
    expect(bits(make(hb).evaluate(queries)).equals(bits(make(other).evaluate(queries)))).toBe(true);
  });

  it('outliers and a pose space give the same bits', () => {
    const results = (solver: runtime.HandlebodyRuntime) => {
      const found = solver.findOutliers({ ...data, kernel: 'thin-plate', degree: 1 });
      const examples = [
        { name: 'calm', at: [0, 0], shape: [0, 1] },
        { name: 'happy', at: [1, 0], shape: [1, 0] },
        { name: 'angry', at: [0, 1], shape: [2, 2] },
      ];
      const space = solver.poseSpace({ dimensions: ['valence', 'arousal'], examples });
      return {
        found,
        weights: space.weights([0.3, 0.4]),
        happy: space.evaluate([1, 0]),
      };
    };
    const [here, there] = [results(hb), results(other)];
    expect(here.happy[0]).toBeCloseTo(1, 6);
    expect(here.happy[1]).toBeCloseTo(0, 6);
    expect(here).toEqual(there);
  });

  it('skins give the same bits', () => {
    const shape = { dimension: 2, positions: [0, 0, 1, 0, 2, 0], weights: [1, 0, 0.5, 0.5, 0, 1] } as const;
    for (const method of ['linearBlend', 'dualQuaternion'] as const) {
      const bend = (solver: runtime.HandlebodyRuntime) => {
        const skin = solver[method](shape);
        skin.transforms.set([0, -1, 2, 1, 0, 0], 6); // turns handle 1 by 90° and shifts it by 2
        return skin.deform();
      };
      const bent = bend(hb);
      expect(bent[4]).toBeCloseTo(2, 6);
      expect(bent[5]).toBeCloseTo(2, 6);
      expect(bits(bent).equals(bits(bend(other)))).toBe(true);
    }
  });
});

describe('what the runtime leaves out', () => {
  it('its types and its objects have no baking, no weights and no energies', () => {
    // @ts-expect-error the runtime cannot bake
    expect(hb.bake).toBeUndefined();
    // @ts-expect-error nor fill a surface with tetrahedra
    expect(hb.tetrahedralize).toBeUndefined();
    // @ts-expect-error nor compute weights
    expect(hb.biharmonicWeights).toBeUndefined();
    // @ts-expect-error nor measure them
    expect(hb.measureWeights).toBeUndefined();
    // @ts-expect-error nor find the kernels of a grid's equations
    expect(hb.discreteGreen).toBeUndefined();
    // @ts-expect-error nor minimize energies
    expect(hb.minimizeEnergy).toBeUndefined();
    // The whole serves wherever the runtime does.
    const any: runtime.HandlebodyRuntime = other;
    expect(any.memory).toBe(other.memory);
  });

  it('classes, errors and tables are one and the same in both entries', () => {
    const { load, ...shared } = runtime;
    const all: Record<string, unknown> = { ...whole };
    expect(load).not.toBe(all.load);
    expect(Object.keys(shared)).toContain('HandlebodyError');
    for (const [name, value] of Object.entries(shared)) expect(all[name], name).toBe(value);
  });

  it('a bundle of the entry holds neither the code nor the wasm of the whole', async () => {
    const entry = fileURLToPath(new URL('../../wasm/ts/runtime.ts', import.meta.url));
    const lib = { entry, formats: ['es' as const], fileName: 'runtime' };
    const built = (await build({
      configFile: false,
      logLevel: 'error',
      build: { write: false, minify: false, lib },
    })) as Rolldown.RolldownOutput[];
    const chunks = built.flatMap(({ output }) => output.filter((part) => part.type === 'chunk'));
    const files = chunks.flatMap(({ moduleIds }) => moduleIds.map((id) => path.basename(id)));
    expect(files).toContain('irbf.ts');
    expect(files).toContain('runtime-binary.generated.ts');
    for (const left of ['bake', 'bake-shape', 'biharmonic-weights', 'tetrahedralize', 'minimize-energy', 'binary.generated'])
      expect(files).not.toContain(`${left}.ts`);
    const code = chunks.map((chunk) => chunk.code).join('');
    const named = (name: string) => new RegExp(`\\b${name}\\b`).test(code);
    expect(named('hb_irbf_create')).toBe(true);
    // By this one the loader sees which link it has got.
    expect(functionsBehind('HB_WHOLE_API').filter(named)).toEqual(['hb_bake_begin']);
  });
});
