import { statSync } from 'node:fs';

/** Whether an output's name means standard output. What else is said goes to standard error then. */
export function isStandardOutput(name: unknown): boolean {
  return name === '-' || name === '/dev/stdout' || name === '/dev/fd/1' || name === '/proc/self/fd/1';
}

/** Whether an input's name means standard input. */
export function isStandardInput(name: string): boolean {
  return name === '-' || name === '/dev/stdin' || name === '/dev/fd/0' || name === '/proc/self/fd/0';
}

/** Whether a name is that of something that is there and no file: a device, a pipe, a folder. */
export function isSpecial(name: string): boolean {
  const there = statSync(name, { throwIfNoEntry: false });
  return there !== undefined && !there.isFile();
}
