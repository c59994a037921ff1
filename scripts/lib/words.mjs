// What must not be written anywhere: paths that exist on one machine only.
const MACHINE_PATH = /(?<![\w.~/-])(?:\/(?:work|home|root|Users|mnt)\/[\w.-]+|[A-Za-z]:\\Users\\\w+)/g;

/** @param {string} text @returns {{ line: number, word: string }[]} */
export function findMachinePaths(text) {
  return text
    .split('\n')
    .flatMap((row, index) => [...row.matchAll(MACHINE_PATH)].map((match) => ({ line: index + 1, word: match[0] })));
}
