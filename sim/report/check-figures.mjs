// Measures the texts of every figure of given pages in Chromium, at two widths: each is inside its figure, and no two
// overlap. Themes change colours and move nothing. Pages that scroll sideways are named, too.

import { pathToFileURL } from 'node:url';
import { contextOf, launch } from './browser.mjs';

const pages = process.argv.slice(2);

/** Runs in the page: what is wrong with the texts of its figures, and how many there are. */
function measure() {
  const found = { faults: [], texts: 0 };
  const slack = 1;
  const seen = (element) => {
    const style = getComputedStyle(element);
    return style.visibility !== 'hidden' && style.display !== 'none' && Number(style.opacity) > 0;
  };
  const slanted = (text) => {
    const turned = text.closest('[transform*="rotate"]')?.getAttribute('transform');
    return turned !== undefined && !/rotate\((-90|90|180|270)\b/.test(turned);
  };
  for (const figure of document.querySelectorAll('svg')) {
    const whole = figure.getBoundingClientRect();
    if (whole.width === 0 || !seen(figure)) continue;
    const label = figure.closest('figure, section')?.querySelector('figcaption, h2, h3, h4')?.textContent.trim() ?? 'a figure';
    const texts = [...figure.querySelectorAll('text')].filter((text) => text.textContent.trim() !== '' && seen(text));
    const boxes = texts.map((text) => [text.getBoundingClientRect(), text.textContent.trim(), text]);
    found.texts += boxes.length;
    for (const [box, text] of boxes) {
      const out = [whole.left - box.left, box.right - whole.right, whole.top - box.top, box.bottom - whole.bottom];
      const most = Math.max(...out);
      if (most > slack) found.faults.push(`${label}: "${text}" is cut by ${most.toFixed(1)} px`);
    }
    for (let i = 0; i < boxes.length; i += 1) {
      for (let j = 0; j < i; j += 1) {
        const [a, name, one] = boxes[i];
        const [b, other, two] = boxes[j];
        // The box of a slanted text is larger than it.
        if (slanted(one) || slanted(two)) continue;
        const x = Math.min(a.right, b.right) - Math.max(a.left, b.left);
        const y = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
        // Boxes of lines of text have some pixels above and below the letters.
        if (x > slack && y > 0.25 * Math.min(a.height, b.height)) {
          found.faults.push(`${label}: "${name}" is over "${other}" by ${x.toFixed(1)} x ${y.toFixed(1)} px`);
        }
      }
    }
  }
  const wide = document.documentElement.scrollWidth - window.innerWidth;
  if (wide > slack) found.faults.push(`the page scrolls sideways by ${wide} px`);
  return found;
}

const browser = await launch();
let faults = 0;
let texts = 0;
for (const page of pages) {
  // A file of its own is not laid out. Of a page, the figures are measured that charts replace where scripts run: they are printed.
  const isFile = page.endsWith('.svg');
  for (const [width, javaScriptEnabled] of isFile ? [[1400, true]] : [[1400, false], [400, false], [400, true]]) {
    const context = await contextOf(browser, { viewport: { width, height: 900 }, javaScriptEnabled });
    const tab = await context.newPage();
    await tab.goto(pathToFileURL(page).href);
    const found = await tab.evaluate(measure);
    texts += found.texts;
    if (found.texts === 0 && (isFile || !javaScriptEnabled)) found.faults.push('no text of a figure');
    for (const fault of new Set(found.faults)) {
      faults += 1;
      console.error(`${page}, ${width} px: ${fault}`);
    }
    await context.close();
  }
}
await browser.close();
if (faults > 0) {
  console.error(`${faults} faults`);
  process.exit(1);
}
console.log(`${texts} checks passed: texts of figures on ${pages.length} pages`);
