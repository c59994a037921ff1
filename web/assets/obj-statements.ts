import { lineError, type TextSource, textLines } from './text-lines.ts';

/** A statement is taken apart as a whole: real ones have some hundred letters. */
const MAX_STATEMENT = 1 << 20;

/** The statements of an OBJ, without comments and blank lines; a backslash at a line's end joins the next one. `line` is where each begins. */
export function* statements(source: TextSource): Generator<{ text: string; line: number }> {
  let [joined, first] = ['', 0];
  for (const { text, number } of textLines(source.bytes)) {
    const comment = text.indexOf('#');
    const code = (comment === -1 ? text : text.slice(0, comment)).trim();
    if (joined === '') first = number;
    const goesOn = code.endsWith('\\');
    if (goesOn) joined += `${code.slice(0, -1)} `;
    if (joined.length + code.length > MAX_STATEMENT)
      throw lineError(source, first, { format: 'OBJ', what: 'says more than 1 MiB' });
    if (goesOn) continue;
    const statement = joined === '' ? code : (joined + code).trim();
    joined = '';
    if (statement !== '') yield { text: statement, line: first };
  }
  if (joined.trim() !== '') yield { text: joined.trim(), line: first };
}
