import { byId } from '../ui/dom.ts';

/** Files come by the button or by being dropped anywhere on the page. */
export function listenForFiles(take: (files: readonly File[]) => void): void {
  const input = byId<HTMLInputElement>('file');
  byId('open').addEventListener('click', () => input.click());
  input.addEventListener('change', () => {
    const files = [...(input.files ?? [])];
    // The same file may be chosen again.
    input.value = '';
    if (files.length > 0) take(files);
  });

  const veil = byId('drop-veil');
  const carriesFiles = (event: DragEvent) => event.dataTransfer?.types.includes('Files') ?? false;
  addEventListener('dragover', (event) => {
    if (!carriesFiles(event)) return;
    event.preventDefault();
    veil.hidden = false;
  });
  addEventListener('dragleave', (event) => {
    if (!event.relatedTarget) veil.hidden = true;
  });
  addEventListener('drop', (event) => {
    if (!carriesFiles(event)) return;
    event.preventDefault();
    veil.hidden = true;
    const { items, files } = event.dataTransfer as DataTransfer;
    // Both are gone once the event is over.
    const [entries, given] = [[...items].map((item) => item.webkitGetAsEntry()), [...files]];
    if (entries.some((entry) => entry?.isDirectory)) {
      void import('./dropped-folder.ts').then(({ filesOf }) => filesOf(entries)).then(take, () => take(given));
    } else if (given.length > 0) take(given);
  });
}
