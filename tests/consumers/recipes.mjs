/** @type {Record<string, import('./consumers.mjs').Consumer>} */
export const RECIPES = {};
