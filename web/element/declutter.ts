/** A label of some width and height; `x` and `y` are its dot's, or its own left and top when it has a fixed place. */
export interface Label {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

interface Box {
  readonly left: number;
  readonly top: number;
  readonly right: number;
  readonly bottom: number;
}

interface Place {
  readonly x: number;
  readonly y: number;
  /** Otherwise it needs a line to its dot. */
  readonly near: boolean;
}

/** Directions from a dot to its label's middle, the pleasant ones first: beside, above and below, between. */
const DIRECTIONS = [0, 180, 270, 90, 330, 30, 210, 150, 300, 60, 240, 120].map((degrees) => {
  const angle = (degrees * Math.PI) / 180;
  return [Math.cos(angle), Math.sin(angle)] as const;
});

const NEAR = 1;
const CANDIDATES = [NEAR, 9, 17, 26].flatMap((away) => DIRECTIONS.map(([dx, dy]) => [away, dx, dy] as const));

/**
 * A place for each label beside its dot (`radius`) where it covers neither another label nor a dot nor leaves the square of this
 * `size`, nor covers what is `fixed`; `undefined` for a label that fits nowhere. Greedy: dots in a crowd choose first.
 */
export function declutter(labels: readonly Label[], fixed: readonly Label[], size: number, radius: number): (Place | undefined)[] {
  const taken: Box[] = labels.map(({ x, y }) => ({ left: x - radius, right: x + radius, top: y - radius, bottom: y + radius }));
  for (const { x, y, width, height } of fixed) taken.push({ left: x, top: y, right: x + width, bottom: y + height });
  const crowd = labels.map((a) => labels.reduce((sum, b) => sum + 1 / (20 + Math.hypot(a.x - b.x, a.y - b.y)), 0));
  const order = labels.map((_, i) => i).sort((a, b) => (crowd[b] as number) - (crowd[a] as number));
  const places: (Place | undefined)[] = labels.map(() => undefined);
  for (const i of order) {
    const { x, y, width, height } = labels[i] as Label;
    for (const [away, dx, dy] of CANDIDATES) {
      // The label's box touches a circle around the dot from this side.
      const left = x + dx * (radius + away) + ((dx - 1) * width) / 2;
      const top = y + dy * (radius + away) + ((dy - 1) * height) / 2;
      const box = { left, top, right: left + width, bottom: top + height };
      if (left < 0 || top < 0 || box.right > size || box.bottom > size) continue;
      if (taken.some((other) => overlap(box, other))) continue;
      taken.push(box);
      places[i] = { x: left, y: top, near: away === NEAR };
      break;
    }
  }
  return places;
}

function overlap(a: Box, b: Box): boolean {
  return a.left < b.right && a.right > b.left && a.top < b.bottom && a.bottom > b.top;
}
