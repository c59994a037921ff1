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
  /** It is there, and says by itself how far it is. */
  readonly onFirst: () => void;
  /** There is a picture. */
  readonly onPicture: () => void;
  readonly onChange: (state: string) => void;
  /** Of what the figure says in place. */
  readonly onError: (error: unknown) => void;
}

export interface FigureShowing {
  state: string;
  readonly told: readonly Told[];
  see(seen: boolean): void;
  dispose(): void;
}

const parts = new Map(FIGURES.map(({ id, title, load }) => [id, lazy(load, `The figure “${title}”`)]));

/**
 * A figure in an element's shadow, at rest, so that it has told its numbers, or failed: it says by itself what went wrong. Throws where there is
 * no such figure, or none comes.
 */
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
  let [known, isAsked] = ['', false];
  const change = (state: string) => {
    // What it begins with is no change; whoever asked for a state is told what came of it.
    if (known && (isAsked || state !== known)) onChange(state);
    [known, isAsked] = [state, false];
  };
  const live = new Live(figure, { solvers: { runtime, whole }, state: options.state, onChange: change, onError: options.onError });
  const frame = h('div', { class: 'figure-frame', 'data-coming': '' }, live.element);
  stage.replaceChildren(frame);
  options.onFirst();
  const until = (isSo: () => boolean) =>
    new Promise<void>((resolve) => {
      const watcher = new MutationObserver(() => isSo() && end());
      const end = () => {
        watcher.disconnect();
        resolve();
      };
      watcher.observe(live.element, { attributeFilter: ['data-state', 'data-rest'] });
      signal.addEventListener('abort', end, { once: true });
      if (isSo()) end();
    });
  await until(() => live.element.dataset.state !== 'loading');
  delete frame.dataset.coming;
  stage.style.minHeight = '';
  if (!signal.aborted) options.onPicture();
  await until(() => live.element.dataset.rest === 'yes' || live.element.dataset.state === 'failed');
  return {
    get state() {
      return live.state;
    },
    set state(text) {
      isAsked = true;
      live.state = text;
    },
    get told() {
      return live.told;
    },
    see: (seen) => live.sleep(!seen),
    dispose: () => {
      // What was above the window keeps its height when it is given back: the page does not jump.
      if (frame.isConnected) stage.style.minHeight = `${frame.offsetHeight}px`;
      live.dispose();
      frame.remove();
    },
  };
}
