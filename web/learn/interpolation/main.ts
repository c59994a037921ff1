import { load } from '../../../wasm/ts/runtime.ts';
import { byId } from '../../ui/dom.ts';
import { explain } from '../../ui/explain.ts';
import { Page } from './page.ts';

try {
  new Page(await load());
  byId('playground').dataset.state = 'ready';
} catch (error) {
  const { message, remedy } = explain(error);
  byId('playground').dataset.state = 'failed';
  byId('trouble').hidden = false;
  byId('trouble').textContent = `${message} ${remedy}`;
}
