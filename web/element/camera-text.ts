import { PageError } from '../ui/page-error.ts';

/** "58deg 14deg", azimuth and height, either left out from the end. Throws a sentence that quotes what is wrong. */
export function readCamera(text: string): readonly number[] {
  const angles = text.trim() === '' ? [] : text.trim().split(/\s+/);
  const numbers = angles.map((angle) => (angle.replace(/deg$/, '') === '' ? Number.NaN : Number(angle.replace(/deg$/, ''))));
  if (numbers.length <= 2 && numbers.every(Number.isFinite)) return numbers;
  throw new PageError('invalid-camera', `The camera “${text}” is not two angles.`, 'Write azimuth and height: “58deg 14deg”.');
}
