// Light or dark: as the system says until the reader says otherwise. Figures on canvases are drawn again on a change
// of colours or size.
const drawers = [];

export function drawn(draw) {
  drawers.push(draw);
}

export function onThemeChange() {
  for (const draw of drawers) draw();
}

export function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

export function isDark() {
  const chosen = document.documentElement.dataset.theme;
  return chosen ? chosen === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
}

export function toggleTheme() {
  document.documentElement.dataset.theme = isDark() ? 'light' : 'dark';
  onThemeChange();
}

matchMedia('(prefers-color-scheme: dark)').addEventListener('change', onThemeChange);
// paper is white whatever the screen was
let before;
window.addEventListener('beforeprint', () => {
  before = document.documentElement.dataset.theme;
  document.documentElement.dataset.theme = 'light';
  onThemeChange();
});
window.addEventListener('afterprint', () => {
  if (before) document.documentElement.dataset.theme = before;
  else delete document.documentElement.dataset.theme;
  onThemeChange();
});
let waiting = 0;
window.addEventListener('resize', () => {
  cancelAnimationFrame(waiting);
  waiting = requestAnimationFrame(onThemeChange);
});
