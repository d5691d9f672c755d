// SPDX-License-Identifier: BSD-3-Clause
// Colours that canvases need, for light and dark.

const kDark = matchMedia('(prefers-color-scheme: dark)');

// Chosen to be told apart by colour-blind people too, and of enough contrast on either ground.
const kLines = {
  light: ['#1f6fb2', '#c2410c', '#0f7b5f', '#7a3fa8', '#a16207', '#be185d'],
  dark: ['#64b0f0', '#fb923c', '#4ad6a7', '#c59bf0', '#e3c14d', '#f47fb4'],
};

export const isDark = () => kDark.matches;
export const onThemeChange = (listener) => kDark.addEventListener('change', listener);
export const lineColours = () => (isDark() ? kLines.dark : kLines.light);
export const cssColour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

const kStops = [[68, 1, 84], [65, 68, 135], [42, 120, 142], [34, 168, 132], [122, 209, 81], [253, 231, 37]];

/** From dark (certain) to bright (uncertain), as in the files that disflow_track writes; 0..255. */
export function mapColour(share) {
  const position = Math.min(Math.max(share, 0), 1) * (kStops.length - 1);
  const below = Math.min(Math.floor(position), kStops.length - 2);
  const weight = position - below;
  return kStops[below].map((value, i) => value + weight * (kStops[below + 1][i] - value));
}
