// The report's script: reads the data block and puts charts and the replay into the page.

import { createCursor } from './cursor.js';
import { readReport } from './data.js';
import { createHistories } from './histories.js';
import { createReplay } from './replay.js';
import { createTheme } from './theme.js';

const report = readReport(document.getElementById('precess-report'));
const theme = createTheme(document.getElementById('page-controls'));
document.documentElement.classList.add('scripted');
if (report !== null) {
  report.banded = report.columns.some((column) => column.banded);
  const first = report.time.length > 0 ? report.time[0] : 0;
  const cursor = createCursor(first, report.end);
  if (report.time.length > 0) createHistories(report, cursor, theme);
  createReplay(document.getElementById('replay-stage'), report, cursor, theme);
}
