import { button, h } from './dom.ts';

/** Milliseconds for which the button says that it has copied. */
const SAID = 2000;

/**
 * Makes a button copy the page's address, which `write` brings up to date. Where the browser refuses that, as it does in the frame of another
 * site, the address is shown, selected, to be copied by hand.
 */
export function copyLink(button: HTMLElement, live: HTMLElement, write: () => void): void {
  const label = button.textContent;
  const say = (text: string) => {
    button.textContent = text;
    live.textContent = text;
  };
  const unsay = () => {
    button.textContent = label;
  };
  let timer: ReturnType<typeof setTimeout> | undefined;
  button.addEventListener('click', async () => {
    write();
    clearTimeout(timer);
    try {
      // There is no clipboard where the page did not come by https.
      await navigator.clipboard.writeText(location.href);
      say('Copied');
      timer = setTimeout(unsay, SAID);
    } catch {
      say('Not copied');
      offer(location.href, unsay);
    }
  });
}

function offer(link: string, closed: () => void): void {
  const field = h('input', { type: 'text', readonly: true, value: link, 'aria-label': 'Link to what the page shows' });
  field.style.cssText = 'inline-size: 100%; min-block-size: var(--target); margin-block-start: var(--gap-2)';
  const close = () => sheet.hidePopover();
  const sheet = h(
    'div',
    { class: 'help', popover: '', role: 'dialog', 'aria-label': 'Copy the link by hand' },
    h(
      'div',
      { class: 'help-head' },
      h('p', {}, 'This browser does not let the page copy. Here is the link, selected: copy it with the keyboard or the menu.'),
      button('×', close, 'dismiss', { 'aria-label': 'Close' }),
    ),
    field,
  );
  sheet.addEventListener('toggle', (event) => {
    if (event.newState !== 'closed') return;
    sheet.remove();
    closed();
  });
  document.body.append(sheet);
  sheet.showPopover();
  field.focus();
  field.select();
}
