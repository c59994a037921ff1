const NAMES: Readonly<Record<string, string>> = { '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' };

/** A text as HTML has it, in an attribute's double quotes too. */
export function escapeHtml(text: string): string {
  return text.replace(/[&<>"]/g, (letter) => NAMES[letter] as string);
}
