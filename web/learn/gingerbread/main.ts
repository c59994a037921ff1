import { byId } from '../../ui/dom.ts';
import { explain } from '../../ui/explain.ts';
import { lazy, NotFetched } from '../../ui/lazy.ts';
import { Page } from './page.ts';
import { Picture } from './picture.ts';

const state = byId('lesson').dataset;
const solverPart = lazy(() => import('../../../wasm/ts/index.ts'), 'The part of this page that bends the shape');

try {
  const page = new Page(pictureOn(byId<HTMLCanvasElement>('canvas')));
  // The shape is drawn first; what bends it is asked for after that.
  await new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
  state.state = 'drawn';
  await connect(page);
} catch (error) {
  const { message, remedy } = explain(error);
  state.state = 'failed';
  byId('trouble').hidden = false;
  byId('trouble').textContent = `${message} ${remedy}`;
}

async function connect(page: Page): Promise<void> {
  try {
    const { load } = await solverPart(page.address);
    page.connect(await load());
    state.state = 'ready';
  } catch (error) {
    // The shape stands there already; what does not come can be asked for again.
    if (!(error instanceof NotFetched)) throw error;
    page.trouble.tell(error, () => void connect(page));
  }
}

function pictureOn(canvas: HTMLCanvasElement): Picture {
  try {
    return new Picture(canvas);
  } catch (cause) {
    throw Object.assign(new Error('The shape cannot be drawn: this browser has no WebGL here.', { cause }), {
      code: 'webgl-unavailable',
      remedy: 'Turn on hardware acceleration in the browser’s settings, or try another browser.',
    });
  }
}
