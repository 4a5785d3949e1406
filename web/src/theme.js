// The page's colours, as report.css gives them, and a call when they change between light and dark.

const dark = window.matchMedia("(prefers-color-scheme: dark)");

export function color(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

/** The colour of the n-th curve of a plot. */
export function curveColor(curves, number) {
  return color(curves[number].truth ? "true" : `s${number % 8}`);
}

export function isDark() {
  return dark.matches;
}

export function onThemeChange(listener) {
  dark.addEventListener("change", listener);
}
