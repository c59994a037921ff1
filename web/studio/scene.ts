import type { Object3D } from 'three';
import type { HandlebodyRuntime } from '../../wasm/ts/runtime.ts';

/** What the view can show and the panel can steer: a body with handles, or a face in a pose space. */
export interface StudioScene {
  readonly kind: 'body' | 'pose';
  readonly object: Object3D;
  /** Whether it stands on the ground and casts a shadow there. */
  readonly grounded: boolean;
  readonly panel: HTMLElement;
  /** After a frame was drawn: what lies over the picture follows the camera. */
  drawn(): void;
  /** Back to rest, eased unless motion is unwanted. */
  reset(): void;
  /** As it was, by another solver: the one that it had has ended. */
  renew(solver: HandlebodyRuntime): void;
  dispose(): void;
}
