import DefaultTheme from 'vitepress/theme';
import './style.css';

export default {
  extends: DefaultTheme,
  enhanceApp() {
    // In the browser only, and apart from what every page waits for.
    if (!import.meta.env.SSR) import('handlebody/element');
  },
};
