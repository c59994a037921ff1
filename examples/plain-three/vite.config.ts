import { defineConfig } from 'vite';

// The page awaits at its top level.
export default defineConfig({ base: './', build: { target: 'es2022' } });
