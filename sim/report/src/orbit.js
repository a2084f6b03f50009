// The point of view: turned by dragging, by one finger sideways, by two fingers, by the arrow keys;
// nearer and farther by plus and minus, by two fingers, by the wheel while the drawing has the focus.

const TURN = Math.PI / 36;
const NEARER = 1.15;
const HIGHEST = Math.PI / 2 - 0.02;

/** Turns `camera` about the origin; `changed` is called after each change. */
export function createOrbit(canvas, camera, reach, changed) {
  const start = { azimuth: -0.9, elevation: 0.45, distance: 3.1 * reach };
  let view = { ...start };

  function place() {
    const { azimuth, elevation, distance } = view;
    const flat = Math.cos(elevation) * distance;
    camera.position.set(flat * Math.cos(azimuth), flat * Math.sin(azimuth), distance * Math.sin(elevation));
    camera.lookAt(0, 0, 0);
    changed();
  }

  function turn(azimuth, elevation) {
    view.azimuth += azimuth;
    view.elevation = Math.min(Math.max(view.elevation + elevation, -HIGHEST), HIGHEST);
    place();
  }

  function zoom(factor) {
    view.distance = Math.min(Math.max(view.distance / factor, 0.4 * reach), 12 * reach);
    place();
  }

  const pointers = new Map();
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  canvas.addEventListener('pointerdown', (event) => {
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener('pointermove', (event) => {
    const before = pointers.get(event.pointerId);
    if (before === undefined) return;
    const share = Math.PI / Math.max(canvas.clientHeight, 1) / pointers.size;
    const apart = pointers.size === 2 ? spread() : 0;
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    turn(-(event.clientX - before.x) * share, (event.clientY - before.y) * share);
    if (pointers.size === 2 && apart > 0) zoom(spread() / apart);
  });
  const forget = (event) => pointers.delete(event.pointerId);
  canvas.addEventListener('pointerup', forget);
  canvas.addEventListener('pointercancel', forget);
  canvas.addEventListener('wheel', (event) => {
    // Without the focus, the wheel scrolls the page.
    if (document.activeElement !== canvas) return;
    event.preventDefault();
    zoom(event.deltaY < 0 ? NEARER : 1 / NEARER);
  }, { passive: false });

  const keys = {
    ArrowLeft: () => turn(-TURN, 0),
    ArrowRight: () => turn(TURN, 0),
    ArrowUp: () => turn(0, TURN),
    ArrowDown: () => turn(0, -TURN),
    '+': () => zoom(NEARER),
    '=': () => zoom(NEARER),
    '-': () => zoom(1 / NEARER),
    0: () => {
      view = { ...start };
      place();
    },
  };
  canvas.addEventListener('keydown', (event) => {
    const action = keys[event.key];
    if (action === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    action();
  });
  place();
  return { reset: keys[0] };
}
