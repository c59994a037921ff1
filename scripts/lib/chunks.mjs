// Which modules make a chunk in both builds of pages, the site's and the elements': small ones apart compress worse than together.

/** In a chunk of its own: cached over our releases, and told apart by the size budget. */
export const THREE = { name: 'three', test: /[\\/]node_modules[\\/]three[\\/]/ };

/** What makes three.js objects and the solver's arrays of a file. */
export const MODEL = {
  name: 'load-model',
  test: /web[\\/](three[\\/](decode|load-model|loader|object-part|plain-object|read-object)|assets[\\/](body-codec|fault|verify-(gltf|nodes)|concatenate|glb-chunks|gltf-json|open-gltf|predict-distances|schema|transform|voxel-runs))\./,
};

/** What a 3D view consists of. */
export const VIEW = { name: 'view', test: /web[\\/](stage[\\/]|three[\\/]handles\.)/ };

/** What nearly every page needs, and with it what reading models and the solver have alike: neither brings the other along. What
 * imports lazily wants Vite's helper for it: in the chunk of some other part it would bring that to every page. */
export const PAGE = {
  name: 'page',
  test: /web[\\/]ui[\\/](dom|drag|explain|messages|motion|note|page-error|progress|put-handle|screen)\.|wasm[\\/]ts[\\/](arguments|bound|copied|errors|hash|origin)\.|vite[\\/]preload-helper/,
};

/** For pages with elements, whose runtime is told apart by the size budget. */
export const GROUND = { name: 'ground', test: /wasm[\\/]ts[\\/](arguments|bound|copied|errors|hash|origin)\./ };

/** The same for pages with elements, and with it what those are until they show something. */
export const ELEMENT = { name: 'element', test: new RegExp(`${PAGE.test.source}|web[\\\\/]element[\\\\/]index\\.`) };
