import type { Deformer } from './deformer.ts';
import type { Handle } from './experiment.ts';
import type { Method } from './methods.ts';
import type { Picture } from './picture.ts';

/** A small picture: of a method's answer, where to draw it, and who wants to know whether that was possible. */
export interface Tile {
  readonly method: Method;
  readonly context: CanvasRenderingContext2D;
  done(drawn: boolean): void;
}

/** Milliseconds of a frame that small pictures may take. */
const BUDGET = 10;

/** Draws as many as the budget allows. The large picture has to be drawn again after it, in the same task. */
export function drawTiles(picture: Picture, deformer: Deformer, handles: readonly Handle[], next: () => Tile | undefined): void {
  const now = picture.positions.slice();
  const until = performance.now() + BUDGET;
  picture.setWeight(undefined, 0, 0);
  picture.showLines(false);
  do {
    const tile = next();
    if (!tile) break;
    try {
      deformer.deform(tile.method, handles, picture.positions);
      picture.moved();
      picture.renderTile(tile.context);
      tile.done(true);
    } catch {
      // The method itself says why when it is chosen.
      tile.done(false);
    }
  } while (performance.now() < until);
  picture.positions.set(now);
  picture.moved();
}
