// Draws public/overview.svg, the README's picture: node tests/support/picture.mjs
// Per example: the reference mesh, its local dual contributions (hard red, soft blue), and the block mesh in the
// colours of its parts. The same core gives the same bytes.
import { writeFileSync } from 'node:fs';
import { backToFront, cross, dot, minus, normalOf } from './bsp.mjs';
import { exampleRunner, examples } from './run-example.mjs';

// Each example and where it is seen from, in degrees about the vertical axis.
const rows = [
  ['tapered_brick', 28],
  ['extruded_pentagon', 240],
  ['protrusion', 28],
];
const elevation = 24;
const cell = { width: 288, height: 244 };
const inset = { side: 20, top: 32, bottom: 36 };
const margin = { left: 16, top: 52, right: 16, bottom: 14 };
const gap = 12;

const kHard = '#e2483d';
const kSoft = '#2f6be0';
const kInk = '#1f2d3d';
// Tableau's ten, which stay apart for most colour-blind eyes.
const kParts = '#5b93cf #f28e2b #76b7b2 #edc948 #b07aa1 #6bb05f #e36a6a #a9826b #ff9da7 #a9b1ba'.split(' ');

const add = (a, b) => a.map((x, k) => x + b[k]);
const times = (s, a) => a.map((x) => s * x);
const unit = (a) => times(1 / Math.hypot(...a), a);
const mean = (points) => times(1 / points.length, points.reduce(add));
const rowsOf = (array, width) =>
  Array.from({ length: array.length / width }, (_, k) =>
    Array.from(array.subarray(k * width, (k + 1) * width)),
  );

/** The screen's axes: right, up, and towards the eye. */
function cameraOf(degrees) {
  const [a, e] = [degrees, elevation].map((d) => (d * Math.PI) / 180);
  const eye = [Math.cos(e) * Math.sin(a), -Math.cos(e) * Math.cos(a), Math.sin(e)];
  const right = unit(cross([0, 0, 1], eye));
  return { eye, right, up: cross(eye, right) };
}

/** A colour made darker (factor under 1) or lighter (over 1). */
function shade(colour, factor) {
  const channel = (k) => {
    const x = Number.parseInt(colour.slice(1 + 2 * k, 3 + 2 * k), 16);
    const y = factor <= 1 ? x * factor : x + (255 - x) * (factor - 1);
    return Math.round(Math.min(255, y)).toString(16).padStart(2, '0');
  };
  return `#${channel(0)}${channel(1)}${channel(2)}`;
}

/** Light from the upper left, behind the eye; both faces of a sheet are lit. */
function light(normal, camera) {
  const source = unit(add(add(times(-0.45, camera.right), times(0.75, camera.up)), times(0.8, camera.eye)));
  const towardsEye = dot(normal, camera.eye) < 0 ? times(-1, normal) : normal;
  return 0.7 + 0.45 * Math.max(0, dot(towardsEye, source));
}

const polygon = (points, style) => ({
  points,
  drawn: points.map(() => true),
  normal: normalOf(points),
  ...style,
});
const segment = (a, b, style) => ({ points: [a, b], drawn: [true, true], ...style });

/** Points scaled into a unit sphere about the origin, so that tolerances and strokes suit every example. */
function fitted(positions, reference) {
  const low = [0, 1, 2].map((k) => Math.min(...reference.map((p) => p[k])));
  const high = [0, 1, 2].map((k) => Math.max(...reference.map((p) => p[k])));
  const centre = times(0.5, add(low, high));
  const radius = Math.hypot(...minus(high, low)) / 2;
  return positions.map((p) => times(1 / radius, minus(p, centre)));
}

/** The domain's feature curves as segments. */
function featureLines({ features }, place, style) {
  const nodes = place(rowsOf(features.nodes, 3));
  return rowsOf(features.ridgeNodes, 2).map(([a, b]) => segment(nodes[a], nodes[b], style));
}

/** Boundary triangles as glass, all edges of tetrahedra as lines: those inside thin. */
function referencePieces(result, place) {
  const nodes = place(rowsOf(result.reference.nodes, 3));
  const simplices = rowsOf(result.reference.simplices, 4);
  const neighbors = rowsOf(result.reference.neighbors, 4);
  const edges = new Map();
  const pieces = [];
  simplices.forEach((s, k) => {
    for (let i = 0; i < 4; i++) {
      const face = s.filter((_, v) => v !== i);
      const isOuter = neighbors[k][i] < 0;
      if (isOuter)
        pieces.push({
          ...polygon(
            face.map((v) => nodes[v]),
            {},
          ),
          drawn: [false, false, false],
        });
      face.forEach((a, m) => {
        const b = face[(m + 1) % 3];
        const key = a < b ? `${a} ${b}` : `${b} ${a}`;
        edges.set(key, { a: nodes[a], b: nodes[b], isOuter: isOuter || (edges.get(key)?.isOuter ?? false) });
      });
    }
  });
  for (const { a, b, isOuter } of edges.values())
    pieces.push(segment(a, b, { line: isOuter ? 'outer' : 'inner' }));
  return [...pieces, ...featureLines(result, place, { line: 'curve' })];
}

/** The polygons of the paper's section 4.1: barycentric coordinates of a mask's vertices add up to 4/5. */
function contributionPieces(result, place) {
  const near = 4 / 5;
  const { offsets, mask, soft } = result.contributions;
  const nodes = place(rowsOf(result.reference.nodes, 3));
  const pieces = [];
  rowsOf(result.reference.simplices, 4).forEach((s, k) => {
    const masks = new Set(mask.subarray(offsets[k], offsets[k + 1]));
    for (const m of masks) {
      const inside = s.filter((_, v) => (m >> v) & 1);
      const outside = s.filter((_, v) => !((m >> v) & 1));
      const at = (a, b) => nodes[a].map((x, axis) => near * x + (1 - near) * nodes[b][axis]);
      const points = inside.flatMap((a, n) => {
        const ends = outside.map((b) => at(a, b));
        return n % 2 === 1 ? ends.reverse() : ends; // around the quadrilateral
      });
      const kind = (soft[k] >> m) & 1 ? { fill: kSoft, line: 'soft' } : { fill: kHard, line: 'hard' };
      pieces.push(polygon(points, { ...kind, lit: true }));
    }
  });
  return [...pieces, ...featureLines(result, place, { line: 'frame' })];
}

const kFaces = [
  [0, 4, 7, 3],
  [1, 2, 6, 5],
  [0, 1, 5, 4],
  [3, 7, 6, 2],
  [0, 3, 2, 1],
  [4, 5, 6, 7],
];

/** Blocks, shrunk about their centres and moved apart part by part; bent faces as two triangles. */
function blockPieces(result, place) {
  const nodes = place(rowsOf(result.primal.positions, 3));
  const blocks = rowsOf(result.primal.blocks, 8);
  const partPoints = Array.from({ length: result.parts.count }, () => []);
  blocks.forEach((b, k) => {
    partPoints[result.primal.blockPart[k]].push(...b.map((v) => nodes[v]));
  });
  const partShift = partPoints.map((points) => times(0.1, mean(points)));
  return blocks.flatMap((b, k) => {
    const part = result.primal.blockPart[k];
    const corners = b.map((v) => nodes[v]);
    const centre = mean(corners);
    const shown = corners.map((x) => add(add(centre, times(0.9, minus(x, centre))), partShift[part]));
    return kFaces.flatMap((face) => {
      const cycle = face.map((v) => shown[v]);
      const style = { fill: kParts[part % kParts.length], line: 'block', lit: true };
      const whole = polygon(cycle, style);
      if (Math.abs(dot(whole.normal, minus(cycle[1], cycle[0]))) < 1e-9) return [whole];
      const [p, q, r, s] = cycle; // bent: two triangles, lit alike
      return [
        { ...polygon([p, q, r], style), drawn: [true, true, false], lighting: whole.normal },
        { ...polygon([p, r, s], style), drawn: [false, true, true], lighting: whole.normal },
      ];
    });
  });
}

/** Whether each convex polygon of the list, far to near, shows at least one point of a grid. */
function visible(polygons) {
  const perUnit = 4;
  const size = perUnit * Math.max(cell.width, cell.height);
  const top = new Int32Array(size * size).fill(-1);
  polygons.forEach((points, id) => {
    const ys = points.map(([, y]) => y * perUnit);
    for (let row = Math.ceil(Math.min(...ys)); row <= Math.max(...ys); row++) {
      let [from, to] = [Infinity, -Infinity];
      points.forEach(([x, y], k) => {
        const [x2, y2] = points[(k + 1) % points.length];
        const t = y === y2 ? 0 : (row / perUnit - y) / (y2 - y);
        if (t < 0 || t > 1) return;
        const at = (x + t * (x2 - x)) * perUnit;
        from = Math.min(from, at);
        to = Math.max(to, at);
      });
      for (let column = Math.ceil(from); column <= to; column++) top[row * size + column] = id;
    }
  });
  const shown = new Set(top);
  return polygons.map((_, id) => shown.has(id));
}

/** Tenths of a unit, as whole numbers: the panels are drawn in a group of that scale. */
const tenths = ([x, y]) => [Math.round(10 * x), Math.round(10 * y)];

/** A path through points, in steps from one to the next. */
function path(points, close) {
  let last = [0, 0];
  return points
    .map(tenths)
    .map(([x, y], k) => {
      const [dx, dy] = [x - last[0], y - last[1]];
      last = [x, y];
      return `${k === 0 ? 'M' : k === 1 ? 'l' : dx < 0 ? '' : ' '}${dx}${dy < 0 ? '' : ' '}${dy}`;
    })
    .concat(close ? 'z' : '')
    .join('');
}

/** One panel's pieces as SVG, far to near; `centre` is where the origin goes. */
function draw(pieces, camera, centre, scale) {
  const flat = (p) => [centre[0] + scale * dot(p, camera.right), centre[1] - scale * dot(p, camera.up)];
  const ordered = backToFront(pieces, camera.eye).map((piece) => ({
    ...piece,
    flat: piece.points.map(flat),
  }));
  const opaque = ordered.filter((piece) => piece.lit);
  const isShown = visible(opaque.map((piece) => piece.flat));
  const hidden = new Set(opaque.filter((_, k) => !isShown[k]));
  const out = [];
  for (const piece of ordered) {
    const points = piece.flat;
    if (hidden.has(piece)) continue;
    if (points.length === 2) out.push(`<path class="${piece.line}" d="${path(points)}"/>`);
    else if (!piece.lit) out.push(`<path class="glass" d="${path(points, true)}"/>`);
    else {
      const colour = shade(piece.fill, light(piece.lighting ?? piece.normal, camera));
      out.push(`<path fill="${colour}" stroke="${colour}" d="${path(points, true)}"/>`);
      const edges = points.flatMap((p, k) =>
        piece.drawn[k] ? [path([p, points[(k + 1) % points.length]])] : [],
      );
      if (edges.length > 0) out.push(`<path class="${piece.line}" d="${edges.join('')}"/>`);
    }
  }
  return out.join('\n');
}

const style = `
text{font-family:system-ui,-apple-system,'Segoe UI',Helvetica,Arial,sans-serif;fill:#52606d;font-size:12px}
.head{font-size:17px;font-weight:600;fill:${kInk}}
.name{font-size:13px;font-weight:600;fill:${kInk}}
.figure{font-size:12px;font-weight:400;fill:#52606d}
path{stroke-width:6;stroke-linejoin:round;stroke-linecap:round}
.glass{fill:#8fb4d9;fill-opacity:.2}
.inner,.outer,.curve,.frame,.hard,.soft,.block{fill:none}
.inner{stroke:#1f9a89;stroke-width:6}
.outer{stroke:#54708c;stroke-width:7}
.curve{stroke:${kInk};stroke-width:16}
.frame{stroke:${kInk};stroke-width:11}
.hard{stroke:#7c1f1a}
.soft{stroke:#16357a}
.block{stroke:${kInk};stroke-width:6}
`;

const run = await exampleRunner();
const width = margin.left + 3 * cell.width + 2 * gap + margin.right;
const height = margin.top + rows.length * cell.height + (rows.length - 1) * gap + margin.bottom;
const out = [
  `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}">`,
  '<title>From a domain to its block mesh</title>',
  `<style>${style}</style>`,
  `<rect width="${width}" height="${height}" rx="12" fill="#f3f5f8"/>`,
];
['Reference mesh', 'Local dual contributions', 'Block mesh'].forEach((head, column) => {
  const x = margin.left + column * (cell.width + gap);
  out.push(`<text class="head" x="${x + 4}" y="34">${column + 1}&#160; ${head}</text>`);
});

rows.forEach(([name, azimuth], row) => {
  const result = run(name);
  const camera = cameraOf(azimuth);
  const { title, figure } = examples.find((e) => e.name === name);
  const corners = rowsOf(result.features.nodes, 3);
  const place = (positions) => fitted(positions, corners);
  const range = (axis) => {
    const values = place(corners).map((p) => dot(p, axis));
    return [Math.min(...values), Math.max(...values)];
  };
  const [x0, x1] = range(camera.right);
  const [y0, y1] = range(camera.up);
  const inner = { width: cell.width - 2 * inset.side, height: cell.height - inset.top - inset.bottom };
  const scale = Math.min(inner.width / (x1 - x0), inner.height / (y1 - y0));
  const centre = [
    inset.side + inner.width / 2 - (scale * (x0 + x1)) / 2,
    inset.top + inner.height / 2 + (scale * (y0 + y1)) / 2,
  ];
  const { reference, contributions, primal, parts } = result;
  const cuts = reference.cuts > 0 ? `, cut into ${reference.simplices.length / 4}` : '';
  const swatch = (x, colour) =>
    `<rect x="${x}" y="${cell.height - 21}" width="11" height="11" rx="2" fill="${colour}"/>`;
  const note = (x, text) => `<text x="${x}" y="${cell.height - 11}">${text}</text>`;
  const hard = `${contributions.hardCount} hard`;
  const softX = 38 + 7 * hard.length;
  const captions = [
    note(12, `${reference.filled} tetrahedra${cuts}`),
    swatch(12, kHard) +
      note(28, hard) +
      swatch(softX, kSoft) +
      note(softX + 16, `${contributions.softCount} soft`),
    note(12, `${primal.quality.length} blocks in ${parts.count} ${parts.count > 1 ? 'parts' : 'part'}`),
  ];
  const subtitle = figure ? ` <tspan class="figure">– ${figure.toLowerCase()}</tspan>` : '';
  [referencePieces, contributionPieces, blockPieces].forEach((piecesOf, column) => {
    const x = margin.left + column * (cell.width + gap);
    const y = margin.top + row * (cell.height + gap);
    out.push(
      `<g transform="translate(${x} ${y})">`,
      `<rect width="${cell.width}" height="${cell.height}" rx="8" fill="#fff" stroke="#d5dbe1"/>`,
      `<g transform="scale(.1)">`,
      draw(piecesOf(result, place), camera, centre, scale),
      '</g>',
      column === 0 ? `<text class="name" x="12" y="22">${title}${subtitle}</text>` : '',
      captions[column],
      '</g>',
    );
  });
});
out.push('</svg>', '');
const svg = out.filter((line) => line !== '').join('\n');
writeFileSync(new URL('../../public/overview.svg', import.meta.url), `${svg}\n`);
console.log(`public/overview.svg: ${Math.round(svg.length / 1000)} kB`);
