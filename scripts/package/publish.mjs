// What `npm publish` would do and say.
import { readFileSync } from 'node:fs';
import { at } from '../lib/paths.mjs';
import { capture } from '../lib/run.mjs';

/** A machine that is to publish is logged in; one that checks need not be. */
const EXPECTED = /requires you to be logged in/;

/** A dry run that warns of nothing. */
export function dryRun() {
  const { status, stderr, stdout } = capture('npm', ['publish', '--dry-run', '--ignore-scripts', '--loglevel=warn'], {
    shell: process.platform === 'win32',
  });
  const warnings = stderr.split('\n').filter((line) => /^npm (warn|error)/i.test(line) && !EXPECTED.test(line));
  if (status !== 0 || warnings.length > 0) throw new Error(`npm publish --dry-run:\n${warnings.join('\n') || stderr}`);
  console.log(`npm publish --dry-run: ${stdout.trim()}`);
  const { repository } = JSON.parse(readFileSync(at('package.json'), 'utf8'));
  if (!repository) console.log('package.json names no repository yet, which publishing with provenance needs.');
}
