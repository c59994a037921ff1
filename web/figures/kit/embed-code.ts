import { button, h } from '../../ui/dom.ts';

/** A figure as it is to be embedded. */
interface Embedded {
  /** Address of the site that has embed.html and the elements' script, with a slash at the end. */
  readonly site: string;
  readonly name: string;
  readonly title: string;
  readonly state: string;
  /** Pixels that it takes here. */
  readonly height: number;
}

/** Pixels that embed.html leaves free above and below. */
const MARGINS = 8;

/** Shows what to write into a page of one's own, as the figure is now: a frame, or the element. */
export function offerEmbed(figure: Embedded): void {
  const close = () => sheet.hidePopover();
  const sheet = h(
    'div',
    { class: 'help', popover: '', role: 'dialog', 'aria-label': 'Embed this figure' },
    h('div', { class: 'help-head' }, h('h2', {}, 'Embed this figure'), button('×', close, 'dismiss', { 'aria-label': 'Close' })),
    ...sample('As a frame, which needs nothing else', frameOf(figure)),
    ...sample('As an element, in a page that may run scripts of this site', elementOf(figure)),
  );
  sheet.addEventListener('toggle', (event) => {
    if (event.newState === 'closed') sheet.remove();
  });
  document.body.append(sheet);
  sheet.showPopover();
}

function frameOf({ site, name, title, state, height }: Embedded): string {
  const src = `${site}embed.html#${name}&${state}`;
  return h('iframe', { src, title, width: '100%', height: height + MARGINS, style: 'border: 0', loading: 'lazy' }).outerHTML;
}

function elementOf({ site, name, state }: Embedded): string {
  const script = h('script', { type: 'module', src: `${site}handlebody.standalone.js` });
  // Its attributes only: the element itself would begin to work.
  const attributes = h('i', { name, state }).outerHTML.replace(/^<i(.*)><\/i>$/s, '$1');
  return `${script.outerHTML}\n<handle-figure${attributes} controls caption></handle-figure>`;
}

/** Words, the code, and a button that copies it. */
function sample(words: string, code: string): HTMLElement[] {
  const field = h('textarea', { class: 'code', readonly: true, rows: 6, spellcheck: 'false', 'aria-label': words });
  field.value = code;
  const copy = button('Copy', async () => {
    try {
      await navigator.clipboard.writeText(code);
      copy.textContent = 'Copied';
    } catch {
      // As where the page did not come by https: by hand, then.
      field.select();
      copy.textContent = 'Selected, to be copied';
    }
  });
  return [h('h3', {}, words), field, h('p', {}, copy)];
}
