// A sample of what the Rust program puts into the page: a hub with four single-gimbal gyros in a
// pyramid, two panels and a slosh mass. The motion is synthetic; it shows everything the page can draw.

const END = 10;
const STEPS = 100_000;
const BUCKETS = 600;
const BETA = (54.74 * Math.PI) / 180;
const DEG = 180 / Math.PI;
const SPIN = 2 * Math.PI * 100;

const base64 = (array) => Buffer.from(array.buffer, array.byteOffset, array.byteLength).toString('base64');
export const f32 = (values) => base64(Float32Array.from(values));
export const f64 = (values) => base64(Float64Array.from(values));

function multiply(a, b) {
  return [
    a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
    a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
    a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
    a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
  ];
}

/** Body rate, rad/s: slow turning, jitter at the wheels' rate, and one spike. */
function rate(t) {
  const j = 5e-4;
  return [
    0.06 * Math.sin(0.6 * t) + j * Math.cos(SPIN * t),
    0.04 * Math.cos(0.4 * t) + j * Math.sin(SPIN * t) + (Math.abs(t - 3.3333) < 6e-5 ? 0.03 : 0),
    0.09 * Math.exp(-t / 6) + 0.3 * j * Math.cos(SPIN * t + 1),
  ];
}

const gimbal = (i, t) => ((t > 1.5 && i === 1 ? 0.35 : 0.25 * Math.min(t, 4)) + 0.02 * Math.sin(3 * t + i)) * (i % 2 ? -1 : 1);
const gimbalRate = (i, t) => (gimbal(i, t + 5e-5) - gimbal(i, t - 5e-5)) / 1e-4;
const turned = (i, t) => SPIN * t * (1 + 0.01 * i) + 0.5 * i * t * t;
const spin = (i, t) => SPIN * (1 + 0.01 * i) + i * t;
const panel = (i, t) => 0.05 * Math.exp(-t / 5) * Math.cos(4 * t) * (i ? -1 : 1);
const panelRate = (i, t) => (panel(i, t + 5e-5) - panel(i, t - 5e-5)) / 1e-4;
const slosh = (t) => 0.08 * Math.sin(2.2 * t) * Math.exp(-t / 15);
const sloshRate = (t) => (slosh(t + 5e-5) - slosh(t - 5e-5)) / 1e-4;

/** Attitudes at every step. */
function attitudes() {
  const h = END / STEPS;
  const all = new Float64Array(4 * (STEPS + 1));
  let q = [1, 0, 0, 0];
  for (let k = 0; k <= STEPS; k += 1) {
    all.set(q, 4 * k);
    const w = rate((k + 0.5) * h);
    const angle = Math.hypot(...w) * h;
    const share = Math.sin(angle / 2) / (angle / h);
    q = multiply(q, [Math.cos(angle / 2), share * w[0], share * w[1], share * w[2]]);
  }
  return all;
}

const ATTITUDES = attitudes();
const attitudeAt = (t) => {
  const k = Math.min(STEPS, Math.round((t / END) * STEPS));
  return [...ATTITUDES.subarray(4 * k, 4 * k + 4)];
};

/** Least and largest value of each bucket, less an offset. */
function column(name, label, unit, frame, f, offset = 0) {
  const per = STEPS / BUCKETS;
  const [low, high, first] = [[], [], []];
  for (let b = 0; b < BUCKETS; b += 1) {
    let [least, most] = [Infinity, -Infinity];
    for (let k = Math.ceil(b * per); k < (b + 1) * per; k += 1) {
      const value = f((k * END) / STEPS) - offset;
      least = Math.min(least, value);
      most = Math.max(most, value);
    }
    first.push(f((Math.ceil(b * per) * END) / STEPS) - offset);
    low.push(least);
    high.push(most);
  }
  const made = { name, label, unit, frame, min: f32(low), max: f32(high), first: f32(first), final: f(END) };
  if (offset !== 0) made.offset = offset;
  if (low.every((value, b) => Math.fround(value) === Math.fround(high[b]))) {
    delete made.max;
    delete made.first;
  }
  return made;
}

function columns() {
  const axes = ['x', 'y', 'z'];
  const noise = (t, seed) => Math.abs(Math.sin(12.9898 * t * 997 + seed) * 43758.5453 % 1);
  return [
    ...axes.map((a, i) => column(`omega_${a}`, `ω_${a}`, 'deg/s', 'B', (t) => rate(t)[i] * DEG)),
    ...axes.map((a, i) => column(`sigma_${a}`, `σ_${a}`, '', 'B/N', (t) => {
      const q = attitudeAt(t);
      return q[i + 1] / (1 + q[0]);
    })),
    ...[0, 1, 2, 3].map((i) => column(`cmg${i + 1}_gamma`, `γ_${i + 1}`, 'deg', `cmg${i + 1}`, (t) => gimbal(i, t) * DEG)),
    ...[0, 1, 2, 3].map((i) => column(`cmg${i + 1}_spin`, `Ω_${i + 1}`, 'rpm', `cmg${i + 1}`, (t) => (spin(i, t) * 30) / Math.PI, 6000)),
    ...[0, 1].map((i) => column(`panel${i + 1}`, `θ_${i + 1}`, 'deg', `panel${i + 1}`, (t) => panel(i, t) * DEG)),
    column('slosh', 'ρ', 'm', 'tank', slosh),
    column('energy', 'energy less work', '', '', (t) => 1e-15 * t * (0.2 + noise(t, 1))),
    column('angular', 'angular momentum', '', '', (t) => 3e-16 * (t + 0.1) * (0.1 + noise(t, 2))),
    column('load', '|F|', 'N', 'cmg1', (t) => 12 + 3 * Math.cos(SPIN * t) * Math.exp(-t / 4)),
  ];
}

const CHARTS = [
  ['Angular velocity', 'deg/s', [0, 1, 2]],
  ['Attitude, modified Rodrigues parameters', '', [3, 4, 5]],
  ['Gimbal angles', 'deg', [6, 7, 8, 9]],
  ['Spin of the wheels', 'rpm', [10, 11, 12, 13]],
  ['Panel angles', 'deg', [14, 15]],
  ['Position of the slosh mass', 'm', [16]],
  ['Relative drift', '', [17, 18], true],
  ['Force on the mount of cmg1', 'N', [19]],
].map(([title, unit, list, log = false], i) => ({ id: `chart-${i}`, title, unit, columns: list, log, static: `figure-${i}` }));

// A limit over a part of the run, on both sides of a value other than zero, and one that is too far away to be drawn.
CHARTS[2].limits = [{ label: 'limit of a gimbal', written: '70 deg', values: [75, -65], from: 2, to: END }];
CHARTS[7].limits = [{ label: 'limit of load', written: '200 N', values: [200], from: 0, to: END }];

/** Joint frames of the pyramid: gimbal axis z, spin axis x of the gimbal frame. */
function joints() {
  const list = [];
  for (let i = 0; i < 4; i += 1) {
    const [c, s] = [Math.cos((i * Math.PI) / 2), Math.sin((i * Math.PI) / 2)];
    const [cb, sb] = [Math.cos(BETA), Math.sin(BETA)];
    const g = [c * sb, s * sb, cb];
    const x = [-s, c, 0];
    const y = [g[1] * x[2] - g[2] * x[1], g[2] * x[0] - g[0] * x[2], g[0] * x[1] - g[1] * x[0]];
    list.push({
      name: `cmg${i + 1}.gimbal`, parent: -1, axis: 2, slides: false,
      mount: [x[0], y[0], g[0], x[1], y[1], g[1], x[2], y[2], g[2]],
      origin: [0.55 * c, 0.55 * s, 0.72],
      body: { shape: 'ring', radius: 0.27, width: 0.04, centre: [0, 0, 0], size: null, heavy: null },
    });
    list.push({
      name: `cmg${i + 1}.wheel`, parent: list.length - 1, axis: 0, slides: false,
      mount: [1, 0, 0, 0, 1, 0, 0, 0, 1], origin: [0, 0, 0],
      body: { shape: 'wheel', radius: 0.21, width: 0.09, centre: [0, 0, 0], size: null, heavy: [0, 1, 0] },
    });
  }
  for (const side of [1, -1]) {
    list.push({
      name: `panel${side > 0 ? 1 : 2}`, parent: -1, axis: 0, slides: false,
      mount: [side, 0, 0, 0, side, 0, 0, 0, 1], origin: [0, 0.6 * side, 0],
      body: { shape: 'plate', radius: 0, width: 0, centre: [0, 0.95, 0], size: [0.8, 1.8, 0.03], heavy: null },
    });
  }
  list.push({
    name: 'slosh', parent: -1, axis: 0, slides: true, mount: [1, 0, 0, 0, 1, 0, 0, 0, 1], origin: [0, 0, -0.3],
    body: { shape: 'ball', radius: 0.16, width: 0, centre: [0, 0, 0], size: null, heavy: null },
  });
  return list;
}

function windowOf(label, from, to, frames, magnify) {
  const out = { time: [], attitude: [], omega: [], momentum: [], coordinates: [], rates: [] };
  for (let k = 0; k < frames; k += 1) {
    const t = from + ((to - from) * k) / (frames - 1);
    out.time.push(t);
    out.attitude.push(...attitudeAt(t));
    out.omega.push(...rate(t));
    out.momentum.push(20, 12, 31);
    for (let i = 0; i < 4; i += 1) {
      out.coordinates.push(gimbal(i, t), turned(i, t));
      out.rates.push(gimbalRate(i, t), spin(i, t));
    }
    out.coordinates.push(panel(0, t), panel(1, t), slosh(t));
    out.rates.push(panelRate(0, t), panelRate(1, t), sloshRate(t));
  }
  return {
    label, frames, magnify,
    time: f64(out.time), attitude: f64(out.attitude), omega: f32(out.omega), momentum: f32(out.momentum),
    coordinates: f64(out.coordinates), rates: f32(out.rates),
  };
}

const COLOURS = ['#0072B2', '#D55E00', '#009E73', '#CC79A7'];
const DASHES = ['', '80 30', '20 25', '90 30 20 30'];

/** A static figure in the manner of the Rust program, in tenths of a unit. */
function picture(chart, all) {
  const [w, h, left, top] = [6600, 2400, 700, 100];
  const series = chart.columns.map((c) => {
    const low = new Float32Array(Uint8Array.from(Buffer.from(all[c].min, 'base64')).buffer);
    return chart.log ? [...low].map((v) => Math.log10(Math.max(v, 1e-18))) : [...low];
  });
  const flat = series.flat();
  const [least, most] = [Math.min(...flat), Math.max(...flat)];
  const y = (v) => (top + h * (1 - (v - least) / (most - least || 1))).toFixed(0);
  const lines = series.map((values, i) => {
    const points = values.map((v, k) => `${(left + (w * k) / BUCKETS).toFixed(0)},${y(v)}`).join(' ');
    return `<polyline points="${points}" fill="none" stroke="${COLOURS[i % 4]}" stroke-width="14" stroke-dasharray="${DASHES[i % 4]}"/>`;
  });
  return `<svg class="figure" xmlns="http://www.w3.org/2000/svg" role="img" width="760" height="290" viewBox="0 0 7600 2900"><title>${chart.title}</title>`
    + `<rect x="0" y="0" width="7600" height="2900" fill="#FFFFFF"/><rect x="${left}" y="${top}" width="${w}" height="${h}" fill="none" stroke="#1C1C1E" stroke-width="8"/>`
    + `${lines.join('')}<text x="${left}" y="2800" font-size="150" fill="#1C1C1E">Time t (s), 0 to ${END}; ${chart.unit || '1'}</text></svg>`;
}

const number = (text) => ({ text, number: true, state: false });
const word = (text) => ({ text, number: false, state: false });
const state = (text) => ({ text, number: false, state: true });

function sections(all) {
  const figure = (i, caption) => ({ kind: 'figure', id: `figure-${i}`, number: String(i + 1), caption, svg: picture(CHARTS[i], all) });
  return [
    { id: 'requirements', title: 'Requirements', blocks: [{
      kind: 'table', caption: 'Requirements of the scenario and what the run reached',
      columns: [
        { title: 'Requirement', unit: '', number: false }, { title: 'Quantity', unit: '', number: false },
        { title: 'Limit', unit: '', number: true }, { title: 'Reached', unit: '', number: true },
        { title: 'At', unit: 's', number: true }, { title: 'State', unit: '', number: false },
      ],
      rows: [
        { state: 'met', cells: [word('Pointing jitter'), word('|δω| over one turn of a wheel'), number('0.050 deg/s'), number('0.0286 deg/s'), number('0.00'), state('met')] },
        { state: 'met', cells: [word('Bearing load'), word('|F| on the mount of cmg1'), number('20 N'), number('15.0 N'), number('0.00'), state('met')] },
        { state: 'violated', cells: [word('Body rate'), word('|ω|'), number('5.00 deg/s'), number('5.64 deg/s'), number('0.00'), state('violated')] },
      ],
    }] },
    { id: 'histories', title: 'Time histories', blocks: [
      { kind: 'events', items: [{ time: '1.5 s', text: 'gimbal of cmg2 locked' }, { time: '4 s', text: 'gimbal torques off' }] },
      figure(0, 'Angular velocity of the hub, in B.'), figure(1, 'Attitude of B relative to N.'), figure(2, 'Gimbal angles.'),
      figure(3, 'Spin of the wheels.'), figure(4, 'Panel angles.'), figure(5, 'Position of the slosh mass in its tank.'),
    ] },
    { id: 'energy', title: 'Energy ledger and drifts', blocks: [
      { kind: 'table', caption: 'Energy ledger of the whole run',
        columns: [{ title: 'Entry', unit: '', number: false }, { title: 'Energy', unit: 'J', number: true }],
        rows: [['Kinetic energy at the start', '7421.337120'], ['Work of the motors', '12.448103'], ['Dissipated in joints', '\u22120.103342'], ['Kinetic energy at the end', '7433.681881']]
          .map(([a, b]) => ({ state: '', cells: [word(a), number(b)] })) },
      figure(6, 'Drift of energy less work and of angular momentum, relative to their units.'),
    ] },
    { id: 'replay', title: 'Replay', blocks: [{ kind: 'replay' }] },
    { id: 'mass', title: 'Mass properties', blocks: [{
      kind: 'table', caption: 'Mass, centre of mass and inertia about it, all coordinates at their start',
      columns: [{ title: 'Body', unit: '', number: false }, ...['Mass', 'x', 'y', 'z', 'I₁₁', 'I₂₂', 'I₃₃', 'I₁₂', 'I₁₃', 'I₂₃'].map((title, i) => ({ title, unit: i === 0 ? 'kg' : i < 4 ? 'mm' : 'kg m²', number: true }))],
      rows: ['hub', 'cmg1.gimbal', 'cmg1.wheel', 'panel1', 'slosh', 'whole spacecraft'].map((name, i) => ({ state: '', cells: [word(name), ...[810 / (1 + 20 * i), 0.1 * i, -0.25 * i, 12.5, 900 / (1 + i), 810 / (1 + i), 640 / (1 + i), 1.25e-3, -2.5e-3, 0].map((v) => number(v.toPrecision(5).replace('-', '\u2212')))] })),
    }] },
    { id: 'loads', title: 'Joint torques and loads', blocks: [
      { kind: 'table', caption: 'Largest motor torques and loads across joints',
        columns: ['Joint', 'Motor torque', 'Force', 'Moment'].map((title, i) => ({ title, unit: ['', 'N m', 'N', 'N m'][i], number: i > 0 })),
        rows: [1, 2, 3, 4].flatMap((i) => ['gimbal', 'wheel'].map((part) => ({ state: '', cells: [word(`cmg${i}.${part}`), number((0.2 * i).toFixed(3)), number((15 - i).toFixed(2)), number((2 + i).toFixed(2))] }))) },
      figure(7, 'Magnitude of the force on the mount of cmg1.'),
    ] },
    { id: 'warnings', title: 'Warnings', blocks: [{ kind: 'list', style: 'warnings', items: [
      'The largest principal moment of the wheel of cmg3 exceeds the sum of the other two by 1.0×10⁻⁴ kg m²; no mass distribution has this inertia. It is run as given.',
      'The panels are rigid plates; their first bending mode is not part of the model.' ] }] },
    { id: 'scenario', title: 'Scenario as it was read', blocks: [
      { kind: 'note', text: 'Lines in italics were not in the file: they are defaults.' },
      { kind: 'scenario', lines: [
        ['[run]', false], ['duration = 10.0        # s', false], ['tolerance = 1e-13', true], ['', false], ['[hub]', false],
        ['mass = 810.0           # kg', false], ['centre = [0.0, 0.0, 0.0]  # m <in B> & "as built"', true],
        ['', false], ['[[device]]', false], ['kind = "vscmg"', false], ['name = "cmg1"', false], ['friction = 0.0', true],
      ].map(([text, filled]) => ({ text, filled })) },
    ] },
  ];
}

/** The data block, before it is written as JSON. */
export function sampleData() {
  const all = columns();
  return {
    format: 1, name: 'sample', title: 'Pyramid of four gyros: slew with a locked gimbal',
    time: f64(Array.from({ length: BUCKETS }, (_, k) => (k * END) / BUCKETS)), end: END,
    columns: all, charts: CHARTS,
    events: [{ time: 1.5, text: 'gimbal of cmg2 locked' }, { time: 4, text: 'gimbal torques off' }],
    replay: {
      hub: { size: [1.4, 1.2, 1.3], centre: [0, 0, 0] }, joints: joints(),
      windows: [windowOf('whole run', 0, END, 1001, 1), windowOf('slow motion about 5 s', 5, 5.06, 601, 100000)],
    },
  };
}

/** What the template is filled with, except script, style and their hashes. */
export function sampleContext(data) {
  return {
    title: data.title, name: data.name, subject: 'report of a run',
    verdict: { state: 'violated', word: 'One of three requirements is violated:', text: 'the body rate reaches 5.64 deg/s at 0.00 s, above its limit of 5.00 deg/s.' },
    summary: {
      paragraphs: ['A rigid hub of 810 kg with four single-gimbal gyros in a pyramid, two panels and one slosh mass, over 10 s.'],
      facts: [['Duration', '10 s'], ['Largest |ω|', '5.64 deg/s'], ['Jitter |δω|', '0.0286 deg/s'], ['Drift of energy less work', '1.2×10⁻¹⁴'], ['Steps accepted, rejected', '4812, 7'], ['Tolerance', '10⁻¹³']]
        .map(([name, value]) => ({ name, value })),
    },
    sections: sections(data.columns),
    made: 'Written by precess 0.1.0. This page holds everything it shows and fetches nothing.',
    data: JSON.stringify(data).replaceAll('<', '\\u003c'),
  };
}
