// A page to be framed: one figure, named with its state behind "#", "embed.html#course-12&v1&narrow", and its height told to the page around.
import '../element/index.ts';
import { writeAddress } from '../ui/address.ts';
import { byId, h } from '../ui/dom.ts';

/** What iframe-resizer 4 (MIT) begins its messages with. */
const RESIZER = '[iFrameSizer]';

/** How the page around calls this frame, once its iframe-resizer has said so. */
let called: string | undefined;

const main = byId('embed');
const figure = h('handle-figure', { controls: true, caption: true, loading: 'eager' });

function follow(): void {
  const [name = '', ...state] = location.hash.slice(1).split('&');
  figure.setAttribute('name', name);
  figure.setAttribute('state', state.join('&'));
}

/** For any page that listens, for learning platforms (LTI), and for iframe-resizer. */
function tellHeight(event: 'init' | 'resize'): void {
  if (parent === window) return;
  const { offsetWidth: width, offsetHeight: height } = document.documentElement;
  parent.postMessage({ type: 'handlebody.resize', height }, '*');
  parent.postMessage({ subject: 'lti.frameResize', height }, '*');
  if (called !== undefined) parent.postMessage(`${RESIZER}${called}:${height}:${width}:${event}`, '*');
}

addEventListener('message', ({ data, source }) => {
  if (source !== parent || typeof data !== 'string' || !data.startsWith(RESIZER)) return;
  [called] = data.slice(RESIZER.length).split(':');
  tellHeight('init');
});
addEventListener('hashchange', follow);
figure.addEventListener('change', () => writeAddress(`${figure.name}&${figure.state}`));
new ResizeObserver(() => tellHeight('resize')).observe(document.documentElement);
follow();
main.replaceChildren(h('h1', {}, 'A live figure'), figure);
