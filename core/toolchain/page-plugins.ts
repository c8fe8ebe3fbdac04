// What the page's build adds to Vite's: a content security policy, the licence, the source, the service worker.
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Plugin } from 'vite';

const root = new URL('../../', import.meta.url);

/** The page needs nothing but its own files, and WebAssembly. */
const policy = [
  "default-src 'none'",
  "script-src 'self' 'wasm-unsafe-eval'",
  "worker-src 'self'",
  "style-src 'self'",
  "img-src 'self' blob: data:",
  "connect-src 'self'",
  "base-uri 'none'",
  "form-action 'none'",
].join('; ');

export const securityPolicy: Plugin = {
  name: 'security-policy',
  apply: 'build',
  transformIndexHtml: () => [
    {
      tag: 'meta',
      attrs: { 'http-equiv': 'Content-Security-Policy', content: policy },
      injectTo: 'head-prepend',
    },
  ],
};

/** LICENSE.txt and the source beside the page, as the AGPL asks of who offers it, and the notice of HDF5. */
export const licenceAndSource: Plugin = {
  name: 'licence-and-source',
  apply: 'build',
  generateBundle() {
    for (const [fileName, path] of [
      ['LICENSE.txt', 'LICENSE'],
      ['HDF5-LICENSE.txt', 'node_modules/h5wasm/LICENSE.txt'],
    ] as const)
      this.emitFile({ type: 'asset', fileName, source: readFileSync(new URL(path, root)) });
    const source = execFileSync('tar', ['-cz', '--null', '-T', '-'], {
      cwd: root,
      input: sourceFiles().join('\0'),
      maxBuffer: 2 ** 28,
    });
    this.emitFile({ type: 'asset', fileName: 'source.tar.gz', source });
  },
};

/** The files that git tracks, and nothing else that may lie about; where there is no git, all but what is built. */
function sourceFiles(): string[] {
  try {
    const listed = execFileSync('git', ['ls-files', '-z'], {
      cwd: root,
      stdio: ['ignore', 'pipe', 'ignore'],
    });
    return listed
      .toString()
      .split('\0')
      .filter((name) => name !== '' && existsSync(new URL(encodeURI(name), root)));
  } catch {
    const made = ['node_modules', 'build', 'dist', 'third_party', '.git'];
    return readdirSync(root, { recursive: true, withFileTypes: true })
      .filter((entry) => entry.isFile())
      .map((entry) => relative(fileURLToPath(root), join(entry.parentPath, entry.name)))
      .filter((name) => !name.split('/').some((part) => made.includes(part)));
  }
}

/** What few need: the source, and HDF5, 1 MB for CGNS files. The page itself is in the list as the folder. */
const notKept = /^(source\.tar\.gz|index\.html|assets\/hdf5_.*)$/;

/** sw.js with the list of what the build made and of the public files. */
export const serviceWorker: Plugin = {
  name: 'service-worker',
  apply: 'build',
  enforce: 'post',
  generateBundle(_, bundle) {
    const built = Object.keys(bundle).filter((name) => !notKept.test(name));
    const examples = readdirSync(new URL('public/examples/', root)).map((name) => `examples/${name}`);
    const files = ['', 'icon.svg', ...built, ...examples].map((name) => `./${name}`).sort();
    const hash = createHash('sha256');
    for (const [name, item] of Object.entries(bundle).sort(([a], [b]) => (a < b ? -1 : 1)))
      if (name !== 'source.tar.gz') hash.update(name).update(item.type === 'chunk' ? item.code : item.source);
    for (const name of examples) hash.update(readFileSync(new URL(`public/${name}`, root)));
    const source = readFileSync(new URL('web/sw.js', root), 'utf8')
      .replace('__VERSION__', `dualblock ${hash.digest('hex').slice(0, 16)}`)
      .replace('__FILES__', JSON.stringify(files));
    this.emitFile({ type: 'asset', fileName: 'sw.js', source });
  },
};
