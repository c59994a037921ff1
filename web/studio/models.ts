/** The models that the studio offers. */

export interface ModelEntry {
  readonly id: string;
  readonly label: string;
  /** File in public/models. */
  readonly file: string;
  /** Where the camera looks from: azimuth and height, in degrees; azimuth 0 is +z, 90 is +x. */
  readonly view: { readonly azimuth: number; readonly elevation: number };
  readonly invitation: string;
}

export const MODELS: readonly ModelEntry[] = [
  {
    id: 'dog',
    label: 'Dog',
    file: 'dog.glb',
    view: { azimuth: 58, elevation: 14 },
    invitation: 'Drag a paw',
  },
  {
    id: 'spot',
    label: 'Spot',
    file: 'spot.glb',
    view: { azimuth: 52, elevation: 12 },
    invitation: 'Drag a hoof',
  },
  { id: 'face', label: 'Face', file: 'face.glb', view: { azimuth: 9, elevation: 2 }, invitation: '' },
];

export function modelOf(id: string): ModelEntry | undefined {
  return MODELS.find((model) => model.id === id);
}
