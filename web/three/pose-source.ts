/** What a model says of its pose space: dimensions and examples, their shapes rows of morph-target weights. */
export interface PoseSpaceSource {
  readonly dimensions: readonly string[];
  readonly examples: readonly { readonly name: string; readonly at: readonly number[]; readonly shape: ArrayLike<number> }[];
}
