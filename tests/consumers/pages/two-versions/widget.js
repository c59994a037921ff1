// @ts-nocheck: it is bundled as JavaScript, as a user would write it.
export { HandleBodyElement } from 'handlebody/element';
export { show } from './capsule.js';
