/** What no input may end in, though it is typed: the solver stopped, or something is wrong in a worker. */
const DEFECTS = ['internal', 'wasm-trapped'];

/** What is wrong with an error, if anything. @param {unknown} error */
export function faultOf(error) {
  const isTyped = error instanceof Error && error.name === 'HandlebodyError' && 'remedy' in error && error.remedy !== '';
  const isDefect = isTyped && 'code' in error && DEFECTS.includes(String(error.code));
  return isTyped && !isDefect && error.message.length <= 2000 ? undefined : `${error}`.slice(0, 200);
}
