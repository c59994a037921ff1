import { load } from '../../wasm/ts/runtime.ts';
import { cameraTools } from '../stage/camera-tools.ts';
import { View } from '../stage/view.ts';
import { byId } from '../ui/dom.ts';
import { Messages } from '../ui/messages.ts';
import { noteIn } from '../ui/note.ts';
import { Progress } from '../ui/progress.ts';
import { renewed } from '../ui/solver-end.ts';
import { Address } from './address.ts';
import { listenForFiles } from './drop.ts';
import { ModelSwitch } from './model-switch.ts';
import { Studio } from './studio.ts';

byId('unfetched').remove();
const viewport = byId('viewport');
const messages = new Messages(byId('messages'), () => viewport);
const progress = new Progress(byId('progress'));
const note = noteIn(byId('note'));

function start(): void {
  const view = new View(byId<HTMLCanvasElement>('canvas'), viewport);
  viewport.after(cameraTools(view, viewport));
  view.onInterrupted = (words) => note(words);
  // Asked for now, awaited when a model is there: both come at the same time.
  const solver = renewed(load);
  solver().catch(() => {});
  const address = new Address();
  const studio = new Studio({ view, solver, messages, progress, note, address });
  const models = new ModelSwitch(address, (id) => void studio.choose(id));
  studio.modelSwitch = models;
  listenForFiles((files) => void studio.open(files));
  models.show(models.fromAddress());
  void studio.choose(models.fromAddress());
}

try {
  start();
} catch (error) {
  byId('studio').dataset.state = 'failed';
  progress.end();
  messages.showInstead(error);
}
