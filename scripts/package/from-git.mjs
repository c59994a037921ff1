// `npm i git+…`: what is not in git is built by the package's "prepare".
import { cpSync, existsSync, mkdirSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { npm } from '../lib/install.mjs';
import { at } from '../lib/paths.mjs';
import { capture, mustRun } from '../lib/run.mjs';

/** @param {string[]} args @param {string} cwd */
function git(args, cwd) {
  const { status, stdout, stderr } = capture('git', args, { cwd });
  if (status !== 0) throw new Error(`git ${args[0]}: ${stderr}`);
  return stdout;
}

/** Installs what git tracks here, as it is now, from a repository of its own, and loads it. @param {string} folder An empty one. */
export async function tryFromGit(folder) {
  const [repository, project] = [path.join(folder, 'repository'), path.join(folder, 'project')];
  for (const name of git(['ls-files', '-z', '--cached', '--others', '--exclude-standard'], at()).split('\0')) {
    if (name && existsSync(at(name))) cpSync(at(name), path.join(repository, name));
  }
  git(['init', '-q'], repository);
  git(['add', '-A'], repository);
  git(['-c', 'user.name=check', '-c', 'user.email=check@localhost', 'commit', '-qm', 'As it is now'], repository);
  mkdirSync(project);
  writeFileSync(path.join(project, 'package.json'), '{ "private": true, "type": "module" }');
  await npm(['install', '--no-audit', '--no-fund', '--loglevel=error', `git+${pathToFileURL(repository)}`], { cwd: project });
  const program = "const { load } = await import('handlebody'); if (!((await load()).memory > 0)) process.exit(1);";
  await mustRun(process.execPath, ['--input-type=module', '-e', program], { cwd: project });
  console.log('the library installs from git');
}
