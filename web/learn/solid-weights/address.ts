import { decoded, pairsOf, quoted } from '../../ui/address.ts';
import { BLENDS, type Blend } from './panel.ts';
import { SOLIDS, type Solid } from './solids.ts';
import { METHODS, type Method } from './weights.ts';

/* The address says what the page shows: "#dog", or "#solid=dog&m=bounded&blend=rigid" where something else than at first is chosen. */

export interface State {
  readonly solid: Solid['id'];
  readonly method: Method;
  readonly blend: Blend;
}

/** Without the "#". */
export function toAddress({ solid, method, blend }: State): string {
  const first = initial(solid);
  const changed = [...(method === first.method ? [] : [`m=${method}`]), ...(blend === first.blend ? [] : [`blend=${blend}`])];
  return changed.length === 0 ? solid : [`solid=${solid}`, ...changed].join('&');
}

/** The bar where it says nothing that can be read. What had to be left out goes to `left`. */
export function fromAddress(hash: string, left: string[] = []): State {
  const text = decoded(hash);
  const alone = SOLIDS.find(({ id }) => id === text);
  if (alone) return initial(alone.id);
  const given = pairsOf(text, ['solid', 'm', 'blend'], left);
  const take = <T>(key: string, entries: readonly { readonly id: T }[]): T | undefined => {
    const value = given.get(key);
    const found = entries.find(({ id }) => id === value)?.id;
    if (value !== undefined && found === undefined) left.push(quoted(`${key}=${value}`));
    return found;
  };
  const first = initial(take('solid', SOLIDS) ?? 'bar');
  return { ...first, method: take('m', METHODS) ?? first.method, blend: take('blend', BLENDS) ?? first.blend };
}

function initial(solid: Solid['id']): State {
  return { solid, method: 'biharmonic', blend: 'linear' };
}
