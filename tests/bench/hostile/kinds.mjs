/**
 * The worst inputs that are known for each reader, at any size: what once took quadratic time or more memory than its bytes justify, and
 * what looks as if it might. `make` gives about so many bytes; a growth of ten times the bytes is what is measured.
 */
import { SCENES } from './scenes.mjs';
import { TEXTS } from './texts.mjs';

/** @type {Record<string, import('./make.mjs').Kind>} */
export const KINDS = { ...TEXTS, ...SCENES };
