import { PageError } from '../ui/page-error.ts';

/** The error about a property, or a part of one, that a program set to what it cannot be. */
export function wrongProperty(name: string, value: unknown, wanted: string): PageError {
  const told = value && typeof value === 'object' ? 'an object' : String(value).slice(0, 40);
  return new PageError('invalid-option', `The property ${name} is ${told}.`, `Give ${wanted}.`);
}

/** Whether it is a place of three numbers. */
export const isPlace = (value: unknown): boolean => Array.isArray(value) && value.length === 3 && value.every(Number.isFinite);
