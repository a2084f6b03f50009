// The browser of the checks. CHROMIUM names it where it is not at /usr/bin/chromium.

import { chromium } from 'playwright-core';

const QUIET = ['--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync', '--no-sandbox'];

// Beside compilers, a page loads and an element answers late; a check that fails does not wait for this.
const PATIENCE = 300_000;

/** Starts the browser, with more arguments than what keeps it silent. */
export function launch(more = []) {
  return chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', timeout: PATIENCE, args: [...QUIET, ...more] });
}

/** A context of a page, whose actions have as much time. */
export async function contextOf(browser, settings) {
  const context = await browser.newContext(settings);
  context.setDefaultTimeout(PATIENCE);
  return context;
}
