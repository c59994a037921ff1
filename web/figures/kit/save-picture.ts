import { svg } from '../../ui/dom.ts';

/** What a style sheet decides of a drawing. */
const STYLES = [
  'fill',
  'stroke',
  'stroke-width',
  'stroke-dasharray',
  'stroke-linecap',
  'stroke-linejoin',
  'opacity',
  'font-family',
  'font-size',
  'font-weight',
] as const;

/** Pixels of a PNG for one of the page. */
const FINE = 2;

/** Offers a panel's drawing as a file: an SVG, or a PNG of twice the page's pixels. */
export async function savePicture(panel: HTMLElement, name: string, kind: 'svg' | 'png'): Promise<void> {
  const blob = kind === 'svg' ? new Blob([drawingOf(panel)], { type: 'image/svg+xml' }) : await pixelsOf(panel);
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = `${name}.${kind}`;
  link.click();
  URL.revokeObjectURL(link.href);
}

/** The panel's curves, axes and points, as they look, without the page's style sheets. */
function drawingOf(panel: HTMLElement): string {
  const drawn = panel.querySelector('svg');
  if (!drawn) throw new Error('The panel has no drawing.');
  const copy = drawn.cloneNode(true) as SVGSVGElement;
  const [from, to] = [drawn.querySelectorAll('*'), copy.querySelectorAll<SVGElement>('*')];
  from.forEach((element, i) => {
    const style = getComputedStyle(element);
    for (const property of STYLES) to[i]?.style.setProperty(property, style.getPropertyValue(property));
  });
  const box = drawn.getBoundingClientRect();
  copy.setAttribute('xmlns', 'http://www.w3.org/2000/svg');
  copy.setAttribute('width', String(box.width));
  copy.setAttribute('height', String(box.height));
  const ground = getComputedStyle(panel.querySelector('.chart') ?? panel).backgroundColor;
  copy.prepend(svg('rect', { width: '100%', height: '100%', fill: ground }));
  for (const handle of panel.querySelectorAll('.point')) {
    const { x, y, width, height } = handle.getBoundingClientRect();
    const { borderTopColor: stroke, backgroundColor: fill } = getComputedStyle(handle, '::before');
    copy.append(svg('circle', { cx: x + width / 2 - box.x, cy: y + height / 2 - box.y, r: 6, fill, stroke, 'stroke-width': 2.5 }));
  }
  return new XMLSerializer().serializeToString(copy);
}

async function pixelsOf(panel: HTMLElement): Promise<Blob> {
  const { width, height } = (panel.querySelector('svg') ?? panel).getBoundingClientRect();
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [Math.round(width * FINE), Math.round(height * FINE)];
  const image = new Image();
  image.src = `data:image/svg+xml,${encodeURIComponent(drawingOf(panel))}`;
  await image.decode();
  canvas.getContext('2d')?.drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((resolve, reject) => {
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('The picture cannot be saved.'))), 'image/png');
  });
}
