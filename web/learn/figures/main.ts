import { figurePage } from './figure-page.ts';

figurePage();
