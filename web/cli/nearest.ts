/** How many of the known words are offered. */
const OFFERED = 3;

/** The known words that are most like one that is not known, the likest first. */
export function nearest(word: string, known: readonly string[]): string[] {
  const rated = known.map((name) => ({ name, edits: editsBetween(word.toLowerCase(), name.toLowerCase()) }));
  return rated
    .sort((a, b) => a.edits - b.edits)
    .slice(0, OFFERED)
    .map(({ name }) => name);
}

/** Letters to add, remove or replace (Levenshtein's distance). */
function editsBetween(a: string, b: string): number {
  let row = Array.from({ length: b.length + 1 }, (_, j) => j);
  for (let i = 1; i <= a.length; i++) {
    const above = row;
    row = [i];
    for (let j = 1; j <= b.length; j++) {
      const replaced = (above[j - 1] as number) + (a[i - 1] === b[j - 1] ? 0 : 1);
      row.push(Math.min(replaced, (above[j] as number) + 1, (row[j - 1] as number) + 1));
    }
  }
  return row[b.length] as number;
}
