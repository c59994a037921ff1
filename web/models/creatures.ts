import { brontosaurus, elephant, giraffe, hippo, lizard } from './four-legged.ts';
import { octopus } from './octopus.ts';
import { type Limb, type Solid, solid } from './solid-field.ts';
import { acrobat, bird, craneFly, flamingo, starfish } from './two-many-legged.ts';

/** Animals of very different builds, y upwards, heads towards x, on about y = 0 and two units large. */
const RECIPES = {
  octopus,
  giraffe,
  brontosaurus,
  elephant,
  hippo,
  lizard,
  flamingo,
  bird,
  acrobat,
  starfish,
  'crane fly': craneFly,
};

type CreatureName = keyof typeof RECIPES;

export const CREATURES = Object.keys(RECIPES) as readonly CreatureName[];

interface Creature extends Solid {
  readonly name: CreatureName;
}

/** An animal as a field, negative inside, with the places where its limbs end. */
export function creature(name: CreatureName): Creature {
  const recipe: Limb = RECIPES[name];
  return { name, ...solid(recipe) };
}
