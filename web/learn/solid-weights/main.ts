import { load } from '../../../wasm/ts/runtime.ts';
import { cameraTools, freeTheWheel } from '../../stage/camera-tools.ts';
import { View } from '../../stage/view.ts';
import { byId } from '../../ui/dom.ts';
import { Messages } from '../../ui/messages.ts';
import { Progress } from '../../ui/progress.ts';
import { Lesson } from './lesson.ts';

const viewport = byId('viewport');
const messages = new Messages(byId('messages'), () => viewport);
const progress = new Progress(byId('progress'));

try {
  freeTheWheel(viewport);
  const view = new View(byId<HTMLCanvasElement>('canvas'), viewport);
  viewport.after(cameraTools(view, viewport));
  const solver = load();
  solver.catch(() => {});
  new Lesson({ view, solver, messages, progress });
} catch (error) {
  byId('solid').dataset.state = 'failed';
  progress.end();
  messages.showInstead(error);
}
