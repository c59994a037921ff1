/** A right value of each type that the package's calls take, by the type's name, for tests that pass a wrong one beside it. */
import { BoxGeometry, Mesh, MeshBasicMaterial, PerspectiveCamera, Raycaster, Vector3 } from 'three';
import { type BodyData, load } from '../../../wasm/ts/index.ts';
import { meshDocument, writeGlb } from '../../../web/assets/index.ts';
import { type AnyFigure, define, type Kit, linePlot, range } from '../../../web/figures/index.ts';
import { LinePlot } from '../../../web/figures/kit/line-plot.ts';
import { DeformedGeometry, deformable, draggable, HandleOverlay, meshFromObject, poseDriver } from '../../../web/three/index.ts';
import { FakeElement, fakeDocument } from './fake-element.ts';

export const hb = await load();

const box = () => new Mesh(new BoxGeometry(2, 1, 1, 4, 2, 2), new MeshBasicMaterial());
const { mesh } = meshFromObject(box());
const body: BodyData = await hb.bake(mesh, { centers: 10, resolution: 16, spheres: 10 });
const glb = meshDocument({ positions: mesh.positions, triangles: mesh.triangles } as never);
const data = () => ({ dimension: 1, points: [0, 1, 3], values: [2, 0, 1] });
const skin = () => ({ dimension: 2 as const, positions: [0, 0, 1, 0], weights: [1, 0, 0, 1] });
const square = { positions: [0, 0, 1, 0, 1, 1, 0, 1], dimension: 2 as const, triangles: [0, 1, 2, 0, 2, 3] };
const irbf = () => {
  const made = hb.irbf(body);
  made.setHandles([{ vertex: 0 }, { vertex: 1 }]);
  made.solve();
  return made;
};

const plotted = { label: 'A line', frame: [0, 5, 0, 5] as const, draw: () => {} };
const figure = (): AnyFigure =>
  define({
    id: 'mine',
    title: 'Mine',
    parameters: { x: range('X', { from: 0, to: 10, value: 1 }) },
    presets: [{ id: 'first', name: 'As it begins', state: {} }],
    make: () => ({}),
    panels: { plot: linePlot(plotted) },
  });

const overlay = () => {
  fakeDocument();
  const handles = new HandleOverlay({ camera: new PerspectiveCamera(), container: new FakeElement() as never });
  handles.set([
    { name: 'a', position: [0, 0, 0] },
    { name: 'b', position: [0, 0, 0] },
  ]);
  return handles;
};

/** An element, whose module wants a page that is there before it. */
const element = (name: 'HandleBodyElement' | 'PoseSpaceElement' | 'HandleFigureElement') => async () =>
  new (await import('../../../web/element/index.ts'))[name]();

/** In a page that is not there. */
const dragged = () => {
  fakeDocument();
  return draggable(box(), body, { hb, camera: new PerspectiveCamera(), container: new FakeElement() as unknown as HTMLElement });
};

export const samples: Readonly<Record<string, () => unknown>> = {
  Handlebody: () => hb,
  HandlebodyRuntime: () => hb,
  AbortSignal: () => new AbortController().signal,
  // Shapes and what is made of them.
  Mesh: () => mesh,
  BakeShape: () => mesh,
  SimplexMesh: () => square,
  BodyData: () => body,
  Numbers: () => [],
  RbfOptions: data,
  OutlierOptions: data,
  ShepardOptions: data,
  SimplexLinearOptions: data,
  MovingLeastSquaresOptions: data,
  TensionSplineOptions: data,
  NaturalNeighborOptions: () => ({ dimension: 2, points: [0, 0, 1, 0, 0, 1], values: [1, 2, 3] }),
  PoseSpaceOptions: () => ({ dimensions: ['x'], examples: [{ name: 'a', at: [0], shape: [1] }] }),
  SkinOptions: skin,
  LinearBlendOptions: skin,
  DiscreteGreenOptions: () => ({ size: 9, samples: [1, 5], values: [0, 1] }),
  MinimizeEnergyOptions: () => ({ energy: 'rigid' }),
  // Objects that the solver makes.
  Irbf: irbf,
  Rbf: () => hb.rbf(data()),
  Interpolant: () => hb.rbf(data()),
  Shepard: () => hb.shepard(data()),
  SimplexLinear: () => hb.simplexLinear(data()),
  MovingLeastSquares: () => hb.movingLeastSquares(data()),
  TensionSpline: () => hb.tensionSpline(data()),
  NaturalNeighbor: () => hb.naturalNeighbor({ dimension: 2, points: [0, 0, 1, 0, 0, 1], values: [1, 2, 3] }),
  PoseSpace: () => hb.poseSpace({ dimensions: ['x'], examples: [{ name: 'a', at: [0], shape: [1] }] }),
  LinearBlend: () => hb.linearBlend(skin()),
  DualQuaternion: () => hb.dualQuaternion(skin()),
  Skin: () => hb.linearBlend(skin()),
  BlendedSkin: () => hb.linearBlend(skin()),
  DiscreteGreen: () => hb.discreteGreen({ size: 9, samples: [1, 5], values: [0, 1] }),
  Tetrahedra: () => hb.tetrahedralize(mesh, { resolution: 4 }),
  BiharmonicWeights: () => hb.biharmonicWeights(square, [{ vertex: 0 }, { vertex: 2 }]),
  EnergyMinimizer: () => hb.minimizeEnergy(square, [{ vertex: 0 }, { vertex: 2 }], { energy: 'rigid' }),
  // three.js.
  Object3D: box,
  PerspectiveCamera: () => new PerspectiveCamera(),
  Raycaster: () => new Raycaster(new Vector3(0, 0, 5), new Vector3(0, 0, -1)),
  Vector3: () => new Vector3(),
  Deformable: () => deformable(box(), irbf()),
  Draggable: dragged,
  HTMLElement: () => new FakeElement(),
  PoseDriver: () =>
    poseDriver(hb, { dimensions: [{ name: 'x' }], examples: [{ name: 'a', at: [0], weights: [1] }], meshes: [box()] } as never),
  DeformedGeometry: () => new DeformedGeometry(meshFromObject(box()).parts),
  HandleOverlay: overlay,
  BareHandles: overlay,
  // Figures and elements.
  AnyFigure: figure,
  Figure: figure,
  RangeOptions: () => ({ from: 0, to: 10, value: 1 }),
  LinePlotOptions: () => plotted,
  PointSet: () => ({ dimension: 1, places: [0, 1], values: [1, 2] }),
  LinePlot: () => new LinePlot({ state: {} } as Kit<object>, plotted),
  Evaluable: () => ({ evaluate: (xs: Float64Array, out: Float64Array) => out.set(xs) }),
  ElementBase: element('HandleFigureElement'),
  ModelElement: element('PoseSpaceElement'),
  HandleBodyElement: element('HandleBodyElement'),
  PoseSpaceElement: element('PoseSpaceElement'),
  HandleFigureElement: element('HandleFigureElement'),
  // Files.
  Document: () => meshDocument({ positions: mesh.positions, triangles: mesh.triangles } as never),
  FileBytes: () => writeGlb({ positions: mesh.positions, triangles: mesh.triangles } as never),
};

/** Arguments that fit an object's sizes, for calls that need them. */
export const right: Readonly<Record<string, readonly unknown[]>> = {
  'Irbf.deform': [new Float32Array(mesh.positions.length)],
  'DeformedGeometry.update': [mesh.positions],
  attachPoseSpace: [glb, glb.getRoot().listMeshes()[0]],
  'PoseSpace.weights': [[0]],
  'PoseSpace.evaluate': [[0]],
  choice: ['Kernel', { gaussian: 'Gaussian', cubic: 'Cubic' }],
  onALine: [[[1, 2]]],
  inThePlane: [[[1, 2, 3]]],
  'Tetrahedra.sample': [hb.tetrahedralize(mesh, { resolution: 4 }).positions],
};
