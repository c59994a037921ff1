import { pair } from './four-legged.ts';
import type { Ball, Limb } from './solid-field.ts';

/** On one leg, the other drawn up beside it; the neck bends back upon itself. */
export const flamingo: Limb = {
  fillet: 0.08,
  balls: [
    [-0.34, 1.06, 0, 0.1],
    [-0.16, 1.12, 0, 0.2],
    [0.1, 1.16, 0, 0.2],
    [0.24, 1.18, 0, 0.13],
  ],
  limbs: [
    { tip: 'tail', balls: [[-0.36, 1.06, 0, 0.09], [-0.52, 0.98, 0, 0.06], [-0.6, 0.94, 0, 0.045]] },
    { tip: 'left foot', balls: [[-0.02, 1.0, 0.05, 0.09], [-0.04, 0.8, 0.06, 0.04], [-0.06, 0.5, 0.04, 0.032], [-0.02, 0.1, 0.02, 0.03], [0.06, 0.04, 0.02, 0.03], [0.16, 0.035, 0.02, 0.03]] },
    { tip: 'right foot', balls: [[0.0, 1.0, -0.07, 0.09], [0.1, 0.8, -0.09, 0.04], [0.16, 0.64, -0.09, 0.034], [0.06, 0.58, -0.08, 0.03], [-0.14, 0.5, -0.07, 0.03], [-0.26, 0.4, -0.07, 0.03]] },
    {
      fillet: 0.03,
      balls: [
        [0.26, 1.2, 0, 0.1],
        [0.42, 1.2, 0.02, 0.065],
        [0.52, 1.36, 0.04, 0.052],
        [0.42, 1.54, 0.06, 0.048],
        [0.34, 1.74, 0.06, 0.046],
        [0.42, 1.92, 0.04, 0.05],
        [0.54, 1.94, 0.02, 0.075],
      ],
      limbs: [{ tip: 'beak', balls: [[0.58, 1.94, 0.01, 0.07], [0.7, 1.88, 0, 0.046], [0.73, 1.76, 0, 0.03]] }],
    },
  ],
};

/** A feather or toe at the end of a limb. */
const WING_FLAT = { along: [0, 0.98, -0.2] as const, to: 0.2 };

function wing(lift: number): Limb {
  return {
    fillet: 0.05,
    flat: WING_FLAT,
    tip: 'wing',
    balls: [
      [0.04, 0.34, 0.1, 0.2],
      [0.1, 0.34 + 0.5 * lift, 0.42, 0.22],
      [0.02, 0.34 + 0.95 * lift, 0.76, 0.19],
      [-0.16, 0.34 + lift, 1.02, 0.13],
    ],
  };
}

/** In flight, wings above the body. */
export const bird: Limb = {
  fillet: 0.06,
  balls: [
    [-0.34, 0.28, 0, 0.1],
    [-0.1, 0.28, 0, 0.17],
    [0.16, 0.3, 0, 0.18],
    [0.3, 0.33, 0, 0.13],
  ],
  limbs: [
    ...pair(wing(0.34)),
    { flat: { along: [0.2, 0.98, 0], to: 0.34 }, tip: 'tail', balls: [[-0.36, 0.28, 0, 0.1], [-0.58, 0.26, 0, 0.13], [-0.74, 0.26, 0, 0.12]] },
    ...pair({ tip: 'foot', balls: [[-0.14, 0.18, 0.06, 0.06], [-0.24, 0.08, 0.08, 0.035], [-0.4, 0.06, 0.08, 0.032]] }),
    {
      fillet: 0.03,
      balls: [[0.36, 0.36, 0, 0.11], [0.46, 0.42, 0, 0.125], [0.5, 0.42, 0, 0.11]],
      limbs: [{ tip: 'beak', balls: [[0.56, 0.42, 0, 0.07], [0.66, 0.4, 0, 0.045], [0.74, 0.37, 0, 0.028]] }],
    },
  ],
};

/** Runs: one arm forward, one knee up, a hand near the chest. */
export const acrobat: Limb = {
  fillet: 0.08,
  balls: [
    [-0.02, 0.98, 0, 0.16],
    [0, 1.16, 0, 0.15],
    [0.04, 1.4, 0, 0.18],
  ],
  limbs: [
    { fillet: 0.03, tip: 'left foot', balls: [[0, 0.92, 0.1, 0.12], [0.26, 0.72, 0.13, 0.085], [0.34, 0.62, 0.13, 0.075], [0.24, 0.42, 0.13, 0.062], [0.18, 0.18, 0.13, 0.052], [0.2, 0.12, 0.13, 0.055], [0.34, 0.1, 0.14, 0.05]] },
    { tip: 'right foot', balls: [[-0.04, 0.92, -0.1, 0.12], [-0.1, 0.54, -0.12, 0.08], [-0.3, 0.32, -0.12, 0.066], [-0.5, 0.18, -0.12, 0.054], [-0.52, 0.12, -0.12, 0.055], [-0.44, 0.0, -0.12, 0.05]] },
    { tip: 'left hand', balls: [[0.04, 1.46, 0.16, 0.09], [-0.1, 1.28, 0.3, 0.065], [-0.22, 1.16, 0.34, 0.056], [-0.12, 1.0, 0.36, 0.05], [-0.02, 0.92, 0.34, 0.055]] },
    { tip: 'right hand', balls: [[0.04, 1.46, -0.16, 0.09], [0.2, 1.3, -0.3, 0.065], [0.28, 1.24, -0.3, 0.056], [0.4, 1.36, -0.2, 0.05], [0.46, 1.46, -0.12, 0.056]] },
    { fillet: 0.03, balls: [[0.06, 1.52, 0, 0.09], [0.09, 1.68, 0, 0.08], [0.11, 1.8, 0, 0.15], [0.12, 1.88, 0, 0.145]], tip: 'head' },
  ],
};

/** Five arms that walk: some raised, all bent. */
const STAR = [
  { turn: 0, bend: 24, lift: 0.3 },
  { turn: 76, bend: -30, lift: 0.02 },
  { turn: 142, bend: 34, lift: 0.16 },
  { turn: 218, bend: 20, lift: 0.02 },
  { turn: 288, bend: -36, lift: 0.2 },
] as const;

export const starfish: Limb = {
  fillet: 0.14,
  balls: [
    [0, 0.12, 0, 0.18],
    [0, 0.2, 0, 0.18],
  ],
  limbs: STAR.map(({ turn, bend, lift }, i) => {
    const balls: Ball[] = [0, 0.25, 0.5, 0.75, 1].map((t): Ball => {
      const angle = ((turn + bend * t * t) * Math.PI) / 180;
      const out = 0.06 + 0.94 * t;
      return [out * Math.cos(angle), 0.13 + lift * t * t, out * Math.sin(angle), 0.17 - 0.125 * t];
    });
    return { tip: `arm ${i + 1}`, balls };
  }),
};

/** Where a crane fly's legs go: first hip, knee and foot on each side. */
const FLY_LEGS: readonly (readonly [side: string, hip: number, knee: Ball, shin: Ball, foot: Ball])[] = [
  ['left fore', 0.26, [0.5, 0.86, 0.34, 0.032], [0.78, 0.42, 0.5, 0.03], [1.0, 0.03, 0.58, 0.03]],
  ['right fore', 0.26, [0.56, 0.82, -0.26, 0.032], [0.86, 0.44, -0.36, 0.03], [1.14, 0.03, -0.36, 0.03]],
  ['left mid', 0.14, [0.18, 0.9, 0.5, 0.032], [0.24, 0.42, 0.8, 0.03], [0.22, 0.03, 1.02, 0.03]],
  ['right mid', 0.14, [0.1, 0.9, -0.5, 0.032], [0.02, 0.42, -0.8, 0.03], [0.08, 0.03, -1.02, 0.03]],
  ['left hind', 0.02, [-0.3, 0.9, 0.34, 0.032], [-0.56, 0.42, 0.52, 0.03], [-0.82, 0.03, 0.62, 0.03]],
  ['right hind', 0.02, [-0.24, 0.92, -0.4, 0.032], [-0.4, 0.42, -0.64, 0.03], [-0.56, 0.03, -0.86, 0.03]],
];

/** Six hair-thin legs with high knees around a small body, and two narrow wings laid back over it. */
export const craneFly: Limb = {
  fillet: 0.04,
  balls: [
    [0.02, 0.58, 0, 0.11],
    [0.16, 0.62, 0, 0.14],
    [0.28, 0.58, 0, 0.1],
  ],
  limbs: [
    ...FLY_LEGS.map(([side, hip, knee, shin, foot]): Limb => {
      const way = Math.sign(knee[2]);
      return { tip: `${side}foot`, balls: [[hip, 0.54, 0.06 * way, 0.045], [(hip + knee[0]) / 2, 0.72, knee[2] * 0.55, 0.036], knee, shin, foot] };
    }),
    { tip: 'abdomen', balls: [[-0.02, 0.58, 0, 0.08], [-0.34, 0.5, 0, 0.075], [-0.66, 0.4, 0, 0.06], [-0.76, 0.36, 0, 0.04]] },
    ...pair({
      flat: { along: [0.28, 0.96, 0], to: 0.28 },
      tip: 'wing',
      balls: [[0.12, 0.7, 0.07, 0.07], [-0.12, 0.78, 0.24, 0.1], [-0.42, 0.86, 0.42, 0.13], [-0.62, 0.92, 0.52, 0.1]],
    }),
    { fillet: 0.02, tip: 'nose', balls: [[0.34, 0.58, 0, 0.08], [0.42, 0.54, 0, 0.085], [0.54, 0.46, 0, 0.035]] },
  ],
};
