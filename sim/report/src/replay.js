// The replay: the drawing, its controls, and what they say.

import { PerspectiveCamera, WebGLRenderer } from 'three';
import { element, oncePerFrame, spoken } from './dom.js';
import { duration, instant, niceAbove, number, plain } from './format.js';
import { createMotion } from './motion.js';
import { createOrbit } from './orbit.js';
import { BODIES, surface } from './palette.js';
import { createScene } from './scene.js';

const MISSING = 'This browser offers no WebGL, so the replay is not drawn. Everything else on this page works.';
/** Seconds of the run that one second shows, as multiples of the choice a window starts with. */
const SPEEDS = [0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10];
/** With reduced motion: still pictures per second. */
const STILLS = 2;
const RATIO = { wide: 16 / 9, narrow: 1 };

const NAMES = { ring: 'gimbal', wheel: 'wheel', plate: 'panel', ball: 'slosh mass' };

function key(colour, text, shape = 'patch') {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('width', '18');
  svg.setAttribute('height', '10');
  svg.setAttribute('aria-hidden', 'true');
  const path = document.createElementNS('http://www.w3.org/2000/svg', 'path');
  path.setAttribute('d', shape === 'arrow' ? 'M0 4H11V1L18 5L11 9V6H0Z' : 'M2 0H16V10H2Z');
  path.setAttribute('fill', colour);
  svg.append(path);
  return element('li', {}, svg, ' ', text);
}

/** What the parts of the drawing are. */
function partsOf(replay) {
  const items = [key(BODIES.hub, 'hub')];
  for (const [shape, name] of Object.entries(NAMES)) {
    if (replay.joints.some(({ body }) => body && body.shape === shape)) items.push(key(BODIES[shape], name));
  }
  if (replay.joints.some(({ body }) => body && body.heavy)) items.push(key(BODIES.heavy, 'heavy spot'));
  const momentum = element('span');
  const omega = element('span');
  items.push(key(BODIES.momentum, momentum, 'arrow'), key(BODIES.omega, omega, 'arrow'));
  return { list: element('ul', { class: 'keys' }, ...items), momentum, omega };
}

/** The seconds of a window that one second shows at first. */
function usualSpeed(motion, slow) {
  const length = motion.end - motion.start;
  if (!slow && length <= 60) return 1;
  return niceAbove(Math.max(length, 1e-12) / (slow ? 12 : 30));
}

function context(canvas) {
  try {
    return canvas.getContext('webgl2', { antialias: true, alpha: false });
  } catch {
    return null;
  }
}

/** Fills the element that the page keeps for the replay. */
export function createReplay(place, report, cursor, theme) {
  const { replay } = report;
  if (place === null || !replay || replay.windows.length === 0) return null;
  const canvas = element('canvas', {
    tabindex: '0',
    role: 'img',
    'aria-label': `Drawing of the spacecraft ${spoken(report.name)} in motion. Arrow keys turn the view, plus and minus bring it nearer or farther, 0 restores it.`,
  });
  const gl = context(canvas);
  if (gl === null) {
    place.append(element('p', { class: 'note replay-missing' }, MISSING));
    return null;
  }
  const motions = replay.windows.map((window) => createMotion(window, replay.joints.length));
  const drawing = createScene(replay);
  const renderer = new WebGLRenderer({ canvas, context: gl, antialias: true });
  const camera = new PerspectiveCamera(35, RATIO.wide, 0.01 * drawing.reach, 40 * drawing.reach);
  camera.up.set(0, 0, 1);

  const calm = window.matchMedia('(prefers-reduced-motion: reduce)');
  let chosen = 0;
  let motion = motions[0];
  let perMomentum = 0;
  let perOmega = 0;
  let scale = 1;
  let playing = null;
  // An instant finer than the shared cursor's listeners need: the replay's own time is the cursor's.
  const now = () => cursor.state.at;

  const play = element('button', { type: 'button', class: 'play' });
  const slider = element('input', { type: 'range', min: '0', max: '10000', step: '1', 'aria-label': 'Time in the window' });
  const windows = element('select', {}, ...replay.windows.map(({ label }, i) => element('option', { value: String(i) }, label)));
  const speeds = element('select');
  const parts = partsOf(replay);
  const reading = element('output', { class: 'reading' });
  const statement = element('p', { class: 'statement' });
  const reset = element('button', { type: 'button' }, 'Reset view');
  const stage = element('div', { class: 'stage' }, canvas, statement);
  place.append(
    stage,
    element('div', { class: 'controls' }, play, slider,
      element('label', {}, 'Window ', windows), element('label', {}, 'Speed ', speeds), reset),
    reading, parts.list,
    element('p', { class: 'note screen' },
      'Drag to turn the view; on a touch screen, one finger sideways turns it and two fingers turn and enlarge it. '
      + 'With the focus on the drawing, arrow keys turn the view, plus, minus and the mouse wheel bring it '
      + 'nearer or farther, 0 restores it. The slider is the cursor of the charts. Shapes are schematic, '
      + 'the positions of joints and centres of mass are to scale; the drawing shows attitude, not the motion of B along its path.'),
  );

  const draw = oncePerFrame(() => {
    const state = motion.at(now());
    drawing.show(state, perMomentum, perOmega);
    renderer.render(drawing.scene, camera);
    tell(state);
  });

  function tell(state) {
    const span = motion.end - motion.start;
    const share = span > 0 ? (state.time - motion.start) / span : 0;
    slider.value = String(Math.round(share * 10000));
    const step = Math.max(span, 1e-9) / 1000;
    slider.setAttribute('aria-valuetext', `${instant(state.time, step)} s`);
    const degrees = (Math.hypot(...state.omega) * 180) / Math.PI;
    const outside = now() < motion.start || now() > motion.end;
    // A wheel that turns more than half a turn between pictures seems to stand or to run backwards.
    const fastest = Math.max(0, ...state.rate.map((rate, i) => (replay.joints[i].slides ? 0 : Math.abs(rate))));
    const jumps = playing !== null && (fastest * scale) / 60 > Math.PI / 3;
    reading.replaceChildren(...[
      `t = ${instant(state.time, step)} s`,
      `|ω| = ${number(degrees, 4)} deg/s`,
      `|H| = ${number(Math.hypot(...state.momentum), 4)} N m s`,
      outside ? 'the cursor is outside this window' : '',
      jumps ? 'wheels turn too fast for their marks to be followed at this speed' : '',
    ].filter((text) => text !== '').map((text) => element('span', {}, text)));
  }

  /** Magnification and time scale, on the drawing. */
  function declare() {
    const texts = [`1 s shows ${duration(scale)}${scale === 1 ? ' (real time)' : ''}`];
    if (motion.magnify !== 1) {
      texts.unshift(`deviation × ${plain(motion.magnify)}`);
      texts.push(`largest deviation ${number(motion.deviation, 3)} rad from the smooth motion`);
    }
    if (calm.matches) texts.push('reduced motion: two still pictures a second');
    statement.replaceChildren(...texts.map((text) => element('span', {}, text)));
  }

  function choose(index) {
    chosen = index;
    motion = motions[index];
    const slow = motion.magnify !== 1 || (index > 0 && motion.end - motion.start < 0.2 * (cursor.whole[1] - cursor.whole[0]));
    const usual = usualSpeed(motion, slow);
    speeds.replaceChildren(...SPEEDS.map((factor) => {
      const value = factor * usual;
      const real = Math.abs(value - 1) < 1e-9 ? ' (real time)' : '';
      return element('option', { value: String(value), selected: factor === 1 }, `1 s shows ${duration(value)}${real}`);
    }));
    scale = usual;
    perMomentum = motion.largestMomentum > 0 ? drawing.longest / motion.largestMomentum : 0;
    perOmega = motion.largestOmega > 0 ? drawing.longest / motion.largestOmega : 0;
    parts.momentum.textContent = perMomentum > 0 ? `angular momentum H, 1 m for ${number(1 / perMomentum, 3)} N m s` : 'angular momentum H: zero';
    parts.omega.textContent = perOmega > 0 ? `angular velocity ω, 1 m for ${number(180 / Math.PI / perOmega, 3)} deg/s` : 'angular velocity ω: zero';
    declare();
    draw();
  }

  function pause() {
    if (playing !== null) cancelAnimationFrame(playing.request);
    playing = null;
    play.textContent = 'Play';
    draw();
  }

  function start() {
    if (now() < motion.start || now() >= motion.end) cursor.moveTo(motion.start);
    playing = { request: 0, from: now(), since: performance.now(), still: 0 };
    play.textContent = 'Pause';
    playing.request = requestAnimationFrame(advance);
  }

  function advance(clock) {
    if (playing === null) return;
    playing.request = requestAnimationFrame(advance);
    // Someone else moved the cursor: go on from there.
    if (playing.set !== undefined && now() !== playing.set) {
      playing.from = now();
      playing.since = clock;
    }
    const elapsed = Math.max(0, clock - playing.since) / 1000;
    const shown = calm.matches ? Math.floor(elapsed * STILLS) / STILLS : elapsed;
    const time = playing.from + shown * scale;
    if (time >= motion.end || now() < motion.start) {
      cursor.moveTo(motion.end);
      pause();
      return;
    }
    cursor.moveTo(time);
    playing.set = now();
  }

  play.addEventListener('click', () => (playing === null ? start() : pause()));
  slider.addEventListener('input', () => {
    cursor.moveTo(motion.start + (Number(slider.value) / 10000) * (motion.end - motion.start));
  });
  windows.addEventListener('change', () => {
    pause();
    choose(Number(windows.value));
    if (now() < motion.start || now() > motion.end) cursor.moveTo(motion.start);
  });
  speeds.addEventListener('change', () => {
    scale = Number(speeds.value);
    if (playing !== null) {
      playing.from = now();
      playing.since = performance.now();
    }
    declare();
  });
  canvas.addEventListener('webglcontextlost', (event) => {
    event.preventDefault();
    pause();
    statement.replaceChildren(element('span', {}, 'The browser has taken WebGL away from this page; reload it for the replay.'));
  });
  cursor.onMove(draw);

  const colours = () => {
    const { paper, ink } = surface(theme.dark());
    renderer.setClearColor(paper);
    drawing.setInk(ink);
    draw();
  };
  theme.onChange(colours);
  const orbit = createOrbit(canvas, camera, drawing.reach, draw);
  reset.addEventListener('click', () => orbit.reset());
  new ResizeObserver(() => {
    const width = stage.clientWidth;
    if (width === 0) return;
    const height = Math.round(width / (width < 600 ? RATIO.narrow : RATIO.wide));
    const limited = Math.min(height, 560);
    renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    renderer.setSize(width, limited, true);
    camera.aspect = width / limited;
    camera.updateProjectionMatrix();
    draw();
  }).observe(stage);

  pause();
  choose(chosen);
  colours();
  return { choose };
}
