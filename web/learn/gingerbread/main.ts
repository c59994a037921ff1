import { figurePage } from '../figures/figure-page.ts';

figurePage('gingerbread');
