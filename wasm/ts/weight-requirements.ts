/** The largest numbers at which a requirement is said to hold; `bounded` is how far weights may leave [0, 1]. */
export const WEIGHT_REQUIREMENTS = { smooth: 0.5, local: 0.35, shapeAware: 0.25, sumsToOne: 1e-6, bounded: 1e-6 } as const;
