// Light or dark: as the system asks, or as the button says.

/** Puts the button into its place and returns { dark(), onChange(listener) }. */
export function createTheme(place) {
  const root = document.documentElement;
  const system = window.matchMedia('(prefers-color-scheme: dark)');
  const listeners = [];
  const dark = () => (root.dataset.theme ? root.dataset.theme === 'dark' : system.matches);

  const button = document.createElement('button');
  button.type = 'button';
  button.className = 'theme';
  const update = () => {
    button.textContent = dark() ? 'Light colours' : 'Dark colours';
    listeners.forEach((listener) => listener());
  };
  button.addEventListener('click', () => {
    root.dataset.theme = dark() ? 'light' : 'dark';
    update();
  });
  system.addEventListener('change', update);
  place.append(button);
  update();
  return { dark, onChange: (listener) => listeners.push(listener) };
}
