export default {
  title: 'Docusaurus',
  url: 'https://example.org',
  baseUrl: '/',
  clientModules: ['./src/handlebody.js'],
  themeConfig: { navbar: { title: 'Docusaurus', items: [{ to: '/demo', label: 'A demo' }] } },
  presets: [['classic', { docs: { routeBasePath: '/' }, blog: false, theme: { customCss: './src/style.css' } }]],
};
