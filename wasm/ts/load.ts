import type { Exports, RuntimeExports } from './abi.generated.ts';
import { optional, options, type Read, type Reader, type Readers, refused, signal } from './arguments.ts';
import { HandlebodyError, throwIfAborted } from './errors.ts';
import { Heap } from './heap.ts';
import { HostKernels } from './host-kernels.ts';

const ABI_VERSION = 7;

export interface LoadOptions {
  /** The wasm to use instead of the one inside: compiled, as bytes, or where to fetch it. */
  readonly wasm?: WebAssembly.Module | BufferSource | URL;
  readonly signal?: AbortSignal;
}

const source: Reader<WebAssembly.Module | BufferSource | URL> = (value, name) => {
  if (value instanceof URL || value instanceof ArrayBuffer || ArrayBuffer.isView(value)) return value as URL | BufferSource;
  if (typeof WebAssembly !== 'object' || value instanceof WebAssembly.Module) return value as WebAssembly.Module;
  throw refused(name, value, 'Give a URL, as by new URL(file, import.meta.url), or the bytes of the file, or its module.');
};

const READERS = { wasm: optional(source), signal: optional(signal) } satisfies Readers<LoadOptions>;

/** How every `load` reads its options. */
export function readLoadOptions(given: LoadOptions): Read<typeof READERS> {
  return options(given, READERS);
}

/** The two links of the solver by their files, and what each exports. */
export interface Links {
  readonly 'handlebody.wasm': Exports;
  readonly 'handlebody.runtime.wasm': RuntimeExports;
}

export type Link = keyof Links;

/** Instantiates one of the two links from a module, bytes or a URL. Every entry ends here. */
export async function instantiate<L extends Link>(
  link: L,
  from: WebAssembly.Module | BufferSource | URL,
  signal?: AbortSignal,
): Promise<Heap<Links[L]>> {
  throwIfAborted(signal);
  checkWebAssembly();
  let exports: Links[L];
  const kernels = new HostKernels();
  try {
    const bytes = from instanceof URL ? await fetchBytes(from, signal) : from;
    const module = bytes instanceof WebAssembly.Module ? bytes : await WebAssembly.compile(bytes);
    const instance = await WebAssembly.instantiate(module, imports(module, kernels));
    exports = instance.exports as unknown as Links[L];
    (instance.exports._initialize as (() => void) | undefined)?.();
  } catch (cause) {
    if (cause instanceof HandlebodyError) throw cause;
    throwIfAborted(signal);
    throw new HandlebodyError('wasm-unavailable', {
      message: `The solver's wasm could not be started: ${cause instanceof Error ? cause.message : String(cause)}`,
      remedy:
        "Use a current browser; a content security policy needs 'wasm-unsafe-eval'. Check that the file is this version's own.",
      cause,
    });
  }
  throwIfAborted(signal);
  checkLink(link, exports);
  return new Heap(exports, kernels);
}

/** Says so where there is no WebAssembly at all. */
export function checkWebAssembly(): void {
  if (typeof WebAssembly === 'object') return;
  throw new HandlebodyError('wasm-unavailable', {
    message: 'This browser does not offer WebAssembly, which the solver needs.',
    remedy: 'Use a current browser, and allow WebAssembly if a setting or a security policy blocks it.',
  });
}

/** Refuses a module that is something else, another release, or the other link, before an object calls what is not there. */
function checkLink(link: Link, exports: Partial<Exports>): void {
  const refused = (message: string, remedy: string) => new HandlebodyError('wasm-unavailable', { message, remedy });
  const serve = `Serve the ${link} of the same release as the library`;
  const version = exports.hb_abi_version?.();
  if (version === undefined) throw refused('The wasm file is not one of this library.', `${serve}.`);
  if (version !== ABI_VERSION)
    throw refused(`The wasm file speaks interface version ${version}, this library ${ABI_VERSION}.`, `${serve}.`);
  const whole = exports.hb_bake_begin !== undefined;
  if (whole && link === 'handlebody.runtime.wasm')
    throw refused('The wasm file is handlebody.wasm, the whole solver.', `${serve}, or import load from "handlebody".`);
  if (!whole && link === 'handlebody.wasm') {
    throw refused(
      'The wasm file is handlebody.runtime.wasm, which neither bakes nor computes weights.',
      `${serve}, or import load from "handlebody/runtime".`,
    );
  }
}

/** The module imports kernels from its host; every other import answers "not supported" (errno 52). */
function imports(module: WebAssembly.Module, kernels: HostKernels): WebAssembly.Imports {
  const answers: Record<string, Record<string, (...args: number[]) => number>> = {};
  for (const { module: space, name } of WebAssembly.Module.imports(module)) {
    answers[space] ??= {};
    answers[space][name] = name === 'emscripten_notify_memory_growth' ? () => 0 : () => 52;
  }
  answers.env = { ...answers.env, hb_host_kernel: kernels.call as (...args: number[]) => number };
  return answers;
}

async function fetchBytes(url: URL, signal: AbortSignal | undefined): Promise<BufferSource> {
  const files = url.protocol === 'file:' && fileSystem();
  if (files) return new Uint8Array(await files.readFile(url));
  const response = await fetch(url, signal ? { signal } : {});
  if (!response.ok) throw new Error(`${url.href} answered ${response.status}`);
  return response.arrayBuffer();
}

interface FileSystem {
  readFile(file: URL): Promise<Uint8Array>;
}

/** Node's, which fetches no files; asked for by name at run time, since bundlers for browsers would look for what is imported. */
function fileSystem(): FileSystem | undefined {
  const { process } = globalThis as { process?: { getBuiltinModule?(name: string): FileSystem } };
  return process?.getBuiltinModule?.('node:fs/promises');
}
