const PERCENT = 0x25;

/** What a data URI carries. */
interface DataUri {
  readonly mimeType: string;
  readonly bytes: Uint8Array<ArrayBuffer>;
}

/** Whether a URI carries its data itself. The scheme may be in any letters (RFC 3986, 3.1). */
export function isDataUri(uri: string): boolean {
  return /^data:/i.test(uri);
}

/** Takes a data URI apart (RFC 2397): base64, or text with percent signs. Throws a plain Error where it is none, or is damaged. */
export function decodeDataUri(uri: string): DataUri {
  const comma = uri.indexOf(',');
  if (comma === -1) throw new Error('a data URI without a comma');
  const [mimeType = '', ...parameters] = uri.slice('data:'.length, comma).split(';');
  const payload = uri.slice(comma + 1);
  const isBase64 = parameters.some((parameter) => /^\s*base64\s*$/i.test(parameter));
  return { mimeType: mimeType.trim().toLowerCase(), bytes: isBase64 ? fromBase64(payload) : fromPercents(payload) };
}

function fromBase64(payload: string): Uint8Array<ArrayBuffer> {
  // Percent signs may stand for "+", "/" and "=", and some writers use the letters of URLs.
  const text = (payload.includes('%') ? decodeURIComponent(payload) : payload).replace(/-/g, '+').replace(/_/g, '/');
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

function fromPercents(payload: string): Uint8Array<ArrayBuffer> {
  const text = new TextEncoder().encode(payload);
  const out = new Uint8Array(text.length);
  let length = 0;
  for (let i = 0; i < text.length; i++) {
    const digits = text[i] === PERCENT ? String.fromCharCode(...text.subarray(i + 1, i + 3)) : '';
    const escaped = /^[\da-f]{2}$/i.test(digits);
    out[length++] = escaped ? Number.parseInt(digits, 16) : (text[i] as number);
    if (escaped) i += 2;
  }
  return out.slice(0, length);
}
