import { type Handlebody, load } from '../../../wasm/ts/index.ts';

/** A solver, and how many blocks and objects are out that it handed out. */
export async function counted(): Promise<{ hb: Handlebody; blocks: () => number; objects: () => number }> {
  const { instantiate } = WebAssembly;
  const count = { blocks: 0, objects: 0 };
  WebAssembly.instantiate = (async (module: WebAssembly.Module, imports: WebAssembly.Imports) => {
    const { exports } = await instantiate(module, imports);
    const wrapped = Object.entries(exports).map(([name, value]) => {
      const kind = name === 'hb_alloc' ? 1 : name === 'hb_release' ? -1 : 0;
      const object = /_(create|begin|share)$/.test(name) && !/bound_begin$/.test(name) ? 1 : /_free$/.test(name) ? -1 : 0;
      if (kind === 0 && object === 0) return [name, value];
      return [
        name,
        (...all: number[]) => {
          const got = (value as (...all: number[]) => number)(...all);
          count.blocks += kind;
          // What is refused makes nothing.
          if (object === -1 || (object === 1 && got === 0)) count.objects += object;
          return got;
        },
      ];
    });
    return { exports: Object.fromEntries(wrapped) };
  }) as typeof instantiate;
  const hb = await load().finally(() => {
    WebAssembly.instantiate = instantiate;
  });
  return { hb, blocks: () => count.blocks, objects: () => count.objects };
}
