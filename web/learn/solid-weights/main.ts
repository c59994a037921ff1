import { load } from '../../../wasm/ts/runtime.ts';
import { cameraTools } from '../../stage/camera-tools.ts';
import { View } from '../../stage/view.ts';
import { byId, h } from '../../ui/dom.ts';
import { Messages } from '../../ui/messages.ts';
import { Note } from '../../ui/note.ts';
import { Progress } from '../../ui/progress.ts';
import { Lesson } from './lesson.ts';

const viewport = byId('viewport');
const messages = new Messages(byId('messages'), () => viewport);
const progress = new Progress(byId('progress'));

try {
  const view = new View(byId<HTMLCanvasElement>('canvas'), viewport);
  const note = h('p', { class: 'note', id: 'note', role: 'status', hidden: true });
  viewport.after(cameraTools(view, viewport), note);
  const line = new Note(note);
  view.onInterrupted = (words) => line.show(words);
  const solver = load();
  solver.catch(() => {});
  new Lesson({ view, solver, messages, progress });
} catch (error) {
  byId('solid').dataset.state = 'failed';
  progress.end();
  messages.showInstead(error);
}
