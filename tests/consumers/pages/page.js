// @ts-nocheck: it is bundled as JavaScript, as a user would write it.
import { show } from './capsule.js';

show(document.querySelector('main'));
