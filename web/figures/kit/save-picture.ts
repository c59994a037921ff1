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

/** Offers a figure's pictures as a file: an SVG, or a PNG of twice the page's pixels. */
export async function savePicture(pictures: HTMLElement, name: string, kind: 'svg' | 'png'): Promise<void> {
  const drawing = drawingOf(pictures);
  const blob = kind === 'svg' ? new Blob([drawing], { type: 'image/svg+xml' }) : await pixelsOf(drawing, pictures);
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = `${name}.${kind}`;
  link.click();
  URL.revokeObjectURL(link.href);
}

/** Curves, axes, maps, views in space and what can be dragged on them, as they look, without the page's style sheets. */
function drawingOf(pictures: HTMLElement): string {
  const { left, top, width, height } = pictures.getBoundingClientRect();
  const whole = svg('svg', { xmlns: 'http://www.w3.org/2000/svg', width, height });
  whole.append(svg('rect', { width, height, fill: getComputedStyle(document.body).backgroundColor }));
  const seen = [...pictures.querySelectorAll<HTMLElement | SVGElement>('.chart, canvas, svg, .point, .handle')].filter(
    (part) => part.checkVisibility() && !part.closest('button svg, .swatch, .on-paper'),
  );
  for (const part of seen) {
    const box = part.getBoundingClientRect();
    const place = { x: box.x - left, y: box.y - top, width: box.width, height: box.height };
    if (part instanceof HTMLCanvasElement) whole.append(svg('image', { ...place, href: part.toDataURL() }));
    else if (part instanceof SVGElement) whole.append(flattened(part, place));
    else if (part.matches('.chart')) whole.append(svg('rect', { ...place, fill: getComputedStyle(part).backgroundColor }));
    else {
      const { borderTopColor: stroke, backgroundColor: fill } = getComputedStyle(part, '::before');
      const [cx, cy] = [place.x + place.width / 2, place.y + place.height / 2];
      whole.append(svg('circle', { cx, cy, r: 6, fill, stroke, 'stroke-width': 2.5 }));
    }
  }
  return new XMLSerializer().serializeToString(whole);
}

function flattened(drawn: SVGElement, place: Readonly<Record<string, number>>): SVGElement {
  const copy = drawn.cloneNode(true) as SVGElement;
  const [from, to] = [drawn.querySelectorAll('*'), copy.querySelectorAll<SVGElement>('*')];
  from.forEach((element, i) => {
    const style = getComputedStyle(element);
    for (const property of STYLES) to[i]?.style.setProperty(property, style.getPropertyValue(property));
  });
  for (const [name, value] of Object.entries(place)) copy.setAttribute(name, String(value));
  return copy;
}

async function pixelsOf(drawing: string, pictures: HTMLElement): Promise<Blob> {
  const { width, height } = pictures.getBoundingClientRect();
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [Math.round(width * FINE), Math.round(height * FINE)];
  const image = new Image();
  image.src = `data:image/svg+xml,${encodeURIComponent(drawing)}`;
  await image.decode();
  canvas.getContext('2d')?.drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((resolve, reject) => {
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('The picture cannot be saved.'))), 'image/png');
  });
}
