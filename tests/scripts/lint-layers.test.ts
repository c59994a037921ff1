import { describe, expect, it } from 'vitest';
import { LAYERS, lintLayers } from '../../scripts/lint-layers.mjs';

/** The violations of a project that consists of these files. */
const lint = (files: Record<string, string>) => lintLayers(new Map(Object.entries(files)));

describe('layers that are kept', () => {
  it('accepts every downward use', () => {
    expect(
      lint({
        'wasm/core/numerics/types.hpp': '#include <Eigen/Core>\n',
        'wasm/core/mesh/mesh.hpp': '#include "core/numerics/types.hpp"\n',
        'wasm/core/distance/march.cpp': '#include "core/mesh/mesh.hpp"\n#include "march.hpp"\n',
        'wasm/core/distance/march.hpp': '#include "core/numerics/types.hpp"\n',
        'wasm/core/irbf/irbf.cpp': '#include "core/distance/march.hpp"\n',
        'wasm/abi/irbf.cpp': '#include <emscripten.h>\n#include "core/distance/march.hpp"\n',
        'wasm/ts/load.ts': 'export const read = (name: string) => process.getBuiltinModule(name); // document.title\n',
        'web/assets/read.ts': "import { Document } from '@gltf-transform/core';\nimport { read } from '../../wasm/ts/load.ts';\n",
        'web/assets/schema.ts': 'export const version = 0;\n',
        'web/three/plugin.ts': "import { Mesh } from 'three';\nimport { version } from '../assets/schema.ts';\n",
        'web/worker/bake.ts': "import { version } from '../assets/schema.ts';\n",
        'web/ui/dom.ts': 'export const h = 0;\n',
        'web/figures/kit/a.ts': "import { ticks } from 'd3-array';\nimport { h } from '../../ui/dom.ts';\n",
        'web/studio/main.ts':
          "import { Mesh } from 'three';\nimport { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';\nimport './main.css';\n",
        'tests/ts/load.test.ts': "import fs from 'node:fs';\nimport { read } from '../../wasm/ts/load.ts';\n",
      }),
    ).toEqual([]);
  });

  it('has every folder of the table use only folders of the table', () => {
    for (const layer of Object.values(LAYERS)) for (const folder of layer.may) expect(LAYERS).toHaveProperty([folder]);
  });
});

describe('violations that are caught', () => {
  const three = { 'web/three/handles.ts': "import { Mesh } from 'three';\n" };
  const cases: [what: string, files: Record<string, string>, message: RegExp][] = [
    [
      'the core includes upward',
      { 'wasm/core/mesh/a.hpp': '#include "core/distance/b.hpp"\n', 'wasm/core/distance/b.hpp': '' },
      /mesh\/a\.hpp:1: wasm\/core\/mesh must not use wasm\/core\/distance/,
    ],
    [
      'the core includes upward by a relative path',
      { 'wasm/core/distance/a.cpp': '\n#include "../irbf/b.hpp"\n', 'wasm/core/irbf/b.hpp': '' },
      /a\.cpp:2: .*must not use wasm\/core\/irbf/,
    ],
    [
      'the core includes sideways',
      { 'wasm/core/irbf/a.hpp': '#include "core/posespace/b.hpp"\n', 'wasm/core/posespace/b.hpp': '' },
      /must not use wasm\/core\/posespace/,
    ],
    [
      'kernels include a mesh',
      { 'wasm/core/kernels/a.hpp': '#include "core/mesh/b.hpp"\n', 'wasm/core/mesh/b.hpp': '' },
      /wasm\/core\/kernels must not use wasm\/core\/mesh/,
    ],
    [
      'the core includes the ABI',
      { 'wasm/core/irbf/a.cpp': '#include "abi/handlebody.h"\n', 'wasm/abi/handlebody.h': '' },
      /include abi\/handlebody\.h/,
    ],
    ['the core includes Emscripten', { 'wasm/core/irbf/a.cpp': '#include <emscripten/heap.h>\n' }, /include emscripten\/heap\.h/],
    ['the core uses wasm intrinsics', { 'wasm/core/irbf/a.cpp': '#include <wasm_simd128.h>\n' }, /include wasm_simd128\.h/],
    ['a folder is in no layer', { 'wasm/core/misc/a.cpp': '' }, /in no layer/],
    ['the solver imports three', { 'wasm/ts/a.ts': "import { Mesh } from 'three';\n" }, /wasm\/ts must not import three/],
    ['the solver imports Node', { 'wasm/ts/a.ts': "import fs from 'node:fs';\n" }, /must not import node:fs/],
    // Bundlers for browsers look for it.
    ['the solver imports Node lazily', { 'wasm/ts/a.ts': "await import('node:fs/promises');\n" }, /must not import node:fs/],
    [
      'the solver imports the web part',
      { 'wasm/ts/a.ts': "export * from '../../web/three/handles.ts';\n", ...three },
      /wasm\/ts must not use web\/three/,
    ],
    ['the solver touches the document', { 'wasm/ts/a.ts': "document.createElement('a');\n" }, /must not touch document/],
    ['the solver touches the window', { 'wasm/ts/a.ts': "window['x'] = 1;\n" }, /must not touch window/],
    ['assets import three', { 'web/assets/a.ts': "import type { Mesh } from 'three';\n" }, /web\/assets must not import three/],
    ['assets import Node', { 'web/assets/a.ts': "const fs = await import('node:fs');\n" }, /web\/assets must not import node:fs/],
    [
      'assets reach web/three',
      { 'web/assets/a.ts': "import '../three/handles.ts';\n", ...three },
      /web\/assets must not use web\/three/,
    ],
    [
      'three reaches glTF-Transform through others',
      {
        'web/three/a.ts': "import '../assets/b.ts';\n",
        'web/assets/b.ts': "import './c.ts';\n",
        'web/assets/c.ts': "import '@gltf-transform/core';\n",
      },
      /web\/three must never reach @gltf-transform\/, and does: web\/three\/a\.ts → web\/assets\/b\.ts → web\/assets\/c\.ts/,
    ],
    [
      'three imports the worker',
      { 'web/three/a.ts': "import '../worker/b.ts';\n", 'web/worker/b.ts': '' },
      /web\/three must not use web\/worker/,
    ],
    [
      'the worker imports the studio',
      { 'web/worker/a.ts': "import '../studio/b.ts';\n", 'web/studio/b.ts': '' },
      /must not use web\/studio/,
    ],
    ['the worker imports three', { 'web/worker/a.ts': "import 'three';\n" }, /web\/worker must not import three/],
    [
      'the element imports the command',
      { 'web/element/a.ts': "import '../cli/b.ts';\n", 'web/cli/b.ts': '' },
      /must not use web\/cli/,
    ],
    [
      'a figure imports another one',
      { 'web/figures/course/a.ts': "import './b.ts';\n", 'web/figures/course/b.ts': '' },
      /a figure uses its kit, never another one/,
    ],
    [
      'the kit imports a figure',
      { 'web/figures/kit/a.ts': "import '../course/b.ts';\n", 'web/figures/course/b.ts': '' },
      /web\/figures\/kit must not use web\/figures\/course/,
    ],
    [
      'a lesson imports the studio',
      { 'web/learn/a/main.ts': "import '../../studio/b.ts';\n", 'web/studio/b.ts': '' },
      /web\/learn must not use web\/studio/,
    ],
    ['web/ui imports three', { 'web/ui/a.ts': "import 'three';\n" }, /web\/ui must not import three/],
    [
      'the studio imports a lesson',
      { 'web/studio/a.ts': "import '../learn/b.ts';\n", 'web/learn/b.ts': '' },
      /must not use web\/learn/,
    ],
    [
      'the studio imports the tests',
      { 'web/studio/a.ts': "import '../../tests/b.ts';\n", 'tests/b.ts': '' },
      /must not use tests\/b\.ts/,
    ],
    [
      'a worker is spawned from above',
      { 'web/three/a.ts': "new Worker(new URL('../studio/b.ts', import.meta.url));\n", 'web/studio/b.ts': '' },
      /web\/three must not use web\/studio/,
    ],
    [
      'scripts import in a circle',
      { 'web/studio/a.ts': "import './b.ts';\n", 'web/studio/b.ts': "export * from './a.ts';\n" },
      /circle: .*a\.ts → .*b\.ts → .*a\.ts/,
    ],
    [
      'headers include in a circle',
      { 'wasm/core/mesh/a.hpp': '#include "core/mesh/b.hpp"\n', 'wasm/core/mesh/b.hpp': '#include "a.hpp"\n' },
      /circle: /,
    ],
  ];
  it.each(cases)('%s', (_what, files, message) => {
    expect(lint(files).join('\n')).toMatch(message);
  });
});
