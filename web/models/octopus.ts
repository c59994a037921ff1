import type { Ball, Limb } from './solid-field.ts';

/** How each arm lies, from the front all around: which way it goes, how far it reaches, how high its middle is lifted, how its end curls. */
const ARMS = [
  { turn: 18, reach: 0.98, lift: 0.16, curl: 200 },
  { turn: 66, reach: 0.86, lift: 0.05, curl: -230 },
  { turn: 112, reach: 1.02, lift: 0.22, curl: -160 },
  { turn: 158, reach: 0.9, lift: 0.04, curl: 240 },
  { turn: 203, reach: 1.04, lift: 0.14, curl: 170 },
  { turn: 248, reach: 0.84, lift: 0.26, curl: 220 },
  { turn: 294, reach: 0.98, lift: 0.06, curl: -190 },
  { turn: 339, reach: 0.88, lift: 0.1, curl: -240 },
] as const;

/** An octopus that sits on its arms: a mantle that leans back, and eight arms that taper, bend and curl at their ends. */
export const octopus: Limb = {
  fillet: 0.1,
  balls: [
    [0.1, 0.3, 0, 0.25],
    [0, 0.5, 0, 0.25],
    [-0.16, 0.8, 0.02, 0.36],
    [-0.34, 1.1, 0.03, 0.27],
  ],
  tip: 'mantle',
  limbs: [eye(1), eye(-1), ...ARMS.map(arm)],
};

function eye(side: number): Limb {
  return {
    balls: [
      [0.12, 0.5, 0.13 * side, 0.08],
      [0.2, 0.58, 0.19 * side, 0.075],
    ],
  };
}

function arm({ turn, reach, lift, curl }: (typeof ARMS)[number], i: number): Limb {
  const balls: Ball[] = [];
  let heading = (turn * Math.PI) / 180;
  let [x, z] = [0.1 + 0.08 * Math.cos(heading), 0.08 * Math.sin(heading)];
  const steps = 8;
  for (let k = 0; k <= steps; k++) {
    const t = k / steps;
    const height = 0.24 * (1 - t) ** 2 + lift * Math.sin(Math.PI * t) ** 2 + 0.06 + 0.1 * t * t;
    balls.push([x, height, z, 0.115 * (1 - t) + 0.03]);
    const step = ((1.45 - 0.5 * t) * reach) / steps;
    x += step * Math.cos(heading);
    z += step * Math.sin(heading);
    // Straight out at first, then tighter and tighter.
    heading += ((curl * Math.PI) / 180) * ((2.6 * Math.max(t - 0.25, 0) ** 1.6) / steps) * 1.6;
  }
  return { balls, tip: `arm ${i + 1}` };
}
