import { PageError } from '../ui/page-error.ts';

/** Sides that a model is seen from, as of a person who looks at you: its front is at azimuth 0, its left at −90°. */
const SIDES = ['front', 'right', 'back', 'left'] as const;
/** Degrees from the horizon beyond which a model is seen from above or from below. */
const STEEP = 60;

export type Side = (typeof SIDES)[number] | 'above' | 'below';

/** What an author says of a model as it is seen from some sides. */
export type Views = Readonly<Partial<Record<Side, string>>>;

/** "front: It looks at you. | left: It looks to the left.", one part a side. Throws a sentence that quotes what is wrong. */
export function readViews(text: string): Views {
  const parts = text.split('|').filter((part) => part.trim() !== '');
  return Object.fromEntries(
    parts.map((part) => {
      const [, name = '', words = ''] = part.match(/^\s*(\w+)\s*:\s*(.*?)\s*$/s) ?? [];
      if (([...SIDES, 'above', 'below'] as readonly string[]).includes(name) && words) return [name, words];
      throw new PageError(
        'invalid-views',
        `The description “${part.trim()}” is not one of a side.`,
        'Write sides and words: “front: It looks at you. | left: It looks to the left.” Sides are front, right, back, left, above and below.',
      );
    }),
  );
}

/** The side that a camera is on, by the direction from the model to it (Y up, the front along +Z). */
export function sideOf({ x, y, z }: { readonly x: number; readonly y: number; readonly z: number }): Side {
  const height = (Math.atan2(y, Math.hypot(x, z)) * 180) / Math.PI;
  if (Math.abs(height) > STEEP) return height > 0 ? 'above' : 'below';
  const quarters = Math.round(Math.atan2(x, z) / (Math.PI / 2));
  return SIDES[(quarters + 4) % 4] as Side;
}

/** In words: the author's, after the side. */
export function describeView(side: Side, views: Views): string {
  const place = side === 'above' || side === 'below' ? side : `the ${side}`;
  return `Seen from ${place}.${views[side] ? ` ${views[side]}` : ''}`;
}
