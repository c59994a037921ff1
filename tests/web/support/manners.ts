import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import type { Page } from 'playwright-core';

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

/** What axe finds. */
export async function violations(page: Page): Promise<string[]> {
  await page.evaluate(axe);
  return page.evaluate(async () => {
    const { run } = (globalThis as unknown as { axe: typeof import('axe-core') }).axe;
    return (await run()).violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.target.join(' ')).join(', ')}`);
  });
}

/** Controls smaller than 24 px or under something else, and whether the page is wider than its window. */
export async function cramped(page: Page): Promise<string[]> {
  return page.evaluate(() => {
    const controls = [
      ...document.querySelectorAll<HTMLElement>('button, input:not(.unseen), select, summary, a, label:has(input)'),
    ];
    const small = controls.filter((control) => {
      // A click on its label counts for a box to tick or a choice.
      const target = control.matches('[type=checkbox], [type=radio]') ? (control.closest('label') ?? control) : control;
      const { width, height } = target.getBoundingClientRect();
      return width > 0 && (width < 24 || height < 24);
    });
    const open = document.querySelector(':popover-open') ?? document;
    const [left, top] = [scrollX, scrollY];
    // What cannot be hit hides it all the same.
    const style = document.head.appendChild(document.createElement('style'));
    style.textContent = '* { pointer-events: auto !important }';
    const under = controls.filter((control) => {
      // Handles may lie over each other, and an outline of one's own is drawn over the picture.
      if (control.matches('.point, .handle, .own *, .shape-panel *') || !open.contains(control) || !control.checkVisibility())
        return false;
      control.scrollIntoView({ block: 'center', inline: 'center', behavior: 'instant' });
      const { x, y, width, height } = control.getBoundingClientRect();
      const hit = document.elementFromPoint(x + width / 2, y + height / 2);
      return hit !== null && !control.contains(hit) && !hit.contains(control) && hit.closest('label')?.control !== control;
    });
    style.remove();
    scrollTo({ left, top, behavior: 'instant' });
    const { scrollWidth, clientWidth } = document.documentElement;
    return [
      ...under.map((control) => `under something else: ${control.outerHTML.slice(0, 80)}`),
      ...small.map((control) => control.outerHTML.slice(0, 80)),
      ...(scrollWidth > clientWidth ? ['the page overflows sideways'] : []),
    ];
  });
}

/** What has the focus: how it is called, "body" for nothing. */
export async function focused(page: Page): Promise<string> {
  return page.evaluate(() => {
    const element = document.activeElement as HTMLElement;
    return element.ariaLabel ?? element.getAttribute('aria-label') ?? (element.closest('label') ?? element).innerText.trim();
  });
}
