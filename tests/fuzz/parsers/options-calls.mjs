/** The solver's own calls: sound options and arguments of each, as JSON, and what is done with them. */
/** @typedef {import('./random.mjs').Random} Random */
/** @typedef {Record<string, any>} Given */
/** @typedef {import('../../../wasm/ts/index.ts').Handlebody} Handlebody */

export const tetrahedron = {
  positions: [0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2],
  triangles: [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3],
};
const RADIAL = [
  'linear',
  'cubic',
  'quintic',
  'thin-plate',
  'gaussian',
  'multiquadric',
  'inverse-multiquadric',
  'inverse-quadratic',
];
const OTHERS = [
  'polyharmonic',
  'wendland-c0',
  'wendland-c2',
  'wendland-c4',
  'buhmann',
  'compact-inverse-multiquadric',
  'clamped-plate',
];
const SPECIAL = [{ $: 'kernel' }, { $: 'derivative' }];

/** Some of these options, in a random choice. @param {Random} random @param {Given} all */
const some = (random, all) => Object.fromEntries(Object.entries(all).filter(() => random.below(3) === 0));

/** Points with values, flat or in rows. @param {Random} random @param {number} [most] */
function scattered(random, most = 4, dimension = 1 + random.below(most)) {
  const count = 1 + random.below(random.below(8) === 0 ? 120 : 14);
  const outputs = 1 + random.below(2);
  const numbers = (/** @type {number} */ n) => Array.from({ length: n }, () => random.below(1000) / 100 - 5);
  const rows = (/** @type {number} */ width) =>
    random.below(3) === 0 && width > 1 ? Array.from({ length: count }, () => numbers(width)) : numbers(count * width);
  return {
    count,
    dimension,
    data: { dimension, points: rows(dimension), values: rows(outputs) },
    queries: numbers(dimension * (1 + random.below(3))),
    numbers,
  };
}

/** A grid of triangles in the plane. @param {Random} random */
function plane(random) {
  const side = 2 + random.below(4);
  const at = (/** @type {number} */ i, /** @type {number} */ j) => i + (side + 1) * j;
  const cells = Array.from({ length: side * side }, (_, c) => [c % side, Math.floor(c / side)]);
  const positions = Array.from({ length: (side + 1) ** 2 }, (_, v) => [v % (side + 1), Math.floor(v / (side + 1))]);
  const triangles = cells.map(([i = 0, j = 0]) => [
    at(i, j),
    at(i + 1, j),
    at(i + 1, j + 1),
    at(i, j),
    at(i + 1, j + 1),
    at(i, j + 1),
  ]);
  const last = (side + 1) ** 2 - 1;
  const handles = [
    { vertex: 0 },
    random.pick([
      { vertex: last },
      { vertices: [last, last - 1] },
      { at: [side, side] },
      {
        bone: [
          [side, 1],
          [side, side],
        ],
      },
    ]),
    ...(random.below(2) ? [{ vertex: side }] : []),
  ];
  const flat = random.below(2) === 0;
  return {
    mesh: { dimension: 2, positions: flat ? positions.flat() : positions, triangles: triangles.flat() },
    handles,
    count: last + 1,
  };
}
const MESH = { weld: false, strict: true };

/** What `run` takes: a solver, a body of it, and the arguments. @typedef {{ hb: Handlebody, body: import('../../../wasm/ts/index.ts').BodyData } & Given} Asked */
/** @type {Record<string, { make: (random: Random) => Given, run: (asked: Asked) => unknown }>} */
export const CALLS = {
  ...Object.fromEntries(
    ['rbf', 'findOutliers'].map((name) => [
      name,
      {
        make: (/** @type {Random} */ random) => {
          const { data, count, dimension, numbers, queries } = scattered(random);
          const wide = { width: random.pick([0.5, 2, 'auto', 'leave-one-out', numbers(count).map((x) => 6 + x)]) };
          const fits =
            name === 'rbf' &&
            some(random, { weightDecay: 0.1, normalized: true, robust: random.pick(['least-absolute', 'least-median']) });
          const more = some(random, {
            kernel: random.pick([...RADIAL, ...OTHERS, ...SPECIAL]),
            ...wide,
            degree: random.pick([-1, 0, 1, 2, 'auto']),
            smoothing: random.below(3) / 2,
            metric: Array.from({ length: dimension ** 2 }, (_, i) => (i % (dimension + 1) === 0 ? 2 : 0.1)),
            order: 1 + random.below(4),
            support: 3,
          });
          const centers = name === 'rbf' && random.below(5) === 0 && { centers: numbers(dimension * (1 + random.below(count))) };
          const search =
            name !== 'rbf' &&
            some(random, { method: random.pick(['row-sum', 'leave-one-out', 'residual']), most: 3, threshold: 4 });
          return { options: { ...data, ...more, ...fits, ...centers, ...search }, queries };
        },
        run: (/** @type {Asked} */ { hb, options, queries }) => {
          if (name !== 'rbf') return hb.findOutliers(options).outliers;
          return used(hb.rbf(options), (f) => [
            f.evaluate(queries),
            f.weights(queries),
            f.coefficients(),
            f.report().condition ?? 0,
          ]);
        },
      },
    ]),
  ),
  ...Object.fromEntries(
    /** @type {const} */ (['shepard', 'movingLeastSquares', 'naturalNeighbor', 'simplexLinear', 'tensionSpline']).map((name) => [
      name,
      {
        make: (/** @type {Random} */ random) => {
          const { data, queries } = scattered(random, name === 'tensionSpline' ? 3 : 4, name === 'naturalNeighbor' ? 2 : undefined);
          const more = {
            shepard: { power: 1 + random.below(4), epsilon: 0.1 },
            movingLeastSquares: {
              degree: random.below(3),
              weight: random.pick(['inverse-distance', 'gaussian', 'wendland']),
              power: 3,
              epsilon: 0.1,
              width: random.pick(['auto', 3]),
            },
            naturalNeighbor: {},
            simplexLinear: {},
            tensionSpline: {
              alpha: 1,
              beta: random.below(2),
              gamma: random.below(2),
              smoothing: 0.1,
              ends: random.pick(['natural', 'zero-slope']),
            },
          }[name];
          return { options: { ...data, ...some(random, more) }, queries };
        },
        run: (/** @type {Asked} */ { hb, options, queries }) =>
          used(hb[name](options), (f) => [f.evaluate(queries), f.weights(queries)]),
      },
    ]),
  ),
  poseSpace: {
    make: (random) => {
      const axes = 1 + random.below(3);
      const place = () => Array.from({ length: axes }, () => random.below(100) / 50 - 1);
      return {
        options: {
          dimensions: Array.from({ length: axes }, (_, i) => random.pick([`d${i}`, { name: `d${i}`, scale: 1 + i }])),
          examples: Array.from({ length: 1 + random.below(6) }, (_, i) => ({ name: `e${i}`, at: place(), shape: [i, 2, -i] })),
          ...some(random, {
            method: random.pick(['cardinal', 'normalized']),
            kernel: random.pick(['auto', ...RADIAL]),
            width: random.pick(['auto', 0.5]),
            degree: random.pick(['auto', -1, 0, 1]),
          }),
        },
        at: place(),
      };
    },
    run: ({ hb, options, at }) => used(hb.poseSpace(options), (space) => [space.weights(at), space.evaluate(at)]),
  },
  ...Object.fromEntries(
    /** @type {const} */ (['linearBlend', 'dualQuaternion']).map((name) => [
      name,
      {
        make: (/** @type {Random} */ random) => {
          const [dimension, count, handles] = [2 + random.below(2), 1 + random.below(5), 1 + random.below(3)];
          const some01 = (/** @type {number} */ n) => Array.from({ length: n }, () => random.below(5) / 4);
          const weights = some01(count * handles).map((x, i) => x + (i % handles === 0 ? 0.5 : 0));
          return {
            options: {
              positions: some01(count * dimension),
              weights,
              dimension,
              ...some(random, { normalize: random.below(2) === 0 }),
            },
            shift: random.below(3),
          };
        },
        run: (/** @type {Asked} */ { hb, options, shift }) =>
          used(hb[name](options), (skin) => {
            if (typeof shift === 'number' && Math.abs(shift) < 1e30) skin.transforms[skin.dimension] = shift;
            const moved = skin.deform();
            return [moved, 'unskin' in skin ? 0 : 1];
          }),
      },
    ]),
  ),
  discreteGreen: {
    make: (random) => {
      const size = 6 + random.below(20);
      const samples = [...new Set(Array.from({ length: 2 + random.below(4) }, () => random.below(size)))];
      const more = some(random, {
        order: 1 + random.below(3),
        boundary: random.pick(['free', 'dirichlet', 'neumann', 'periodic']),
      });
      return { options: { size, samples, values: samples.map((v) => v / 3), ...more } };
    },
    run: ({ hb, options }) =>
      used(hb.discreteGreen(options), (green) => [green.solveGrid(), green.solveRadial(), green.green.values]),
  },
  minimizeEnergy: {
    make: (random) => {
      const { mesh, handles } = plane(random);
      const energy = random.pick(['dirichlet', 'laplacian', 'conformal', 'rigid']);
      return { mesh, handles, options: { energy, ...some(random, { iterations: 5, ...MESH }) } };
    },
    run: ({ hb, mesh, handles, options }) =>
      used(hb.minimizeEnergy(mesh, handles, options), (map) => {
        const out = new Float32Array(map.vertexCount * 2);
        map.transforms[2] = 1;
        return [map.deform(out).energy, out];
      }),
  },
  biharmonicWeights: {
    make: (random) => {
      const { mesh, handles } = plane(random);
      const more = {
        order: 1 + random.below(3),
        bounded: random.below(3) === 0,
        mass: random.pick(['voronoi', 'barycentric']),
        ...MESH,
      };
      return {
        mesh,
        handles,
        options: some(random, more),
        bound: some(random, { tolerance: 1e-4 }),
        bounds: random.below(8) === 0,
      };
    },
    run: async ({ hb, mesh, handles, options, bound, bounds }) => {
      const weights = hb.biharmonicWeights(mesh, handles, options);
      try {
        if (bounds) await weights.bound(bound);
        return [weights.weights.slice(), weights.mass.slice(), weights.energy.values.slice()];
      } finally {
        weights.dispose();
      }
    },
  },
  measureWeights: {
    make: (random) => {
      const { mesh, handles, count } = plane(random);
      return {
        mesh,
        handles,
        weights: Array.from({ length: count * handles.length }, () => random.below(5) / 4),
        options: some(random, MESH),
      };
    },
    run: ({ hb, mesh, handles, weights, options }) => hb.measureWeights(mesh, handles, weights, options).sumError,
  },
  tetrahedralize: {
    make: (random) => ({
      surface: random.pick([tetrahedron]),
      options: { resolution: 4 + random.below(6), ...some(random, MESH) },
    }),
    run: ({ hb, surface, options }) => {
      const solid = hb.tetrahedralize(surface, options);
      return [solid.positions, solid.sample(solid.positions)];
    },
  },
  bake: {
    make: (random) => {
      const { positions, triangles } = tetrahedron;
      const shape = random.pick([
        { positions, triangles },
        { positions: { $: 'Float32Array', of: positions }, triangles: { $: 'Uint16Array', of: triangles } },
        { positions, tetrahedra: [0, 1, 2, 3] },
        { positions, triangles, origin: [0, 5, 0] },
        { dimensions: [3, 2, 2], spacing: 0.5, origin: [0, 0, 1], inside: [1, 1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 0] },
      ]);
      const options = {
        centers: 1 + random.below(4),
        resolution: 6 + random.below(6),
        spheres: 1 + random.below(4),
        ...some(random, {
          distance: random.pick(['fast-marching', 'heat', 'mean-value', 'euclidean']),
          packing: random.pick(['skeleton', 'tree']),
          density: [1, 1, 2, 1],
        }),
      };
      return { shape, options };
    },
    run: async ({ hb, shape, options }) => {
      // As coarse as all others where no resolution is left.
      const coarse = options?.resolution === undefined && (options === undefined || options?.constructor === Object);
      const { distances, spheres, mesh } = await hb.bake(shape, coarse ? { ...options, resolution: 12 } : options);
      return [distances, spheres, mesh.positions];
    },
  },
  irbf: {
    make: (random) => {
      const options = some(random, {
        kernel: random.pick([...RADIAL, ...OTHERS, { $: 'kernel' }]),
        relativeWidth: 1 + random.below(3),
        smoothness: random.pick(['auto', 0.01]),
        constraints: random.pick(['soft', 'hard']),
        anchorWeight: 10,
        edgeExponent: random.below(3) - 2,
        support: 4,
        order: 2 + random.below(3),
        precision: random.pick(['fixed', 'float']),
        sphereFit: random.pick(['rigid', 'similarity']),
      });
      const handles = [
        { vertex: 0 },
        random.pick([{ vertex: 3 }, { at: [0.3, 0.3, 0.4], kind: 'rotation' }, { at: { x: 0.4, y: 0.4, z: 0.4 } }]),
      ];
      return { options, handles, solve: some(random, { maxIterations: 3, tolerance: 1e-3, accelerate: false }), target: 0.5 };
    },
    run: ({ hb, body, options, handles, solve, target }) =>
      used(hb.irbf(body, options), (irbf) => {
        irbf.setHandles(handles);
        if (typeof target === 'number') irbf.targets[1] = target;
        irbf.solve(solve);
        const out = new Float32Array(3 * irbf.vertexCount);
        const turned = new Float32Array(out.length);
        irbf.deform(out, turned);
        return [out, turned, irbf.evaluate([0.3, 0.3, 0.3])];
      }),
  },
};

/** Uses what was made, and gives it back. @template {{ dispose(): void }} T @template R @param {T} made @param {(made: T) => R} use */
function used(made, use) {
  try {
    return use(made);
  } finally {
    made.dispose();
  }
}
