/** Pixels that a handle keeps from the rim when its place is beyond it: all of it is seen. */
const INSET = 22;

/**
 * Puts the middle of an absolutely positioned handle over a place of its area, in pixels. Where that lies outside, the handle stands at the
 * rim instead and has `data-outside`, by which style sheets hide it until it has the focus.
 */
export function putHandle(handle: HTMLElement, x: number, y: number, width: number, height: number): void {
  // Half a pixel for rounding.
  const outside = x < -0.5 || y < -0.5 || x > width + 0.5 || y > height + 0.5;
  const inset = outside ? INSET : 0;
  // Parts of the area, since paper has another size and asks nobody.
  handle.style.left = `${((100 * Math.min(Math.max(x, inset), width - inset)) / width).toFixed(3)}%`;
  handle.style.top = `${((100 * Math.min(Math.max(y, inset), height - inset)) / height).toFixed(3)}%`;
  handle.style.translate = '-50% -50%';
  handle.toggleAttribute('data-outside', outside);
}
