import { h } from './dom.ts';

/** What the colors of a picture may depend on. */
const COLORS = ['(prefers-color-scheme: dark)', '(forced-colors: active)'];

/** Whether an element is in dark colors: as its page has it, and where that has both, as the reader wants it. */
export function isDark(element: Element): boolean {
  const scheme = getComputedStyle(element).colorScheme;
  return scheme.includes('dark') && (!scheme.includes('light') || matchMedia('(prefers-color-scheme: dark)').matches);
}

/**
 * Calls `changed` when a picture has to be laid out anew: its element has another size, the window is on a screen with other pixels, the
 * reader's colors are others, or the page's by an attribute of its root (as the themes of docs pages have it). Until the signal, or as long as the page. Not for paper, where no script draws in time: there style sheets keep
 * the shape of a picture, and what lies on it is placed in parts of it.
 */
export function onScreenChange(element: Element, changed: () => void, signal = new AbortController().signal): void {
  const paper = matchMedia('print');
  const tell = () => {
    if (!paper.matches) changed();
  };
  const sizes = new ResizeObserver(tell);
  sizes.observe(element);
  signal.addEventListener('abort', () => sizes.disconnect());
  for (const media of COLORS) matchMedia(media).addEventListener('change', tell, { signal });
  let dark = isDark(element);
  const theme = new MutationObserver(() => {
    const now = isDark(element);
    if (now !== dark) tell();
    dark = now;
  });
  for (const root of [document.documentElement, document.body]) theme.observe(root, { attributes: true });
  signal.addEventListener('abort', () => theme.disconnect());
  const watchPixels = () => {
    const pixels = matchMedia(`(resolution: ${devicePixelRatio}dppx)`);
    const next = () => {
      watchPixels();
      tell();
    };
    pixels.addEventListener('change', next, { once: true, signal });
  };
  watchPixels();
}

/** Lets a canvas of the graphics card be printed, of which browsers print what is left, at any size: on paper a copy stands in for it. */
export function onPaper(canvas: HTMLCanvasElement, draw: () => void, signal = new AbortController().signal): void {
  const copy = h('canvas', { class: 'on-paper', 'aria-hidden': 'true' });
  const put = () => {
    draw();
    copy.width = canvas.width;
    copy.height = canvas.height;
    copy.getContext('2d')?.drawImage(canvas, 0, 0);
    canvas.after(copy);
  };
  addEventListener('beforeprint', put, { signal });
  addEventListener('afterprint', () => copy.remove(), { signal });
}

/** Says in words that the graphics card was interrupted, and with no words that it is back, when everything is to be drawn again. */
export function onInterruption(
  canvas: HTMLCanvasElement,
  say: (words: string) => void,
  redraw: () => void,
  signal = new AbortController().signal,
): void {
  canvas.addEventListener(
    'webglcontextlost',
    (event) => {
      // Else browsers do not bring it back.
      event.preventDefault();
      say('The graphics were interrupted. They come back by themselves.');
    },
    { signal },
  );
  canvas.addEventListener(
    'webglcontextrestored',
    () => {
      say('');
      redraw();
    },
    { signal },
  );
}
