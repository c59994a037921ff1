/** Movement that is only for show, and the wish to have none of it. */

const query = () => matchMedia('(prefers-reduced-motion: reduce)');

export function reducedMotion(): boolean {
  return query().matches;
}

export function onMotionChange(listener: () => void, signal: AbortSignal): void {
  query().addEventListener('change', listener, { signal });
}

/** From 0 to 1, slow at both ends. */
export function ease(part: number): number {
  const t = Math.min(Math.max(part, 0), 1);
  return t * t * (3 - 2 * t);
}
