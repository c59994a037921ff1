/** What a draggable object calls back with may throw, dispose of it or of its solver, or move it on: it never breaks, and goes on where it still is. */
import { BoxGeometry, Mesh, PerspectiveCamera, Vector3 } from 'three';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { type BodyData, type Handlebody, load } from '../../wasm/ts/index.ts';
import { type Draggable, type DraggableOptions, draggable, meshFromObject } from '../../web/three/index.ts';
import { FakeElement, fakeDocument } from './support/fake-element.ts';

const box = () => new Mesh(new BoxGeometry(2, 1, 1, 4, 2, 2));
let body: BodyData;
let restore: () => void;
beforeAll(async () => {
  restore = fakeDocument();
  body = await (await load()).bake(meshFromObject(box()).mesh, { centers: 10, resolution: 12, spheres: 6 });
});
afterAll(() => restore());

type On = Pick<DraggableOptions, 'onWake' | 'onMove' | 'onError'>;
const CALLS: Record<string, { on: (listener: () => void) => On; cause: (dog: Draggable) => void }> = {
  onWake: { on: (onWake) => ({ onWake }), cause: (dog) => dog.setTarget(0, new Vector3(0.2, 0, 0)) },
  onMove: { on: (onMove) => ({ onMove }), cause: (dog) => dog.reset(0) },
  onError: {
    on: (onError) => ({ onError }),
    cause: (dog) => {
      dog.setTarget(0, new Vector3(1e300, 0, 0));
      dog.update();
    },
  },
};

/** One whose listener does something once, from when it is armed. */
async function armed(name: string, act: (dog: Draggable, hb: Handlebody) => void) {
  const hb = await load();
  let heard = 0;
  let dog: Draggable | undefined;
  const listener = () => {
    if (dog && heard++ === 0) act(dog, hb);
  };
  const { on, cause } = CALLS[name] as (typeof CALLS)[string];
  const options = { hb, camera: new PerspectiveCamera(), container: new FakeElement() as unknown as HTMLElement };
  const made = draggable(box(), body, { ...options, handles: [{ vertex: 0 }, { vertex: 9 }], ...on(listener) });
  dog = made;
  return { hb, dog: made, cause: () => cause(made), heard: () => heard };
}

/** Everything that a page goes on with, of one that may have ended: it ends typed, if at all. */
function goOn(dog: Draggable): void {
  for (const step of [() => dog.setTarget(0, new Vector3()), () => dog.reset(), () => dog.update(), () => dog.dispose()])
    try {
      step();
    } catch (error) {
      expect(error).toBeInstanceOf(HandlebodyError);
    }
}

describe.each(Object.keys(CALLS))('%s', (name) => {
  it('may throw: whoever caused it hears that, and the object goes on', async () => {
    const thrown = new Error('not now');
    const { dog, cause, heard } = await armed(name, () => {
      throw thrown;
    });
    expect(cause).toThrow(thrown);
    expect(heard()).toBe(1);
    dog.reset();
    dog.setTarget(1, new Vector3(0.3, 0.1, 0));
    for (let frame = 0; frame < 300 && dog.update(); frame++);
    expect(dog.positions.every(Number.isFinite)).toBe(true);
    expect(dog.vertex(9).distanceTo(new Vector3(0.3, 0.1, 0))).toBeLessThan(0.05);
  });

  it.each<[string, (dog: Draggable, hb: Handlebody) => void]>([
    ['dispose of the object', (dog) => dog.dispose()],
    ['end the solver', (_, hb) => hb.dispose()],
    ['set other handles', (dog) => dog.setHandles([{ vertex: 3 }])],
    ['move on', (dog) => dog.setTarget(1, new Vector3(0.1, 0, 0))],
    ['ask for a frame', (dog) => void dog.update()],
  ])('may %s', async (_, act) => {
    const { dog, cause, heard } = await armed(name, act);
    try {
      cause();
    } catch (error) {
      expect(error).toBeInstanceOf(HandlebodyError);
    }
    expect(heard()).toBeGreaterThan(0);
    goOn(dog);
  });
});
