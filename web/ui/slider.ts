import { steerable } from './drag.ts';

/** Gives a slider the keys of handles: arrows a step, Shift a fifth of it, Page ten; Esc goes back. It tells by its `input` event, as ever. */
export function steerSlider(slider: HTMLInputElement, step: number): void {
  slider.step = String(step / 5);
  const set = (value: number) => {
    slider.valueAsNumber = value;
    slider.dispatchEvent(new Event('input', { bubbles: true }));
  };
  steerable(slider, {
    hold: () => {
      const before = slider.valueAsNumber;
      return () => set(before);
    },
    nudge: (across, up, toward) => set(slider.valueAsNumber + (across + up + toward) * step),
  });
}
