import ExecutionEnvironment from '@docusaurus/ExecutionEnvironment';

// In the browser only, and apart from what every page waits for.
if (ExecutionEnvironment.canUseDOM) import('handlebody/element');
