import { looksLikeGltf } from './open-unusual.ts';
import { isExact } from './read-stl.ts';
import { textSource } from './text-source.ts';

/** Formats of models that are read. What is none of them is left to the reader of GLB files, which says what it looks like. */
export type FileFormat = 'GLB' | 'glTF' | 'OBJ' | 'PLY' | 'STL' | 'OFF';

/** How much of a text is looked at. */
const HEAD = 1 << 12;

/** By what is in a file; by its name where that says nothing. */
export function fileFormat(bytes: Uint8Array, name: string): FileFormat {
  if (String.fromCharCode(...bytes.subarray(0, 4)) === 'glTF') return 'GLB';
  const found = formatOfText(new TextDecoder().decode(textSource(bytes.subarray(0, HEAD)).bytes));
  if (found === 'PLY') return found;
  // What has exactly the length of a binary STL may begin with any other word.
  if (isExact(bytes)) return 'STL';
  if (looksLikeGltf(bytes)) return 'glTF';
  const ending = /\.(gltf|obj|ply|stl|off)$/i.exec(name)?.[1]?.toUpperCase() as FileFormat | 'GLTF' | undefined;
  return found ?? (ending === 'GLTF' ? 'glTF' : ending) ?? 'GLB';
}

/** Three formats have a mark. An OBJ has none: before its first vertex come words that it knows. */
function formatOfText(head: string): FileFormat | undefined {
  const lines = head.split(/\r\n|\n|\r/).map((line) => line.replace(/#.*/, '').trim());
  const said = lines.filter((line) => line !== '');
  const [first = ''] = said;
  if (first === 'ply') return 'PLY';
  if (/^((ST|C|N|4|n)*OFF|off)(\d|\s|$)/.test(first)) return 'OFF';
  if (/^(solid\b|facet\s+normal\b)/i.test(first) && /\bfacet\b/i.test(head)) return 'STL';
  const other = said.find((line) => !/^(mtllib|usemtl|o|g|s|vn|vt)(\s|$)/.test(line)) ?? '';
  return /^v(\s+[-+]?[.\d]\S*){3}/.test(other) ? 'OBJ' : undefined;
}
