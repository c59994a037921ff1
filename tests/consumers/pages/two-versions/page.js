// @ts-nocheck: it is bundled as JavaScript, as a user would write it.
// A page with one version, and a widget on it that brings another one of its own.
import { HandleBodyElement } from 'handlebody/element';
import { show } from './capsule.js';
import { HandleBodyElement as OtherElement, show as showOther } from './widget/widget.js';

window.copies = new Set([HandleBodyElement, OtherElement]).size;
show(document.querySelector('main'));
showOther(document.querySelector('aside'));
