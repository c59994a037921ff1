import { Live, type Solvers } from '../../figures/kit/live.ts';
import { FIGURES, type Listed } from '../../figures/list.ts';
import { copyLink } from '../../ui/copy-link.ts';
import { byId, h } from '../../ui/dom.ts';

const solvers = once();
let shown: { readonly listed: Listed; readonly live: { state: string; dispose(): void } } | undefined;

byId('figures').append(...FIGURES.map(({ id, title }) => h('a', { href: `#${id}`, class: 'button small' }, title)));
copyLink(byId('copy'), byId('live'), () => shown && write(`#${shown.listed.id}&${shown.live.state}`, false));
addEventListener('hashchange', () => void open());
void open();

/** The address names a figure, and after it the figure's state: "#course-12&v1&fig-12". */
async function open(): Promise<void> {
  const [id = '', ...rest] = location.hash.slice(1).split('&');
  const listed = FIGURES.find((figure) => figure.id === id) ?? FIGURES[0];
  const state = rest.join('&');
  if (!listed) return;
  if (shown?.listed === listed) {
    shown.live.state = state;
    return;
  }
  const figure = await listed.load();
  shown?.live.dispose();
  const live = new Live(figure, { solvers, state, onChange: (text, preset) => write(`#${listed.id}&${text}`, preset) });
  shown = { listed, live };
  byId('figure').replaceChildren(live.element);
}

function write(hash: string, step: boolean): void {
  if (hash === location.hash) return;
  if (step) history.pushState(null, '', hash);
  else history.replaceState(null, '', hash);
}

/** Each link of the solver once a page. */
function once(): Solvers {
  let [runtime, whole]: [ReturnType<Solvers['runtime']> | undefined, ReturnType<Solvers['whole']> | undefined] = [
    undefined,
    undefined,
  ];
  return {
    runtime: () => (runtime ??= import('../../../wasm/ts/runtime.ts').then(({ load }) => load())),
    whole: () => (whole ??= import('../../../wasm/ts/index.ts').then(({ load }) => load())),
  };
}
