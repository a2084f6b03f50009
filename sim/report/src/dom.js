// Elements by name, with attributes and children.

/** A new element. */
export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === false || value === null) continue;
    made.setAttribute(key, value === true ? '' : value);
  }
  made.append(...children);
  return made;
}

/** A label such as ω_x or ω_{x,1} with its index as a subscript. */
export function symbol(label) {
  const fragment = document.createDocumentFragment();
  const pattern = /_(?:\{([^}]*)\}|([^\s_,;:()]+))/g;
  let at = 0;
  for (const match of label.matchAll(pattern)) {
    fragment.append(label.slice(at, match.index), element('sub', {}, match[1] ?? match[2]));
    at = match.index + match[0].length;
  }
  fragment.append(label.slice(at));
  return fragment;
}

/** The same label as plain words, for a screen reader. */
export function spoken(label) {
  return label.replace(/[_{}]+/g, ' ').trim();
}

/** Calls a function once per picture of the screen, however often it is asked for. */
export function oncePerFrame(action) {
  let asked = false;
  return () => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      action();
    });
  };
}
