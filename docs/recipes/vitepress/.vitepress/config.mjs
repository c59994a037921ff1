import { defineConfig } from 'vitepress';

export default defineConfig({
  title: 'VitePress',
  themeConfig: { nav: [{ text: 'A demo', link: '/demo' }] },
  // Vue would look for components of these names, and warn that there are none.
  vue: {
    template: { compilerOptions: { isCustomElement: (tag) => ['handle-body', 'pose-space', 'handle-figure'].includes(tag) } },
  },
});
