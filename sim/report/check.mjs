// Opens a report in Chromium and checks what it does; see build.mjs for the commands. Without --page,
// the page is made from sample.mjs. Screenshots go to the folder of --out, else to a temporary one; it is printed.

import assert from 'node:assert/strict';
import { mkdir, mkdtemp, readFile, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { parseArgs } from 'node:util';
import nunjucks from 'nunjucks';
import { contextOf, launch } from './browser.mjs';
import { bucketValues, decode, pointValues } from './check-data.mjs';
import { sampleContext, sampleData } from './sample.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const { values: options } = parseArgs({ options: { page: { type: 'string' }, out: { type: 'string' } } });
const folder = options.out ?? await mkdtemp(join(tmpdir(), 'precess-report-'));
await mkdir(folder, { recursive: true });

const WEBGL = ['--use-angle=swiftshader', '--enable-unsafe-swiftshader'];

/** The page of the sample, filled in as the Rust program does. */
async function samplePage() {
  const file = join(folder, 'report.html');
  const read = (name) => readFile(join(here, name), 'utf8');
  const hashes = JSON.parse(await read('dist/hashes.json'));
  const context = {
    ...sampleContext(sampleData()),
    style: await read('dist/report.css'),
    script: await read('dist/report.js'),
    style_hash: hashes.style,
    script_hash: hashes.script,
  };
  const environment = new nunjucks.Environment(null, { autoescape: true, throwOnUndefined: true });
  await writeFile(file, environment.renderString(await read('shell.html'), context));
  return file;
}

const file = options.page === undefined ? await samplePage() : resolve(options.page);
const address = pathToFileURL(file).href;
const text = await readFile(file, 'utf8');
const block = /<script type="application\/json" id="precess-report">([^]*?)<\/script>/.exec(text);
assert.ok(block, 'the page has a data block');
const report = decode(JSON.parse(block[1]));

const browsers = [];
let checks = 0;
function check(condition, what) {
  checks += 1;
  assert.ok(condition, what);
}

/** A page that records messages and requests. */
async function open(browser, settings) {
  const context = await contextOf(browser, { deviceScaleFactor: 1, ...settings });
  const page = await context.newPage();
  page.noise = [];
  page.on('console', (message) => page.noise.push(`console: ${message.text()}`));
  page.on('pageerror', (error) => page.noise.push(`error: ${error.message}`));
  page.on('request', (request) => {
    if (request.url() !== address && !request.url().startsWith('data:')) page.noise.push(`request: ${request.url()}`);
  });
  await page.goto(address);
  await page.waitForTimeout(300);
  return page;
}

async function close(page, name) {
  check(page.noise.length === 0, `${name}: no message and no request, but ${page.noise.join(' | ')}`);
  await page.context().close();
}

const shot = (page, name, full = false) => page.screenshot({ path: join(folder, `${name}.png`), fullPage: full });
/** Waits for what happens after a while, for half a minute at most; what is checked then says whether it did. */
async function until(holds) {
  for (let i = 0; i < 300 && !await holds(); i += 1) await new Promise((done) => { setTimeout(done, 100); });
}
const frames = (page) => page.evaluate(() => new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done))); }));
const readTime = async (page) => Number((await page.locator('.bar .time').first().textContent()).replace('\u2212', '-').match(/-?[\d.]+/)[0]);
const readRange = async (page) => (await page.locator('.bar .range').first().textContent()).replaceAll('\u2212', '-').match(/-?[\d.]+/g).map(Number);

/** The legend of a chart holds the values of the sample at the cursor. */
async function legendFollows(page, index, time) {
  const chart = report.charts[index];
  const cells = await page.locator(`#${chart.id} .legend .now`).allTextContents();
  assert.equal(cells.length, chart.columns.length);
  for (const [n, cell] of cells.entries()) {
    const candidates = bucketValues(report, chart.columns[n], time);
    check(candidates.includes(cell), `${chart.title}, curve ${n} at ${time} s: ${cell} is none of ${JSON.stringify(candidates)}`);
  }
  const limits = await page.locator(`#${chart.id} .legend .limit td:nth-child(2)`).allTextContents();
  const written = (chart.limits ?? []).map((limit) => limit.written);
  check(String(limits) === String(written), `${chart.title}: limits in the legend are ${limits}, not ${written}`);
}

async function cursorAndZoom(page, narrow) {
  const over = page.locator('.chart .u-over');
  const first = over.first();
  await first.scrollIntoViewIfNeeded();
  const box = await first.boundingBox();
  for (const share of [0.37, 0.81]) {
    await page.mouse.move(box.x + share * box.width, box.y + 60);
    await frames(page);
    const time = await readTime(page);
    const expected = report.start + share * (report.end - report.start);
    check(Math.abs(time - expected) < 0.02 * (report.end - report.start), `the cursor is at ${time}, not ${expected}`);
    for (const index of report.charts.keys()) await legendFollows(page, index, time);
    const at = await page.locator('.cursor-line').evaluateAll((lines) => lines.map((line) => line.style.transform));
    check(new Set(at).size === 1, 'the cursor lines of all charts stand at the same time');
  }
  const whole = await readRange(page);
  await page.mouse.move(box.x + 0.3 * box.width, box.y + 60);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.4 * box.width, box.y + 80, { steps: 4 });
  await page.mouse.move(box.x + 0.5 * box.width, box.y + 80, { steps: 4 });
  await page.mouse.up();
  await frames(page);
  const zoomed = await readRange(page);
  check(Math.abs((zoomed[1] - zoomed[0]) / (whole[1] - whole[0]) - 0.2) < 0.03, `a drag over a fifth shows ${zoomed}`);
  await shot(page, `zoomed-${narrow ? 360 : 1280}`);
  await page.getByRole('button', { name: 'Show the whole run' }).first().click();
  await frames(page);
  check(String(await readRange(page)) === String(whole), 'the button shows the whole run');
  await page.getByRole('button', { name: 'Show a narrower range of the time' }).first().click();
  await frames(page);
  check((await readRange(page))[1] - (await readRange(page))[0] < whole[1] - whole[0], 'the plus button narrows the range');
  await first.dblclick({ position: { x: 40, y: 40 } });
  await frames(page);
  check(String(await readRange(page)) === String(whole), 'a double click shows the whole run');
}

/** In the sample, one sample of the second curve is far above the rest: it reaches its height on the screen. */
async function spike(page) {
  const tops = await page.locator(`#${report.charts[0].id}`).evaluate((chart, share) => {
    const canvas = chart.querySelector('canvas');
    const [plot, whole] = [chart.querySelector('.u-over').getBoundingClientRect(), canvas.getBoundingClientRect()];
    const ratio = canvas.width / whole.width;
    // Read once: browsers remark on canvases that are read often.
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    const top = (at) => {
      const x = Math.round((plot.left - whole.left + at * plot.width) * ratio);
      for (let y = 0; y < canvas.height; y += 1) {
        for (let i = 4 * (y * canvas.width + x - 2); i <= 4 * (y * canvas.width + x + 2); i += 4) {
          if (data[i] > 180 && data[i + 1] > 50 && data[i + 1] < 160 && data[i + 2] < 110 && data[i + 3] > 60) return y;
        }
      }
      return canvas.height;
    };
    return [top(share), top(share + 0.06)];
  }, 3.3333 / 10);
  check(tops[1] - tops[0] > 30, `the spike is drawn: highest pixels ${tops}`);
}

/** Charts over a speed or a frequency: the cursor stands at a point of a curve, whose value is in the legend; a drag enlarges. */
async function overAxes(page) {
  for (const plane of report.planes) {
    const chart = page.locator(`#${plane.id}`);
    const over = chart.locator('.u-over');
    await over.scrollIntoViewIfNeeded();
    const box = await over.boundingBox();
    await page.mouse.move(box.x + 0.6 * box.width, box.y + 0.5 * box.height);
    await frames(page);
    const line = await chart.locator('.cursor-line').evaluate((node) => new DOMMatrix(getComputedStyle(node).transform).m41);
    const { from, to, log } = plane.axis;
    const share = line / box.width;
    const place = log ? from * (to / from) ** share : from + share * (to - from);
    check(Math.abs(share - 0.6) < 0.25, `${plane.title}: the cursor is at ${place}`);
    const cells = await chart.locator('.legend .now').allTextContents();
    for (const [n, curve] of plane.curves.entries()) {
      const candidates = pointValues(curve, place);
      check(candidates.includes(cells[n]), `${plane.title}, ${curve.label} at ${place}: ${cells[n]} is none of ${candidates}`);
    }
    const painted = () => chart.locator('canvas').evaluate((canvas) => canvas.toDataURL());
    const whole = await painted();
    await page.mouse.down();
    await page.mouse.move(box.x + 0.8 * box.width, box.y + 0.5 * box.height, { steps: 4 });
    await page.mouse.up();
    await frames(page);
    check(whole !== await painted(), `${plane.title}: a drag shows a part`);
    await over.dblclick({ position: { x: 30, y: 30 } });
    await frames(page);
    check(whole === await painted(), `${plane.title}: a double click shows all`);
  }
}

async function keyboard(page) {
  const plot = page.locator('.plot').first();
  await plot.focus();
  await page.keyboard.press('Home');
  await frames(page);
  check(await readTime(page) === Number(report.start.toFixed(6)), 'Home moves the cursor to the start');
  for (let i = 0; i < 3; i += 1) await page.keyboard.press('ArrowRight');
  await frames(page);
  const three = report.time[Math.min(3, report.time.length - 1)];
  const step = (report.end - report.start) / report.time.length;
  check(Math.abs(await readTime(page) - three) < 0.2 * step, 'three keys move the cursor by three steps');
  await legendFollows(page, 0, three);
  await page.keyboard.press('Shift+ArrowRight');
  await page.keyboard.press('ArrowLeft');
  await frames(page);
  const twelve = report.time[Math.min(12, report.time.length - 1)];
  check(Math.abs(await readTime(page) - twelve) < 0.2 * step, 'Shift moves by ten, left moves back');
  const whole = await readRange(page);
  await page.keyboard.press('+');
  await page.keyboard.press('+');
  await frames(page);
  const near = await readRange(page);
  check(near[1] - near[0] < 0.5 * (whole[1] - whole[0]), 'plus shortens the span');
  await page.keyboard.press('-');
  await page.keyboard.press('0');
  await frames(page);
  check(String(await readRange(page)) === String(whole), '0 shows the whole run');
  const unit = report.columns[report.charts[0].columns[0]].unit;
  await until(async () => (await page.locator('[role=status]').textContent()).includes(unit));
  const said = await page.locator('[role=status]').textContent();
  check(said.includes(unit) && / s\. /.test(said), `values are announced: ${said}`);
  const outline = await plot.evaluate((node) => getComputedStyle(node).outlineStyle);
  check(outline !== 'none', 'the chart with the focus has a ring');
  const described = await plot.getAttribute('aria-describedby');
  const summary = await page.locator(`#${described}`).textContent();
  check(/minimum .* maximum .* at the end/.test(summary), 'a chart is summed up in words');
  const eye = page.locator('.legend tbody button').first();
  await eye.click();
  check(await eye.getAttribute('aria-pressed') === 'false', 'a curve is hidden by its name');
  await eye.click();
}

async function replay(page, name) {
  const canvas = page.locator('#replay-stage canvas');
  await canvas.scrollIntoViewIfNeeded();
  await frames(page);
  const slider = page.locator('#replay-stage input[type=range]');
  const picture = async () => { await frames(page); return (await canvas.screenshot()).toString('base64'); };
  const set = async (share) => slider.evaluate((node, value) => {
    node.value = String(value);
    node.dispatchEvent(new Event('input'));
  }, Math.round(share * 10000));
  await set(0.1);
  const before = await picture();
  // No whole number of turns of any wheel later.
  await set(0.6137);
  check(before !== await picture(), 'the drawing follows the slider');
  await frames(page);
  const expected = report.start + 0.6137 * (report.end - report.start);
  check(Math.abs(await readTime(page) - expected) < 0.02 * (report.end - report.start), 'the charts follow the slider');
  await legendFollows(page, 0, await readTime(page));
  await shot(page, `replay-${name}`);
  await canvas.focus();
  await page.keyboard.press('0');
  const still = await picture();
  await page.keyboard.press('ArrowLeft');
  await until(async () => still !== await picture());
  check(still !== await picture(), 'an arrow key turns the view');
  await page.keyboard.press('0');
  // A loaded machine draws later than the frames that were awaited.
  await until(async () => still === await picture());
  check(still === await picture(), '0 restores the view');
  const box = await canvas.boundingBox();
  await page.mouse.move(box.x + 0.6 * box.width, box.y + 0.6 * box.height);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.4 * box.width, box.y + 0.5 * box.height, { steps: 3 });
  await page.mouse.up();
  check(still !== await picture(), 'dragging turns the view');
  await page.getByRole('button', { name: 'Reset view' }).click();

  const play = page.locator('#replay-stage .play');
  // At the lowest speed, so that a short run has not ended when the button pauses it.
  await page.locator('#replay-stage select').nth(1).selectOption({ index: 0 });
  await set(0);
  await play.click();
  await until(async () => await readTime(page) > report.start);
  await play.click();
  await frames(page);
  const played = await readTime(page);
  check(played > report.start, `playing moves the cursor, to ${played}`);
  check(await play.textContent() === 'Play', 'the button pauses');

  const windows = report.replay.windows;
  const slow = windows.findIndex(({ magnify }) => magnify !== 1);
  if (slow < 0) return;
  await page.locator('#replay-stage select').first().selectOption(String(slow));
  await set(0.25);
  const quarter = await picture();
  const statement = await page.locator('.statement').textContent();
  check(statement.includes('deviation ×') && statement.includes('1 s shows'), `factor and time scale are stated: ${statement}`);
  await set(0.29);
  check(quarter !== await picture(), 'slow motion moves');
  await shot(page, `slow-${name}`);
  await play.click();
  await page.waitForTimeout(600);
  await play.click();
  await page.locator('#replay-stage select').first().selectOption('0');
}

/** With scripts off, and on paper, the tables and the figures are there. */
async function still(browser) {
  const page = await open(browser, { viewport: { width: 1280, height: 900 }, javaScriptEnabled: false });
  const hidden = async () => {
    const states = [];
    for (const node of await page.locator('figure svg, table').all()) states.push(await node.isVisible());
    return states.filter((seen) => !seen).length;
  };
  check(await page.locator('figure svg').count() > 0 && await hidden() === 0, 'all is there without scripts');
  await shot(page, 'no-script', true);
  await close(page, 'without scripts');
}

async function printed(browser) {
  for (const colorScheme of ['light', 'dark']) {
    const page = await open(browser, { viewport: { width: 1280, height: 900 }, colorScheme });
    await page.emulateMedia({ media: 'print', colorScheme });
    for (const figure of await page.locator('figure').all()) check(await figure.isVisible(), 'figures are printed');
    for (const chart of await page.locator('.chart, .bar').all()) check(!(await chart.isVisible()), 'charts are not printed');
    const ink = await page.evaluate(() => getComputedStyle(document.body).color);
    check(ink === 'rgb(28, 28, 30)', `ink is dark on paper, ${ink}`);
    await page.pdf({ path: join(folder, `print-${colorScheme}.pdf`), format: 'A4', printBackground: true });
    await close(page, 'on paper');
  }
}

async function main() {
  const started = async (more) => {
    browsers.push(await launch(more));
    return browsers.at(-1);
  };
  const browser = await started(WEBGL);
  for (const width of [1280, 360]) {
    for (const colorScheme of ['light', 'dark']) {
      const name = `${width}-${colorScheme}`;
      const page = await open(browser, { viewport: { width, height: 900 }, colorScheme, hasTouch: width < 500 });
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      check(wide <= width, `the page is ${wide} px wide in a window of ${width} px`);
      const drawn = report.charts.length + report.planes.length;
      check(await page.locator('.chart').count() === drawn, 'each chart of the data is there');
      if (report.planes.length > 0) await overAxes(page);
      if (report.charts.length > 0) {
        if (options.page === undefined) await spike(page);
        await cursorAndZoom(page, width < 500);
        await keyboard(page);
      }
      if (report.replay) await replay(page, name);
      await page.mouse.move(2, 2);
      await page.evaluate(() => { document.activeElement.blur(); window.scrollTo(0, 0); });
      await shot(page, `page-${name}`, true);
      await page.locator('.theme').click();
      await frames(page);
      const scheme = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
      check((scheme === 'rgb(255, 255, 255)') === (colorScheme === 'dark'), 'the button changes light and dark');
      await shot(page, `toggled-${name}`);
      await close(page, name);
    }
  }

  const calm = await open(browser, { viewport: { width: 1280, height: 900 }, reducedMotion: 'reduce' });
  if (report.replay) {
    const times = new Set();
    await calm.locator('#replay-stage .play').click();
    for (let i = 0; i < 12; i += 1) {
      times.add(await calm.locator('#replay-stage .reading').textContent());
      await calm.waitForTimeout(100);
    }
    check(times.size <= 5, `with reduced motion few pictures are shown, not ${times.size}`);
  }
  await close(calm, 'reduced motion');
  await still(browser);
  await printed(browser);

  const blind = await started(['--disable-gpu', '--disable-3d-apis', '--disable-software-rasterizer']);
  const page = await open(blind, { viewport: { width: 1280, height: 900 } });
  if (report.replay) check(await page.locator('.replay-missing').isVisible(), 'a sentence says that WebGL is missing');
  if (report.charts.length > 0) {
    await cursorAndZoom(page, false);
    await keyboard(page);
  }
  await close(page, 'without WebGL');
}

try {
  await main();
  console.log(`${checks} checks passed; pictures in ${folder}`);
} catch (error) {
  console.error(`${error.message}\npictures in ${folder}`);
  process.exitCode = 1;
} finally {
  await Promise.all(browsers.map((browser) => browser.close()));
}
