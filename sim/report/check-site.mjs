// Walks the site of the documents in Chromium, from its disk: every page loads at two widths without an error, none scrolls
// sideways, every link and picture is there, both themes differ, and the search finds words on the pages that have them.

import { existsSync, mkdirSync, readdirSync } from 'node:fs';
import { join, relative, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { contextOf, launch } from './browser.mjs';

const site = resolve(process.argv[2]);
const pictures = `${site}-pictures`;
const WIDTHS = [1280, 400];

// Words, and a page that is among the first results.
const SOUGHT = [
  ['gimbal lock', 'docs/accuracy.html'],
  ['line of sight', 'docs/jitter.html'],
  ['dither', 'docs/guide.html'],
  ['double-double', 'docs/accuracy.html'],
  ['delay margin', 'docs/margins.html'],
  ['quantum', 'docs/control.html'],
  ['latin_hypercube', 'python/precess.campaign.html'],
  ['precess_step', 'c/precess.html'],
  ['blocked force', 'docs/structure.html'],
  ['errata letter', 'docs/letter.html'],
];

const faults = [];
let checks = 0;
function check(holds, what) {
  checks += 1;
  if (!holds) faults.push(what);
}

/** Every page below a folder, without rustdoc's own: of them the first of each crate. */
function pages(folder) {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const path = join(folder, entry.name);
    const below = relative(site, path);
    if (entry.isDirectory()) {
      const inside = below.startsWith('rust/');
      return inside ? [join(path, 'index.html')].filter(existsSync) : pages(path);
    }
    return entry.name.endsWith('.html') && !/^rust\/(?!index)/.test(below) ? [path] : [];
  }).sort();
}

/** Runs in the page: its addresses, its pictures that did not load, and how far it scrolls sideways. */
function read() {
  const links = [...document.querySelectorAll('a[href]')].map((link) => link.href).filter((href) => href.startsWith('file:'));
  const broken = [...document.images].filter((image) => image.naturalWidth === 0).map((image) => image.src);
  return { links, broken, sideways: document.documentElement.scrollWidth - window.innerWidth, nodes: document.body.textContent.length };
}

const browser = await launch();
mkdirSync(pictures, { recursive: true });
const all = pages(site);
const linked = new Set();
for (const width of WIDTHS) {
  const context = await contextOf(browser, { viewport: { width, height: 900 } });
  const page = await context.newPage();
  let errors = [];
  page.on('pageerror', (error) => errors.push(error.message));
  // What is given up because the next page is opened is no fault.
  page.on('requestfailed', (request) => { if (request.failure()?.errorText !== 'net::ERR_ABORTED') errors.push(`${request.url()} did not load`); });
  page.on('request', (request) => { if (!request.url().startsWith('file:') && !request.url().startsWith('data:')) errors.push(`requests ${request.url()}`); });
  for (const path of all) {
    errors = [];
    await page.goto(pathToFileURL(path).href);
    const found = await page.evaluate(read);
    const name = `${relative(site, path)} at ${width}`;
    check(errors.length === 0, `${name}: ${errors.join('; ')}`);
    check(found.broken.length === 0, `${name}: pictures ${found.broken.join(', ')}`);
    check(found.nodes > 40, `${name}: empty`);
    if (!relative(site, path).startsWith('rust/')) check(found.sideways <= 0, `${name}: scrolls sideways by ${found.sideways} px`);
    for (const link of found.links) linked.add(link.split('#')[0]);
  }
  await context.close();
}
for (const link of linked) check(existsSync(fileURLToPath(link)), `${link} is not there`);

const context = await contextOf(browser, { viewport: { width: 1280, height: 900 } });
const page = await context.newPage();
await page.goto(pathToFileURL(join(site, 'docs/guide.html')).href);
for (const [words, where] of SOUGHT) {
  await page.fill('#words', words);
  await page.waitForFunction((sought) => {
    const note = document.querySelector('#results p');
    return note !== null && document.getElementById('words').value === sought && !document.getElementById('results').hidden;
  }, words);
  await page.waitForTimeout(50);
  const first = await page.$$eval('#results a', (links) => links.map((link) => link.href.split('#')[0]));
  check(first.length > 0, `the search finds nothing for "${words}"`);
  const wanted = pathToFileURL(join(site, where)).href;
  check(first.includes(wanted), `the search for "${words}" does not show ${where}: ${first.slice(0, 5).map((url) => relative(site, fileURLToPath(url))).join(', ')}`);
}
await page.fill('#words', 'zzyzx');
await page.waitForFunction(() => document.querySelector('#results p')?.textContent.startsWith('0 '));
checks += 1;
await page.fill('#words', '');

const colours = [];
for (const _ of ['system', 'light', 'dark']) {
  await page.click('#theme');
  colours.push(await page.evaluate(() => getComputedStyle(document.body).backgroundColor));
}
check(new Set(colours).size === 2, `themes have the colours ${colours.join(', ')}`);

for (const [name, path, width, theme] of [
  ['guide', 'docs/guide.html', 1280, 'light'],
  ['derivation', 'docs/derivation.html', 1280, 'dark'],
  ['first', 'index.html', 400, 'dark'],
  ['python', 'python/precess.jitter.html', 1280, 'light'],
  ['c', 'c/precess.html', 400, 'light'],
  ['list', 'index.html', 400, 'light'],
]) {
  await page.setViewportSize({ width, height: 900 });
  await page.goto(pathToFileURL(join(site, path)).href);
  await page.evaluate((shown) => { document.documentElement.dataset.theme = shown; }, theme);
  if (name === 'list') {
    await page.click('#menu');
    check(await page.isVisible('#list a'), 'the list of pages does not open');
  }
  await page.screenshot({ path: join(pictures, `${name}-${width}-${theme}.png`) });
}
await browser.close();
for (const fault of faults) console.error(fault);
if (faults.length > 0) process.exit(1);
console.log(`${checks} checks in the browser on ${all.length} pages; pictures in ${pictures}`);
