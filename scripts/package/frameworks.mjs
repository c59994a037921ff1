// The tags' types in React's JSX, in Vue's templates and in Svelte's: each by the checker that its users have, on a file that is right and
// on one with a mistake, which has to be found.
import { mkdirSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { npm } from '../lib/install.mjs';
import { capture } from '../lib/run.mjs';

const TYPESCRIPT = 'typescript@5.9.3';

/** A page with the tags, one of which hears "change". @param {string} value Its listener. */
const react = (value = '(event) => console.log(event.detail.to[0].toFixed())') => `
import type {} from 'handlebody/element/react';
export const Page = () => (
  <>
    <handle-body src="dog.glb" alt="A dog" controls loading="eager" handles={[{ name: 'Nose', vertex: 1 }]} className="a" onchange={${value}} />
    <pose-space src="face.glb" at="valence=0.6" onload={() => {}}><img slot="poster" alt="" /></pose-space>
    <handle-figure name="course-12" caption controls />
  </>
);
`;

const vue = (value = '(event) => console.log(event.detail.to[0].toFixed())') => `
<script setup lang="ts">
import type {} from 'handlebody/element/vue';
</script>
<template>
  <handle-body src="dog.glb" alt="A dog" controls loading="eager" :handles="[{ name: 'Nose', vertex: 1 }]" class="a" @change="${value}" />
  <pose-space src="face.glb" at="valence=0.6" />
  <handle-figure name="course-12" caption controls />
</template>
`;

const svelte = (value = '(event) => console.log(event.detail.to[0].toFixed())') => `
<script lang="ts">
  import type {} from 'handlebody/element/svelte';
</script>
<handle-body src="dog.glb" alt="A dog" controls loading="eager" handles={[{ name: 'Nose', vertex: 1 }]} class="a" onchange={${value}}></handle-body>
<pose-space src="face.glb" at="valence=0.6"><img slot="poster" alt="" /></pose-space>
<handle-figure name="course-12" caption controls></handle-figure>
`;

/** @type {Record<string, { packages: string[], file: string, check: string[], page: (value?: string) => string, options?: object }>} */
const FRAMEWORKS = {
  'React 18': {
    packages: ['@types/react@18'],
    file: 'page.tsx',
    check: ['tsc', '-p', '.'],
    page: react,
    options: { jsx: 'react-jsx' },
  },
  'React 19': {
    packages: ['@types/react@19'],
    file: 'page.tsx',
    check: ['tsc', '-p', '.'],
    page: react,
    options: { jsx: 'react-jsx' },
  },
  'Vue 3': {
    packages: ['vue@3', 'vue-tsc@3'],
    file: 'page.vue',
    check: ['vue-tsc', '-p', '.'],
    page: vue,
    options: { jsx: 'preserve', jsxImportSource: 'vue' },
  },
  'Svelte 5': {
    packages: ['svelte@5', 'svelte-check@4'],
    file: 'page.svelte',
    check: ['svelte-check', '--tsconfig', './tsconfig.json'],
    page: svelte,
  },
};

/** @param {string} folder An empty one. @param {string} tarball */
export async function tryFrameworks(folder, tarball) {
  for (const [name, { packages, file, check, page, options }] of Object.entries(FRAMEWORKS)) {
    const project = path.join(folder, name.replace(' ', '-'));
    mkdirSync(project);
    const put = (/** @type {string} */ as, /** @type {string} */ text) => writeFileSync(path.join(project, as), text);
    put('package.json', '{ "private": true, "type": "module" }');
    const lib = ['es2022', 'dom', 'dom.iterable'];
    const compilerOptions = {
      target: 'es2022',
      module: 'esnext',
      moduleResolution: 'bundler',
      lib,
      types: [],
      strict: true,
      noEmit: true,
    };
    const strictTemplates = { vueCompilerOptions: { strictTemplates: true } };
    put(
      'tsconfig.json',
      JSON.stringify({ compilerOptions: { ...compilerOptions, ...options }, ...strictTemplates, include: [file] }),
    );
    const peers = ['three@0.187', '@types/three@0.187', TYPESCRIPT];
    await npm(['install', '--no-audit', '--no-fund', '--loglevel=error', tarball, ...peers, ...packages], { cwd: project });
    const run = (/** @type {string} */ text) => {
      put(file, text);
      return capture('npx', ['--no-install', ...check], { cwd: project, shell: process.platform === 'win32' });
    };
    const right = run(page());
    if (right.status !== 0) throw new Error(`The tags' types in ${name}:\n${right.stdout}${right.stderr}`);
    const wrong = run(page('(event) => event.detail.nowhere'));
    if (wrong.status === 0 || !/nowhere/.test(wrong.stdout))
      throw new Error(`The tags' types in ${name} find no mistake:\n${wrong.stdout}`);
    console.log(`the tags' types hold in ${name}`);
  }
}
