import { writeAddress } from './address.ts';
import { PageError } from './page-error.ts';

/** Something did not come over the network: asking for it once more may help. */
export class NotFetched extends PageError {}

/** Milliseconds after which a choice that cannot be had goes back: at once, it would seem never to have been made. */
const SEEN = 400;

export async function notFetched(what: string): Promise<NotFetched> {
  await new Promise((resolve) => setTimeout(resolve, SEEN));
  return new NotFetched('not-fetched', `${what} could not be fetched.`, 'Check the connection, then try again.');
}

/**
 * A part of the program that is fetched when it is first asked for: `lazy(() => import('./part.ts'), 'The part')`. Throws NotFetched where it
 * does not come; it can be asked for again. Who asks says the state, as addresses write it, at which the page may be opened again for that;
 * nothing where the page is somebody else's.
 */
export function lazy<T>(load: () => Promise<T>, what: string): (state: string | undefined) => Promise<T> {
  let coming: Promise<T> | undefined;
  /** Where it did not come from. */
  let address: string | undefined;
  let tries = 0;
  const fetchPart = async (state: string | undefined): Promise<T> => {
    tries++;
    try {
      // Browsers keep a failed import: it is never fetched again from the same address.
      return address ? ((await import(/* @vite-ignore */ `${address}?try=${tries}`)) as T) : await load();
    } catch (cause) {
      if (address && state !== undefined && (await answers(address))) {
        // It is there, but something that it imports did not come, and is kept as failed: only another page asks for that again.
        writeAddress(state);
        location.reload();
        return new Promise(() => {});
      }
      // Browsers' messages say which address it was; Safari, whose does not, fetches again by itself.
      address = /https?:\/\/\S+\.[jt]s/.exec(String(cause))?.[0] ?? address;
      const error = await notFetched(what);
      coming = undefined;
      throw error;
    }
  };
  return (state) => {
    coming ??= fetchPart(state);
    return coming;
  };
}

async function answers(address: string): Promise<boolean> {
  try {
    return (await fetch(address, { method: 'HEAD' })).ok;
  } catch {
    return false;
  }
}
