/** The models that the studio offers, and where their ready-made handles sit. */

interface HandleSpot {
  readonly name: string;
  /** Number of the vertex in the baked body. */
  readonly vertex: number;
}

export interface ModelEntry {
  readonly id: string;
  readonly label: string;
  /** File in public/models. */
  readonly file: string;
  /** Where the camera looks from: azimuth and height, in degrees; azimuth 0 is +z, 90 is +x. */
  readonly view: { readonly azimuth: number; readonly elevation: number };
  readonly invitation: string;
  readonly handles: readonly HandleSpot[];
}

export const MODELS: readonly ModelEntry[] = [
  {
    id: 'dog',
    label: 'Dog',
    file: 'dog.glb',
    view: { azimuth: 58, elevation: 14 },
    invitation: 'Drag a paw',
    handles: [
      { name: 'Front right paw', vertex: 1172 },
      { name: 'Front left paw', vertex: 4946 },
      { name: 'Back right paw', vertex: 7827 },
      { name: 'Back left paw', vertex: 9813 },
      { name: 'Nose', vertex: 13637 },
      { name: 'Tail tip', vertex: 3169 },
    ],
  },
  {
    id: 'spot',
    label: 'Spot',
    file: 'spot.glb',
    view: { azimuth: 52, elevation: 12 },
    invitation: 'Drag a hoof',
    handles: [
      { name: 'Front right hoof', vertex: 1166 },
      { name: 'Front left hoof', vertex: 2292 },
      { name: 'Back right hoof', vertex: 1143 },
      { name: 'Back left hoof', vertex: 2273 },
      { name: 'Nose', vertex: 1453 },
      { name: 'Tail', vertex: 1855 },
    ],
  },
  { id: 'face', label: 'Face', file: 'face.glb', view: { azimuth: 9, elevation: 2 }, invitation: '', handles: [] },
];

export function modelOf(id: string): ModelEntry | undefined {
  return MODELS.find((model) => model.id === id);
}
