import type { Told } from '../figures/kit/figure.ts';
import { Live } from '../figures/kit/live.ts';
import { FIGURES } from '../figures/list.ts';
import { registeredFigure } from '../figures/registry.ts';
import { h } from '../ui/dom.ts';
import { lazy } from '../ui/lazy.ts';
import { PageError } from '../ui/page-error.ts';
import { adopt } from './adopt.ts';
import { FIGURE_STYLES } from './figure-styles.generated.ts';
import { runtime, whole } from './runtime.ts';

interface FigureOptions {
  readonly state: string;
  readonly stage: HTMLElement;
  readonly signal: AbortSignal;
  readonly onFirst: () => void;
  readonly onChange: (state: string) => void;
}

export interface FigureShowing {
  state: string;
  readonly told: readonly Told[];
  see(seen: boolean): void;
  dispose(): void;
}

const parts = new Map(FIGURES.map(({ id, title, load }) => [id, lazy(load, `The figure “${title}”`)]));

/** A figure in an element's shadow, ready or failed: it says by itself what went wrong. Throws where there is no such figure, or none comes. */
export async function showFigure(name: string, options: FigureOptions): Promise<FigureShowing> {
  const { stage, signal, onChange } = options;
  const figure = registeredFigure(name) ?? (await parts.get(name)?.(undefined))?.default;
  if (!figure) {
    throw new PageError(
      'unknown-figure',
      name ? `There is no figure “${name}”.` : 'No figure is named.',
      `Give one of these as name: ${FIGURES.map(({ id }) => id).join(', ')}.`,
    );
  }
  signal.throwIfAborted();
  adopt(stage.getRootNode() as ShadowRoot, FIGURE_STYLES);
  let known = '';
  const change = (state: string) => {
    // What it begins with is no change.
    if (known && state !== known) onChange(state);
    known = state;
  };
  const live = new Live(figure, { solvers: { runtime, whole }, state: options.state, onChange: change });
  const frame = h('div', { class: 'figure-frame' }, live.element);
  stage.replaceChildren(frame);
  options.onFirst();
  await new Promise<void>((resolve) => {
    const watcher = new MutationObserver(() => live.element.dataset.state !== 'loading' && end());
    const end = () => {
      watcher.disconnect();
      resolve();
    };
    watcher.observe(live.element, { attributeFilter: ['data-state'] });
    signal.addEventListener('abort', end, { once: true });
  });
  return {
    get state() {
      return live.state;
    },
    set state(text) {
      live.state = text;
    },
    get told() {
      return live.told;
    },
    see: (seen) => live.sleep(!seen),
    dispose: () => {
      live.dispose();
      frame.remove();
    },
  };
}
