/**
 * A live figure as a widget of notebooks: Jupyter, marimo, MyST and whatever else shows anywidgets (https://anywidget.dev).
 *
 * ```python
 * import anywidget, traitlets
 *
 * class Figure(anywidget.AnyWidget):
 *     _esm = "https://your.host/handlebody.anywidget.js"  # or pathlib.Path("handlebody.anywidget.js")
 *     name = traitlets.Unicode("course-12").tag(sync=True)
 *     state = traitlets.Unicode("").tag(sync=True)        # both ways
 *     caption = traitlets.Bool(True).tag(sync=True)
 *     controls = traitlets.Bool(True).tag(sync=True)
 *     told = traitlets.List([]).tag(sync=True)            # from the figure: [name, number or text]
 * ```
 *
 * A widget's script is loaded from an address or as a text that can import nothing beside it: dist/handlebody.anywidget.js is this module and all
 * that it needs in one file.
 */
import './index.ts';

/** What of anywidget's model is used: the traits, of which a class may have fewer. */
export interface FigureModel {
  get(trait: string): unknown;
  set(trait: string, value: unknown): void;
  save_changes(): void;
  on(event: string, listener: () => void): void;
  off(event: string, listener: () => void): void;
}

function render({ model, el }: { readonly model: FigureModel; readonly el: HTMLElement }): () => void {
  const figure = document.createElement('handle-figure');
  /** The model's state that is the figure's: any other is somebody's wish. */
  let known: unknown;
  const state = () => {
    const text = model.get('state');
    if (typeof text === 'string' && text !== known && text !== figure.state) figure.state = text;
  };
  const name = () => {
    figure.name = String(model.get('name') ?? '');
    // One that came with the name is meant for it; that of the former figure is not.
    state();
  };
  const shown = (trait: string) => () => {
    figure.toggleAttribute(trait, model.get(trait) !== false);
  };
  const listeners = Object.entries({ name, state, caption: shown('caption'), controls: shown('controls') });
  const tell = () => {
    known = figure.state;
    model.set('state', known);
    model.set('told', figure.told);
    model.save_changes();
  };
  for (const [trait, listener] of listeners) {
    listener();
    model.on(`change:${trait}`, listener);
  }
  for (const event of ['load', 'change']) figure.addEventListener(event, tell);
  el.append(figure);
  return () => {
    for (const [trait, listener] of listeners) model.off(`change:${trait}`, listener);
    figure.remove();
  };
}

export default { render };
