/** Says a line in an element over a view; without words it goes. */
export function noteIn(element: HTMLElement): (words: string) => void {
  return (words) => {
    element.textContent = words;
    element.hidden = words === '';
  };
}
