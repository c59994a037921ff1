import type { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { isDragging } from '../ui/drag.ts';

/**
 * Over a 3D view the wheel is the page's where it scrolls something, and the camera's with Ctrl, as are two fingers on a touchpad. To be
 * called before the controls are made, which else hear of it first.
 */
export function shareWheel(area: HTMLElement, signal: AbortSignal): void {
  const wheel = (event: WheelEvent) => {
    if (isDragging()) event.preventDefault();
    if (isDragging() || (!event.ctrlKey && isAboveScrolling(area))) event.stopImmediatePropagation();
  };
  area.addEventListener('wheel', wheel, { passive: false, signal });
}

/** Two fingers on a 3D view are the camera's, whatever they meet. Which way one finger scrolls the page is for the style sheet to say. */
export function keepTwoFingers(area: HTMLElement, controls: OrbitControls, signal: AbortSignal): void {
  const keep = (event: TouchEvent) => {
    if (event.touches.length > 1) event.preventDefault();
  };
  for (const type of ['touchstart', 'touchmove'] as const) area.addEventListener(type, keep, { passive: false, signal });

  let isHeld = false;
  controls.addEventListener('start', () => {
    isHeld = true;
  });
  controls.addEventListener('end', () => {
    isHeld = false;
  });
  // Prevented, it is not taken by a handle that it meets.
  area.addEventListener('pointerdown', (event) => isHeld && event.preventDefault(), { capture: true, signal });
}

/** Whether a wheel over an element scrolls a box around it, the page, or, for all that can be known, the page around its frame. */
function isAboveScrolling(element: HTMLElement): boolean {
  if (parent !== self) return true;
  // Out of an element's shadow, too.
  const above = (box: Element) => box.parentElement ?? (box.getRootNode() as Partial<ShadowRoot>).host ?? null;
  for (let box = above(element); box; box = above(box)) {
    const isLonger = box.scrollHeight > box.clientHeight + 1;
    if (isLonger && (box === document.documentElement || /auto|scroll/.test(getComputedStyle(box).overflowY))) return true;
  }
  return false;
}
