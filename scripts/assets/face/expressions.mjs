/**
 * Expressions: named sums of the face units, and their places on Russell's plane of valence and arousal.
 *
 * The expressions are made by this project and checked by eye; they come from no study. A unit that has a left and a right
 * half may be named without the side, and then stands for both.
 *
 * Places, by where they come from:
 * - "read": read off Russell (1980), A circumplex model of affect, Fig. 4; one reader's digitisation, so approximate;
 * - "circle": the direction is from the circular scaling of the same paper as commonly tabulated; the radius is ours;
 * - "ours": placed by this project.
 */
import { UNITS } from './units.mjs';

/**
 * @typedef {object} Expression
 * @property {string} name
 * @property {[number, number]} at Valence and arousal.
 * @property {'read' | 'circle' | 'ours'} place Where `at` comes from.
 * @property {Record<string, number>} units
 */

/**
 * @param {number} degrees
 * @param {number} radius
 * @returns {[number, number]}
 */
function onCircle(degrees, radius) {
  const round = /** @type {(x: number) => number} */ ((x) => Math.round(100 * x) / 100);
  return [round(radius * Math.cos((degrees * Math.PI) / 180)), round(radius * Math.sin((degrees * Math.PI) / 180))];
}

/** @type {Expression[]} */
export const EXPRESSIONS = [
  { name: 'neutral', at: [0, 0], place: 'ours', units: {} },
  {
    name: 'astonished',
    at: [0.16, 0.89],
    place: 'read',
    units: { eyeWide: 0.85, browInnerUp: 0.8, browOuterUp: 0.9, jawOpen: 0.55, mouthFunnel: 0.3, mouthUpperUp: 0.1 },
  },
  {
    name: 'excited',
    at: [0.62, 0.76],
    place: 'read',
    units: {
      mouthSmile: 0.85,
      jawOpen: 0.42,
      mouthUpperUp: 0.35,
      mouthLowerDown: 0.2,
      eyeWide: 0.45,
      browInnerUp: 0.6,
      browOuterUp: 0.75,
      cheekSquint: 0.35,
    },
  },
  {
    name: 'delighted',
    at: onCircle(25, 0.95),
    place: 'circle',
    units: {
      mouthSmile: 1,
      jawOpen: 0.3,
      mouthUpperUp: 0.4,
      mouthLowerDown: 0.1,
      cheekSquint: 0.9,
      eyeSquint: 0.5,
      browInnerUp: 0.35,
      browOuterUp: 0.4,
      mouthDimple: 0.2,
    },
  },
  {
    name: 'happy',
    at: [0.83, 0.53],
    place: 'read',
    units: {
      mouthSmile: 0.9,
      jawOpen: 0.1,
      mouthUpperUp: 0.35,
      cheekSquint: 0.6,
      eyeSquint: 0.3,
      browInnerUp: 0.15,
      browOuterUp: 0.2,
    },
  },
  {
    name: 'pleased',
    at: [0.77, 0.19],
    place: 'read',
    units: {
      mouthSmile: 0.6,
      mouthDimple: 0.3,
      cheekSquint: 0.4,
      eyeSquint: 0.25,
      browInnerUp: 0.15,
      browOuterUp: 0.1,
      mouthPress: 0.15,
    },
  },
  {
    name: 'content',
    at: onCircle(323, 0.85),
    place: 'circle',
    units: { mouthSmile: 0.5, mouthDimple: 0.15, eyeBlink: 0.26, cheekSquint: 0.4, eyeSquint: 0.25, mouthPress: 0.15 },
  },
  {
    name: 'at ease',
    at: [0.59, -0.26],
    place: 'read',
    units: { mouthSmile: 0.36, eyeBlink: 0.16, eyeSquint: 0.1, browInnerUp: 0.15, browOuterUp: 0.1 },
  },
  { name: 'calm', at: [0.56, -0.31], place: 'read', units: { mouthSmile: 0.22, eyeBlink: 0.27, mouthPress: 0.1 } },
  {
    name: 'relaxed',
    at: [0.69, -0.45],
    place: 'read',
    units: { mouthSmile: 0.34, eyeBlink: 0.64, browInnerUp: 0.2, browOuterUp: 0.15 },
  },
  {
    name: 'sleepy',
    at: [0.28, -0.67],
    place: 'read',
    units: { eyeBlink: 0.44, eyeLookDown: 0.2, browInnerUp: 0.5, browOuterUp: 0.5, mouthFrown: 0.12, mouthShrugLower: 0.05 },
  },
  {
    name: 'tired',
    at: [0.04, -0.63],
    place: 'read',
    units: { eyeBlink: 0.3, eyeLookDown: 0.35, browInnerUp: 0.5, eyeSquint: 0.2, mouthFrown: 0.4, mouthShrugLower: 0.15 },
  },
  {
    name: 'bored',
    at: [-0.66, -0.63],
    place: 'read',
    units: {
      eyeBlink: 0.3,
      eyeLookOutLeft: 0.6,
      eyeLookInRight: 0.6,
      eyeLookUp: 0.3,
      mouthFrown: 0.35,
      mouthPress: 0.45,
      mouthRight: 0.3,
      mouthShrugLower: 0.25,
      browOuterUpRight: 0.25,
    },
  },
  {
    name: 'sad',
    at: [-0.65, -0.27],
    place: 'read',
    units: {
      browInnerUp: 1,
      browDown: 0.15,
      mouthFrown: 0.75,
      mouthShrugLower: 0.5,
      eyeBlink: 0.2,
      eyeLookDown: 0.35,
      eyeSquint: 0.25,
    },
  },
  {
    name: 'miserable',
    at: [-0.7, -0.08],
    place: 'read',
    units: {
      browInnerUp: 1,
      browDown: 0.45,
      mouthFrown: 1,
      mouthShrugLower: 0.8,
      eyeSquint: 0.9,
      eyeBlink: 0.15,
      cheekSquint: 0.6,
      mouthStretch: 0.4,
      noseSneer: 0.35,
    },
  },
  {
    name: 'contemptuous',
    at: [-0.55, 0.12],
    place: 'ours',
    units: {
      mouthSmileLeft: 0.6,
      mouthDimpleLeft: 0.8,
      mouthUpperUpLeft: 0.15,
      mouthPress: 0.4,
      noseSneerLeft: 0.4,
      eyeSquint: 0.45,
      eyeBlink: 0.2,
      browOuterUpRight: 0.7,
      browDownLeft: 0.5,
      cheekSquintLeft: 0.3,
      eyeLookOutRight: 0.25,
      eyeLookInLeft: 0.25,
    },
  },
  {
    name: 'disgusted',
    at: [-0.65, 0.35],
    place: 'ours',
    units: {
      noseSneer: 1,
      mouthUpperUp: 0.6,
      browDown: 0.7,
      eyeSquint: 0.8,
      eyeBlink: 0.1,
      mouthFrown: 0.6,
      cheekSquint: 0.6,
      mouthShrugLower: 0.8,
    },
  },
  {
    name: 'annoyed',
    at: [-0.55, 0.41],
    place: 'read',
    units: {
      browDown: 0.75,
      eyeSquint: 0.5,
      eyeBlink: 0.12,
      mouthPress: 0.6,
      mouthFrown: 0.35,
      mouthLeft: 0.35,
      mouthRollUpper: 0.2,
      noseSneer: 0.15,
    },
  },
  {
    name: 'frustrated',
    at: [-0.65, 0.51],
    place: 'read',
    units: {
      browDown: 0.9,
      browInnerUp: 0.45,
      eyeSquint: 0.6,
      mouthPress: 0.8,
      mouthStretch: 0.55,
      mouthRollLower: 0.5,
      mouthRollUpper: 0.4,
      mouthFrown: 0.5,
      noseSneer: 0.45,
      cheekPuff: 0.15,
    },
  },
  {
    name: 'angry',
    at: [-0.52, 0.58],
    place: 'read',
    units: {
      browDown: 1,
      eyeSquint: 0.2,
      eyeWide: 0.25,
      noseSneer: 0.9,
      mouthUpperUp: 0.75,
      mouthLowerDown: 0.35,
      mouthStretch: 0.45,
      jawForward: 0.1,
      cheekSquint: 0.2,
    },
  },
  {
    name: 'afraid',
    at: [-0.34, 0.64],
    place: 'read',
    units: {
      browInnerUp: 1,
      browOuterUp: 0.35,
      browDown: 0.35,
      eyeWide: 0.85,
      mouthStretch: 0.75,
      jawOpen: 0.2,
      mouthLowerDown: 0.15,
      mouthFrown: 0.25,
    },
  },
];

/**
 * @param {Expression} expression
 * @returns {number[]} One weight for each of `UNITS`.
 */
export function weightsOf(expression) {
  const weights = UNITS.map(() => 0);
  for (const [name, weight] of Object.entries(expression.units)) {
    const targets = UNITS.flatMap((unit, i) => (unit === name || unit === `${name}Left` || unit === `${name}Right` ? [i] : []));
    if (targets.length === 0) throw new Error(`The expression ${expression.name} names a face unit that is not one: ${name}.`);
    for (const i of targets) weights[i] = weight;
  }
  return weights;
}
