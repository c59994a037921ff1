import { bringIntoRow } from '../../figures/kit/layout.ts';
import { Live, type Solvers } from '../../figures/kit/live.ts';
import { FIGURES, type Listed } from '../../figures/list.ts';
import { writeAddress } from '../../ui/address.ts';
import { copyLink } from '../../ui/copy-link.ts';
import { byId, h } from '../../ui/dom.ts';
import { lazy } from '../../ui/lazy.ts';
import { renewed } from '../../ui/solver-end.ts';
import { Trouble } from '../../ui/trouble.ts';

/** Where embed.html is. */
const site = new URL('../../', location.href).href;

interface Shown {
  readonly element: HTMLElement;
  state: string;
  dispose(): void;
}

const parts = new Map(FIGURES.map(({ id, title, load }) => [id, lazy(load, `The figure “${title}”`)]));
const solvers: Solvers = {
  runtime: solver(lazy(() => import('../../../wasm/ts/runtime.ts'), 'The solver')),
  whole: solver(lazy(() => import('../../../wasm/ts/index.ts'), 'The solver')),
};

/**
 * A page of figures: one at a time, which its address names and says the state of, "#course-12&v1&fig-12"; or of one figure alone, whose
 * state is all that the address says.
 */
function figurePage(only?: string): void {
  const [main, links] = [byId('figure'), byId('figures')];
  const trouble = h('p', { class: 'trouble', role: 'alert', hidden: true });
  const line = new Trouble(trouble, () => byId('copy'));
  let shown: { readonly listed: Listed; readonly live: Shown } | undefined;
  /** How often something was asked for: only what was asked for last is shown. */
  let asked = 0;
  const addressOf = (listed: Listed, text: string) => (only ? text : `${listed.id}&${text}`);
  main.replaceChildren(trouble);

  const open = async () => {
    const text = location.hash.slice(1);
    const id = only ?? text.split('&')[0];
    const listed = FIGURES.find((figure) => figure.id === id) ?? (only ? undefined : FIGURES[0]);
    if (!listed) return;
    const named = !only && id === listed.id;
    const state = named ? text.slice(listed.id.length + 1) : text;
    const mine = ++asked;
    for (const link of links.querySelectorAll('a')) {
      link.ariaCurrent = link.hash === `#${listed.id}` ? 'page' : null;
      if (link.ariaCurrent) bringIntoRow(link);
    }
    if (shown?.listed === listed) {
      shown.live.state = state;
      return;
    }
    // Nothing of the last one stands under the next one's name.
    shown?.live.dispose();
    shown = undefined;
    line.clear();
    main.ariaBusy = 'true';
    try {
      const figure = (await parts.get(listed.id)?.(addressOf(listed, state)))?.default;
      if (!figure || asked !== mine) return;
      const onChange = (changed: string, step: boolean) => writeAddress(addressOf(listed, changed), step);
      const address = (written: string) => addressOf(listed, written);
      shown = { listed, live: new Live(figure, { solvers, state, address, site, onChange }) };
      main.append(shown.live.element);
    } catch (error) {
      if (asked === mine) line.tell(error, () => void open());
    } finally {
      if (asked === mine) main.ariaBusy = 'false';
    }
  };

  if (only) links.remove();
  else links.append(...FIGURES.map(({ id, title }) => h('a', { href: `#${id}`, class: 'button small' }, title)));
  copyLink(byId('copy'), byId('live'), () => shown && writeAddress(addressOf(shown.listed, shown.live.state)));
  addEventListener('hashchange', () => void open());
  void open();
}

/** What a part of the program loads. */
function solver<T extends { readonly usable: boolean }>(
  part: (state: string) => Promise<{ load(): Promise<T> }>,
): () => Promise<T> {
  return renewed(async () => (await part(location.hash.slice(1))).load());
}

figurePage(document.body.dataset.only);
