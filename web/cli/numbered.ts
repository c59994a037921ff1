/** Things of a file that have a name, or share one, or have none, but always a number. */
interface Numbered {
  readonly name: string;
  /** From 0, in the order of the file. */
  readonly number: number;
}

/** Those that a word means: a whole number is a number, "name:2" those called 2, and all else is a name. */
export function chooseByName<T extends Numbered>(things: readonly T[], word: string): T[] {
  if (/^\d+$/.test(word)) return things.filter(({ number }) => number === Number(word));
  return things.filter(({ name }) => name === word.replace(/^name:/, '') || name === word);
}
