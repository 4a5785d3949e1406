// The page's colours, as report.css gives them, and a call when they change between light and dark.

const dark = window.matchMedia("(prefers-color-scheme: dark)");

export function color(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

export function curveColor(number) {
  return color(`s${number % 8}`);
}

export function isDark() {
  return dark.matches;
}

export function onThemeChange(listener) {
  dark.addEventListener("change", listener);
}
