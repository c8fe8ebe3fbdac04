// Colours. All pairs that matter differ in lightness too, or in form: hatching, dashes, width.
import type { Rgb } from './layer.ts';

const hex = (text: string): Rgb => [
  Number.parseInt(text.slice(1, 3), 16),
  Number.parseInt(text.slice(3, 5), 16),
  Number.parseInt(text.slice(5, 7), 16),
];

/** P. Tol's "muted" scheme and three of Okabe and Ito's: told apart with every kind of colour vision. */
export const cellPalette: readonly Rgb[] = [
  '#88ccee',
  '#ddcc77',
  '#cc6677',
  '#44aa99',
  '#e69f00',
  '#aa4499',
  '#117733',
  '#f0e442',
  '#6699cc',
  '#999933',
  '#d55e00',
  '#bbbbcc',
].map(hex);

/** End, side, corner, reversal (paper 2.4), in Okabe and Ito's colours. */
export const featurePalette: readonly Rgb[] = ['#0072b2', '#8a8f98', '#d55e00', '#cc79a7'].map(hex);

export const hardRed = hex('#d8372a');
export const softBlue = hex('#2f6fdf');
export const softLight = hex('#b9d2ff');
export const magenta = hex('#e6007e');

export interface Theme {
  paper: Rgb;
  ink: Rgb;
  accent: Rgb;
  facet: Rgb;
  line: Rgb;
  simplex: Rgb;
}

export const themes: Record<'light' | 'dark', Theme> = {
  light: {
    paper: hex('#f4f6f9'),
    ink: hex('#1d2733'),
    accent: hex('#ff9f1a'),
    facet: hex('#c9d6e4'),
    line: hex('#2c3846'),
    simplex: hex('#dbe5ee'),
  },
  dark: {
    paper: hex('#12171e'),
    ink: hex('#0a0e13'),
    accent: hex('#ffb547'),
    facet: hex('#6f88a3'),
    line: hex('#b4c1cf'),
    simplex: hex('#8ea3b8'),
  },
};

/** A hue per number: the first ones from the palette, all others by turning through the colour circle. */
export function distinct(k: number): Rgb {
  const chosen = cellPalette[k];
  if (chosen) return chosen;
  const hue = (k * 137.508) % 360;
  return fromHsl(hue, 0.5, k % 2 ? 0.5 : 0.68);
}

function fromHsl(h: number, s: number, l: number): Rgb {
  const f = (n: number): number => {
    const k = (n + h / 30) % 12;
    return Math.round(255 * (l - s * Math.min(l, 1 - l) * Math.max(-1, Math.min(k - 3, 9 - k, 1))));
  };
  return [f(0), f(8), f(4)];
}

/** C. Brewer's RdYlBu of eleven colours; diverging, and safe for red-green blindness. */
const redYellowBlue = [
  '#a50026',
  '#d73027',
  '#f46d43',
  '#fdae61',
  '#fee090',
  '#ffffbf',
  '#e0f3f8',
  '#abd9e9',
  '#74add1',
  '#4575b4',
  '#313695',
].map(hex);

/** A scaled Jacobian from 0 (red) over yellow to 1 (blue); dark red at and below 0. */
export function qualityColour(q: number): Rgb {
  if (q <= 0) return hex('#7a0b1e');
  const t = 10 * (0.08 + 0.8 * Math.min(1, q));
  const k = Math.floor(t);
  return mix(redYellowBlue[k]!, redYellowBlue[k + 1]!, t - k);
}

export const cssColour = ([r, g, b]: Rgb): string => `rgb(${r} ${g} ${b})`;
export const mix = (a: Rgb, b: Rgb, t: number): Rgb => [
  Math.round(a[0] + t * (b[0] - a[0])),
  Math.round(a[1] + t * (b[1] - a[1])),
  Math.round(a[2] + t * (b[2] - a[2])),
];
