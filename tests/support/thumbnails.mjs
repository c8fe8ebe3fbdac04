// Draws web/src/thumbnails.svg, the gallery's pictures of the examples: node tests/support/thumbnails.mjs
// A symbol per example: its blocks' boundary (figure 12: triangles and contributions), in shades of the page's colour.
import { writeFileSync } from 'node:fs';
import { backToFront, cross, dot, normalOf } from './bsp.mjs';
import { exampleRunner, examples } from './run-example.mjs';

const size = { width: 64, height: 48, margin: 3 };
const eye = (() => {
  const v = [0.55, -1, 0.6];
  const length = Math.hypot(...v);
  return v.map((x) => x / length);
})();
const right = ((v) => v.map((x) => x / Math.hypot(...v)))(cross([0, 0, 1], eye));
const up = cross(eye, right);
const rowsOf = (array, width) =>
  Array.from({ length: array.length / width }, (_, k) =>
    Array.from(array.subarray(k * width, (k + 1) * width)),
  );

function fit(points) {
  const range = (k) => [Math.min(...points.map((p) => p[k])), Math.max(...points.map((p) => p[k]))];
  const [x0, x1] = range(0);
  const [y0, y1] = range(1);
  const scale = Math.min(
    (size.width - 2 * size.margin) / (x1 - x0),
    (size.height - 2 * size.margin) / (y1 - y0),
  );
  return ([x, y]) => [
    Math.round(10 * (size.width / 2 + scale * (x - (x0 + x1) / 2))) / 10,
    Math.round(10 * (size.height / 2 - scale * (y - (y0 + y1) / 2))) / 10,
  ];
}

const path = (points, close = true) => `M${points.map((p) => p.join(' ')).join('L')}${close ? 'z' : ''}`;
const face = (points, shade) => `<path d="${path(points)}" fill-opacity="${shade}"/>`;

/** The face itself, or two triangles where it is not flat. */
function planar(quad) {
  const [a, b, c, d] = quad;
  const minus = (p, q) => p.map((x, k) => x - q[k]);
  const height = dot(normalOf([a, b, c]), minus(d, a));
  return Math.abs(height) < 1e-9
    ? [quad]
    : [
        [a, b, c],
        [a, c, d],
      ];
}

function solid({ primal }) {
  const nodes = rowsOf(primal.positions, 3);
  const pieces = rowsOf(primal.boundaryFaces, 4)
    .map((quad) => quad.map((v) => nodes[v]))
    .flatMap(planar)
    .map((points) => ({ points, normal: normalOf(points), drawn: points.map(() => true) }))
    .filter(({ normal }) => dot(normal, eye) > 1e-6);
  const flat = (p) => [dot(p, right), dot(p, up)];
  const place = fit(nodes.map(flat));
  const light = (n) => 0.25 + 0.5 * Math.max(0, dot(n, eye)) + 0.25 * Math.max(0, dot(n, up));
  return backToFront(pieces, eye)
    .map(({ points, normal }) => {
      const outline = path(points.map(flat).map(place));
      return `<path class="p" d="${outline}"/><path d="${outline}" fill-opacity="${(1 - light(normal)).toFixed(2)}"/>`;
    })
    .join('');
}

function plane({ primal, reference, onlyMatching, contributions }) {
  const nodes = rowsOf(onlyMatching ? reference.nodes : primal.positions, 2);
  const place = fit(nodes);
  const cells = rowsOf(onlyMatching ? reference.simplices : primal.blocks, onlyMatching ? 3 : 4);
  const fills = cells
    .map((cell) =>
      face(
        cell.map((v) => place(nodes[v])),
        0.16,
      ),
    )
    .join('');
  if (!onlyMatching) return fills;
  const lines = cells.flatMap((cell, s) => {
    const out = [];
    for (let k = contributions.offsets[s]; k < contributions.offsets[s + 1]; k++) {
      const mask = contributions.mask[k];
      const inside = cell.filter((_, v) => (mask >> v) & 1);
      const outside = cell.filter((_, v) => !((mask >> v) & 1));
      const ends = inside.flatMap((a) =>
        outside.map((b) => place(nodes[a].map((x, d) => 0.75 * x + 0.25 * nodes[b][d]))),
      );
      const soft = (contributions.soft[s] >> mask) & 1;
      out.push(`<path class="${soft ? 's' : 'h'}" d="${path(ends, false)}"/>`);
    }
    return out;
  });
  return fills + lines.join('');
}

const run = await exampleRunner();
const symbols = examples.map(({ name }) => {
  const result = run(name);
  const drawing = result.dimension === 3 ? solid(result) : plane(result);
  return `<symbol id="${name}" viewBox="0 0 ${size.width} ${size.height}">${drawing}</symbol>`;
});
const style =
  'path{fill:currentColor;stroke:currentColor;stroke-width:.6;stroke-linejoin:round}.p{fill:var(--thumb,#fff);stroke:none}.h,.s{fill:none;stroke:#d8372a;stroke-width:1.6}.s{stroke:#2f6fdf;stroke-dasharray:2 1.5}';
const svg = `<svg xmlns="http://www.w3.org/2000/svg"><style>${style}</style>\n${symbols.join('\n')}\n</svg>\n`;
writeFileSync(new URL('../../web/src/thumbnails.svg', import.meta.url), svg);
console.log(`web/src/thumbnails.svg: ${(svg.length / 1000).toFixed(1)} kB`);
