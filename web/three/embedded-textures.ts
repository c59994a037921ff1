import { Loader, type Texture } from 'three';
import type { GLTFLoader, GLTFLoaderPlugin, GLTFParser } from 'three/addons/loaders/GLTFLoader.js';
import { refused } from '../../wasm/ts/arguments.ts';

/** How a texture names its image besides its own `source`. */
const EXTENSIONS = ['EXT_texture_webp', 'EXT_texture_avif'];

/**
 * Has a loader decode the images inside a GLB from their bytes. By itself GLTFLoader fetches each under a `blob:` address, which a strict content
 * security policy stops (`connect-src`), and the model comes without its textures. Images in files of their own are loaded as before.
 *
 * ```ts
 * const loader = embeddedTextures(new GLTFLoader()).register(handlebodyPlugin);
 * ```
 */
export function embeddedTextures(loader: GLTFLoader): GLTFLoader {
  if (typeof (loader as GLTFLoader | null)?.register !== 'function') throw refused('loader', loader, 'Give a GLTFLoader.');
  // A plugin of an extension's name takes the place of the loader's own.
  for (const extension of [undefined, ...EXTENSIONS]) loader.register((parser) => pluginFor(parser, extension));
  return loader;
}

interface TextureJson {
  readonly source?: number;
  readonly extensions?: Readonly<Record<string, { readonly source?: number }>>;
}

interface EmbeddedJson {
  readonly bufferView: number;
  readonly mimeType?: string;
}

function pluginFor(parser: GLTFParser, extension: string | undefined): GLTFLoaderPlugin {
  return {
    name: extension ?? 'embedded-textures',
    loadTexture(index): Promise<Texture> | null {
      const texture: TextureJson = parser.json.textures[index];
      const source = (extension ? texture.extensions?.[extension] : texture)?.source;
      const image = source === undefined ? undefined : parser.json.images?.[source];
      if (source === undefined || !image) return null;
      // Where three.js makes no bitmaps, the browser gets them wrong.
      const isEmbedded = image.bufferView !== undefined && 'isImageBitmapLoader' in parser.textureLoader;
      if (isEmbedded) return parser.loadTextureImage(index, source, new EmbeddedImage(parser, image));
      return extension ? parser.loadTextureImage(index, source, parser.textureLoader) : null;
    },
  };
}

/** A loader of one image, whatever its address. */
class EmbeddedImage extends Loader<ImageBitmap> {
  /** GLTFLoader makes a texture of what such a one gives. */
  readonly isImageBitmapLoader = true;
  readonly #parser: GLTFParser;
  readonly #image: EmbeddedJson;

  constructor(parser: GLTFParser, image: EmbeddedJson) {
    super(parser.options.manager);
    [this.#parser, this.#image] = [parser, image];
  }

  override load(_: string, onLoad: (bitmap: ImageBitmap) => void, __?: unknown, onError?: (error: unknown) => void): void {
    this.#decode().then(onLoad, onError);
  }

  async #decode(): Promise<ImageBitmap> {
    const bytes: ArrayBuffer = await this.#parser.getDependency('bufferView', this.#image.bufferView);
    const file = new Blob([bytes], { type: this.#image.mimeType ?? '' });
    return createImageBitmap(file, { premultiplyAlpha: 'none', colorSpaceConversion: 'none' });
  }
}
