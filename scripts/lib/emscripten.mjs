// Where Emscripten finds what it needs, whoever installed it.
import { accessSync, constants } from 'node:fs';
import path from 'node:path';
import { at } from './paths.mjs';
import { capture } from './run.mjs';

/** Emscripten's surroundings: this Node, Debian's acorn, and a library cache that can be written where one has to be filled. */
export function emscriptenEnvironment() {
  /** @type {NodeJS.ProcessEnv} */
  const env = { ...process.env, EM_NODE_JS: process.execPath };
  env.NODE_PATH = [process.env.NODE_PATH, '/usr/share/nodejs'].filter(Boolean).join(path.delimiter);
  const setting = (/** @type {string} */ name) => capture('em-config', [name], { env }).stdout.trim();
  if (env.EM_CACHE || setting('FROZEN_CACHE') === 'True') return env;
  try {
    accessSync(setting('CACHE'), constants.W_OK);
  } catch {
    env.EM_CACHE = at('.cache', 'emscripten');
  }
  return env;
}
