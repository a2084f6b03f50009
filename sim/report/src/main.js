// Entry point: reads the data block and puts charts and the replay into the page.

import { createCharts } from './charts.js';
import { createCursor } from './cursor.js';
import { readReport } from './data.js';
import { createReplay } from './replay.js';
import { createTheme } from './theme.js';

const report = readReport(document.getElementById('precess-report'));
const theme = createTheme(document.getElementById('page-controls'));
document.documentElement.classList.add('scripted');
if (report !== null) {
  // The first group is over the time, which the replay shares.
  const cursors = report.groups.map(({ axis }) => createCursor(axis.from, axis.to, axis.log));
  createCharts(report, cursors, theme);
  createReplay(document.getElementById('replay-stage'), report, cursors[0], theme);
}
