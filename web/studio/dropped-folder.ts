/** Enough for any model, and an end to a disk that was dropped by mistake. */
const MAX_FILES = 1000;

/** The files of dropped folders, the folders in them too. Browsers give these by entries alone, a hundred at a time. */
export async function filesOf(entries: readonly (FileSystemEntry | null)[]): Promise<File[]> {
  const files: File[] = [];
  const waiting = entries.filter((entry) => entry !== null);
  for (let entry = waiting.shift(); entry && files.length < MAX_FILES; entry = waiting.shift()) {
    if (entry.isFile) files.push(await fileOf(entry as FileSystemFileEntry));
    else waiting.push(...(await membersOf((entry as FileSystemDirectoryEntry).createReader())));
  }
  return files;
}

const fileOf = (entry: FileSystemFileEntry) => new Promise<File>((resolve, reject) => entry.file(resolve, reject));

async function membersOf(reader: FileSystemDirectoryReader): Promise<FileSystemEntry[]> {
  const members: FileSystemEntry[] = [];
  const some = () => new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
  for (let next = await some(); next.length > 0 && members.length < MAX_FILES; next = await some()) members.push(...next);
  return members;
}
