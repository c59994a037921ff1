import type { WeightsKind } from '../../kit/plane-weights.ts';

/** The ways from handles to a deformed shape that the page compares. */
export type EnergyKind = 'rigid' | 'conformal' | 'laplacian' | 'dirichlet';
export type DistanceKind = 'interior' | 'euclidean';
export type Family = 'linear' | 'rigid' | 'energy' | 'irbf';
export type MethodId = `linear-${WeightsKind}` | `rigid-${WeightsKind}` | `energy-${EnergyKind}` | `irbf-${DistanceKind}`;

export interface Method {
  readonly id: MethodId;
  readonly family: Family;
  readonly kind: WeightsKind | EnergyKind | DistanceKind;
  /** Within its family. */
  readonly name: string;
  /** Anywhere. */
  readonly title: string;
}

export const FAMILIES: readonly { id: Family; name: string; said: string }[] = [
  {
    id: 'linear',
    name: 'Linear',
    said: 'Every point follows the weighted sum of the handles’ transformations: linear blend skinning.',
  },
  {
    id: 'rigid',
    name: 'Rigid',
    said: 'The same weights blend rotations as dual quaternions: no point collapses where turns meet.',
  },
  { id: 'energy', name: 'Energy', said: 'No weights: the shape that an energy likes best among all that obey the handles.' },
  {
    id: 'irbf',
    name: 'IRBF',
    said: 'Interior radial basis functions: the shape becomes a thin slab, its centers reach through its inside.',
  },
];

const WEIGHTS: readonly (readonly [WeightsKind, string, string])[] = [
  ['biharmonic', 'Biharmonic', '‖Δw‖² is least: smooth, but free to leave 0 to 1.'],
  ['bounded', 'Bounded', '‖Δw‖² is least among weights from 0 to 1: smooth and local.'],
  ['harmonic', 'Harmonic', '‖∇w‖² is least: within bounds, with a spike at every point.'],
  ['triharmonic', 'Triharmonic', '‖∇Δw‖² is least: smoother still, and swings more.'],
];

const ENERGIES: readonly (readonly [EnergyKind, string, string])[] = [
  ['rigid', 'As rigid as possible', 'Every small piece turns, none stretches if it can help it (ARAP).'],
  ['conformal', 'As similar as possible', 'Angles stay; sizes may change (conformal energy, ASAP).'],
  ['laplacian', 'Laplacian', 'The displacement bends as little as it can: smooth, blind to turns.'],
  ['dirichlet', 'Dirichlet', 'The displacement stretches as little as it can: spikes at points.'],
];

const DISTANCES: readonly (readonly [DistanceKind, string, string])[] = [
  ['interior', 'Interior distance', 'Measured through the inside: an arm does not pull the leg beside it.'],
  ['euclidean', 'Euclidean distance', 'Measured straight through the air: what is near moves along.'],
];

const SAID = new Map<string, string>([...WEIGHTS, ...ENERGIES, ...DISTANCES].map(([kind, , said]) => [kind, said]));

const of = <K extends Method['kind']>(
  family: Family,
  kinds: readonly (readonly [K, string, string])[],
  title: (name: string, kind: K) => string,
): Method[] => kinds.map(([kind, name]) => ({ id: `${family}-${kind}` as MethodId, family, kind, name, title: title(name, kind) }));

export const METHODS: readonly Method[] = [
  ...of('linear', WEIGHTS, (name) => `${name}, linear`),
  ...of('rigid', WEIGHTS, (name) => `${name}, rigid`),
  ...of('energy', ENERGIES, (name) => name),
  ...of('irbf', DISTANCES, (_, kind) => `IRBF, ${kind === 'interior' ? kind : 'Euclidean'}`),
];

export const WEIGHTS_KINDS: readonly WeightsKind[] = WEIGHTS.map(([kind]) => kind);

export function methodOf(id: string): Method | undefined {
  return METHODS.find((method) => method.id === id);
}

export function saidOf({ kind }: Method): string {
  return SAID.get(kind) ?? '';
}

/** The weights under a method; energies and IRBF have none. */
export function weightsOf(method: Method): WeightsKind | undefined {
  return method.family === 'linear' || method.family === 'rigid' ? (method.kind as WeightsKind) : undefined;
}
