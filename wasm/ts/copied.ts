/** Arrays that a caller gives stay the caller's: what is kept of them, or read after others had a turn, is a copy. */

const sliceTyped = (Object.getPrototypeOf(Uint8Array.prototype) as Float64Array).slice;

/**
 * The same numbers in memory of their own, which no other thread sees. Node's `Buffer` cuts no copy by its own `slice`; of an array that was
 * handed to another thread there is nothing to copy, and it stays what it is, empty.
 */
export function copied<T extends ArrayLike<number>>(numbers: T): T {
  if (numbers.length === 0) return numbers;
  return (ArrayBuffer.isView(numbers) ? sliceTyped.call(numbers as unknown as Float64Array) : Array.from(numbers)) as unknown as T;
}

/** A copy where another thread may write meanwhile; the array itself where none can. */
export function unshared<T extends ArrayLike<number>>(numbers: T): T {
  const shared =
    typeof SharedArrayBuffer === 'function' && ArrayBuffer.isView(numbers) && numbers.buffer instanceof SharedArrayBuffer;
  return shared ? copied(numbers) : numbers;
}
