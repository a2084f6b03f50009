// Builds the front end of the report. The commands, after `npm ci`:
//
//   node build.mjs                 writes dist/ (committed; the Rust program reads it)
//   node build.mjs --out DIR       writes the same files into another folder
//   node check.mjs                 opens a sample page in Chromium and checks it
//   node check.mjs --page FILE     checks a report that the program has written
//   node check-figures.mjs FILE .. measures the texts of all figures of pages
//
// The output depends on the sources and on package-lock.json only. dist/sources.sha256 holds their digests: a unit
// test of the Rust program computes them again, and `cargo xtask reports` builds again and compares every file.

import { createHash } from 'node:crypto';
import { mkdir, readFile, readdir, writeFile } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { build } from 'esbuild';

const here = dirname(fileURLToPath(import.meta.url));
const { values: options } = parseArgs({ options: { out: { type: 'string' } } });
const dist = options.out ?? join(here, 'dist');

/** Notices of what the bundle contains; the page carries them, too. */
async function notices() {
  const parts = [];
  for (const [name, file] of [['uPlot', 'uplot'], ['three.js', 'three']]) {
    const folder = join(here, 'node_modules', file);
    const { version } = JSON.parse(await readFile(join(folder, 'package.json'), 'utf8'));
    const text = await readFile(join(folder, 'LICENSE'), 'utf8');
    parts.push(`${name} ${version}\n\n${text.replaceAll('\r', '').trim()}\n`);
  }
  return parts.join('\n');
}

/** Every file below a folder: paths from this one, with slashes. */
async function filesOf(folder) {
  const entries = await readdir(join(here, folder), { withFileTypes: true });
  const paths = entries.map((entry) => {
    const path = `${folder}/${entry.name}`;
    return entry.isDirectory() ? filesOf(path) : [path];
  });
  return (await Promise.all(paths)).flat();
}

/** A line for each source, sorted by path: its SHA-256 as it is on disk, and its path, as sha256sum writes them. */
async function digests() {
  const paths = ['build.mjs', 'package.json', 'package-lock.json', ...await filesOf('src')].sort();
  const lines = await Promise.all(paths.map(async (path) => {
    const digest = createHash('sha256').update(await readFile(join(here, path))).digest('hex');
    return `${digest}  ${path}\n`;
  }));
  return `# Sources of this folder, written by build.mjs. In sim/report: sha256sum --check dist/sources.sha256\n${lines.join('')}`;
}

const licenses = await notices();
const common = {
  absWorkingDir: here,
  bundle: true,
  minify: true,
  write: false,
  legalComments: 'none',
  logLevel: 'warning',
};
const script = await build({
  ...common,
  entryPoints: ['src/main.js'],
  outfile: 'report.js',
  format: 'iife',
  target: ['es2022'],
  charset: 'ascii',
  // A report writes nothing to the console.
  drop: ['console', 'debugger'],
  banner: { js: `/*!\n${licenses}*/` },
  metafile: true,
});
const style = await build({
  ...common,
  entryPoints: ['src/style.css'],
  outfile: 'report.css',
  target: ['chrome123', 'firefox120', 'safari17.5'],
  charset: 'utf8',
});

const [js] = script.outputFiles;
const [css] = style.outputFiles;
// Inside <script> and <style>, these would end the element or change how it is read.
for (const [file, forbidden] of [[js, /<\/script|<!--|\r|\0/i], [css, /<\/style|\r|\0|url\(/i]]) {
  const match = forbidden.exec(file.text);
  if (match !== null) throw new Error(`${file.path} contains ${JSON.stringify(match[0])}`);
}

const hash = (file) => `sha256-${createHash('sha256').update(file.contents).digest('base64')}`;
await mkdir(dist, { recursive: true });
await writeFile(join(dist, 'report.js'), js.contents);
await writeFile(join(dist, 'report.css'), css.contents);
await writeFile(join(dist, 'LICENSES.txt'), licenses);
await writeFile(join(dist, 'hashes.json'), `${JSON.stringify({ script: hash(js), style: hash(css) }, null, 2)}\n`);
await writeFile(join(dist, 'sources.sha256'), await digests());

const shares = Object.entries(Object.values(script.metafile.outputs)[0].inputs);
const kilobytes = (bytes) => `${(bytes / 1000).toFixed(1)} kB`;
const share = (part) => shares.filter(([name]) => name.includes(part)).reduce((sum, [, { bytesInOutput }]) => sum + bytesInOutput, 0);
console.log(`report.js ${kilobytes(js.contents.length)}: three.js ${kilobytes(share('node_modules/three/'))}, `
  + `uPlot ${kilobytes(share('node_modules/uplot/'))}, own ${kilobytes(shares.filter(([name]) => name.startsWith('src/')).reduce((sum, [, { bytesInOutput }]) => sum + bytesInOutput, 0))}`);
console.log(`report.css ${kilobytes(css.contents.length)}; together ${kilobytes(js.contents.length + css.contents.length)}`);
