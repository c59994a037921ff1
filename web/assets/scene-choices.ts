/** What can be chosen when a scene is read, and what is said about it; the same for glTF-Transform's documents and three.js' objects. */
import { callback, named, object, optional, type Readers } from '../../wasm/ts/arguments.ts';
import type { MeshReading } from '../../wasm/ts/types.ts';

/** What a scene's reader warns of. */
export interface SceneWarning {
  readonly code: SceneWarningCode;
  /** What is not as it may seem. */
  readonly message: string;
  /** What can be done. */
  readonly remedy: string;
}

/**
 * - `morphs-at-rest`: morph targets have weights, and the shape without them was read.
 * - `skin-posed`: a skeleton stands in a pose, and the skin was read in its rest shape.
 * - `left-out`: something is drawn that is no surface, or whose vertices only the graphics card knows, relief of a displacement map among it.
 * - `positions-coarse`: so far from the origin that the stored floats have lost the shape; or a part so far from the rest that the joined ones have.
 */
export type SceneWarningCode = 'morphs-at-rest' | 'skin-posed' | 'left-out' | 'positions-coarse';

/** How a scene is read. */
export interface SceneChoices {
  /**
   * 'rest', the default: without what the morph targets add, whatever their weights. 'present': as they are shown now. The weights are kept
   * with the mesh, and in a body; what is written back leaves out what they add, so that it is shown once.
   */
  readonly morphs?: 'rest' | 'present' | undefined;
  /** 'skip', the default: only what is visible. 'take': hidden parts as well. What was skipped is kept with the mesh, and in a body. */
  readonly hidden?: 'skip' | 'take' | undefined;
  /** How it was read before, for the same vertices in the same order: `body.mesh.reading`. The choices above do not count then. */
  readonly reading?: MeshReading | undefined;
  /** Called for each thing that is not as it may seem. */
  readonly onWarning?: ((warning: SceneWarning) => void) | undefined;
}

export const SCENE_READERS = {
  morphs: optional(named(['rest', 'present'])),
  hidden: optional(named(['skip', 'take'])),
  // Its contents are checked where they are used.
  reading: optional((value, name) => object(value, name, 'Give body.mesh.reading.')),
  onWarning: optional(callback),
} satisfies Readers<SceneChoices>;
