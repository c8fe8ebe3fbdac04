// The example domains as files: complete index, closed and outward boundaries, the sizes that were meant,
// reference meshes that fill their domain, and the matching rules of section 4.3 on figure 12.
import { readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';
import { interfaces } from './support/core.ts';
import type { ExampleDomain, Point } from './support/example-geometry.ts';
import {
  edgeKey,
  interiorAngle,
  loopArea,
  loopVolume,
  newell,
  violations,
} from './support/example-geometry.ts';

const folder = fileURLToPath(new URL('../../public/examples/', import.meta.url));
const readJson = <T>(file: string): T => JSON.parse(readFileSync(folder + file, 'utf8')) as T;

interface ExampleIndex {
  format: string;
  examples: { name: string; title: string; figure: string; dimension: number }[];
}
const index = readJson<ExampleIndex>('index.json');
const domains = index.examples.map((entry) => readJson<ExampleDomain>(`${entry.name}.json`));
const named = (name: string): ExampleDomain => {
  const found = domains.find((domain) => domain.name === name);
  if (!found) throw new Error(`no example ${name}`);
  return found;
};
const take = <T>(list: readonly T[], i: number): T => {
  const value = list[i];
  if (value === undefined) throw new Error(`no entry ${i} in a list of ${list.length}`);
  return value;
};

const golden = (1 + Math.sqrt(5)) / 2;
const pentagonArea = 2.5 * Math.sin((2 * Math.PI) / 5);
/** Area of a regular polygon of n corners. */
const polygonArea = (n: number, radius: number): number =>
  (n / 2) * Math.sin((2 * Math.PI) / n) * radius ** 2;
/** Volume between two regular polygons of 16 corners in parallel planes. */
const frustum = (low: number, high: number, height: number): number =>
  (polygonArea(16, 1) * height * (low ** 2 + low * high + high ** 2)) / 3;
const ballOf16 = Array.from({ length: 8 }, (_, k) => {
  const [low, high] = [Math.PI * (k / 8 - 0.5), Math.PI * ((k + 1) / 8 - 0.5)];
  return frustum(Math.cos(low), Math.cos(high), Math.sin(high) - Math.sin(low));
}).reduce((sum, v) => sum + v, 0);
const sizes: Record<string, number> = {
  tapered_brick: 7.8,
  extruded_pentagon: pentagonArea,
  double_pyramid: 4 / 3,
  square_ring: 8,
  protrusion: 10,
  l_shape_extruded: 3,
  u_shape_extruded: 5,
  tetrahedron: 8 / 3,
  house: 6,
  notched_cube: 7,
  hexagonal_pyramid: Math.sqrt(3) / 2,
  icosahedron: (20 / 3) * golden ** 2,
  cylinder: 2 * polygonArea(24, 1),
  plate_with_hole: 16 - polygonArea(24, 0.8),
  ball: ballOf16,
  elbow: 8 * Math.sin(Math.PI / 16) * 2 * polygonArea(16, 0.7), // eight wedges: sine of the angle, times the moment
  box_on_box: 10,
  vertex_end: 1.2,
  vertex_side: 2 + Math.tan(Math.PI / 18),
  vertex_corner: 3,
  vertex_reversal: 4 - Math.tan(Math.PI / 36),
  square_2d_first: 2,
  square_2d_second: 2,
  end_vertex_1: 1,
  end_vertex_2: 1,
  end_vertex_3: 1,
  end_vertex_4: 1,
  figure_12a: 1,
  figure_12b: 1,
  figure_12c: 1,
  figure_12d: 1,
  square_2d: 1,
  pentagon_2d: pentagonArea,
  l_shape_2d: 3,
  square_ring_2d: 8,
  two_holes_2d: 13,
};

describe('the index', () => {
  it('names every example file once, with its title, figure and dimension', () => {
    expect(index.format).toBe('dualblock-examples/1');
    const files = readdirSync(folder).filter((file) => file.endsWith('.json') && file !== 'index.json');
    expect(index.examples.map((entry) => `${entry.name}.json`).sort()).toEqual(files.sort());
    expect(Object.keys(sizes).sort()).toEqual(domains.map((domain) => domain.name).sort());
    index.examples.forEach((entry, i) => {
      const { format, name, title, figure, dimension } = take(domains, i);
      expect(format).toBe('dualblock-domain/1');
      expect({ name, title, figure, dimension }).toEqual(entry);
      expect(title).not.toBe('');
    });
  });
});

describe.each(domains.filter((domain) => domain.dimension === 3))('$name (3D)', (domain) => {
  const inner = interfaces[domain.name] ?? [];
  const facets = (domain.facets ?? []).filter((_, f) => !inner.includes(f));
  const vertex = (i: number): Point => take(domain.vertices, i);

  it('is closed: every directed edge has its reverse exactly once', () => {
    const seen = new Set<string>();
    for (const loop of facets.flatMap((facet) => facet.loops)) {
      loop.forEach((a, k) => {
        const key = `${a} ${take(loop, (k + 1) % loop.length)}`;
        expect(seen.has(key), `directed edge ${key} twice`).toBe(false);
        seen.add(key);
      });
    }
    for (const key of seen)
      expect(seen.has(key.split(' ').reverse().join(' ')), `reverse of ${key}`).toBe(true);
    expect(new Set(facets.flatMap((facet) => facet.loops.flat())).size).toBe(domain.vertices.length);
  });

  it('has planar facets whose holes turn the other way', () => {
    for (const { loops } of facets) {
      const [nx, ny, nz] = newell(take(loops, 0).map(vertex));
      const length = Math.hypot(nx, ny, nz);
      expect(length).toBeGreaterThan(1e-3);
      const heights = loops.flat().map((i) => {
        const [x = 0, y = 0, z = 0] = vertex(i);
        return (nx * x + ny * y + nz * z) / length;
      });
      expect(Math.max(...heights) - Math.min(...heights)).toBeLessThan(1e-14);
      for (const hole of loops.slice(1)) {
        const [hx, hy, hz] = newell(hole.map(vertex));
        expect(nx * hx + ny * hy + nz * hz).toBeLessThan(0);
      }
    }
  });

  it('is oriented outward and encloses the volume meant', () => {
    const loops = facets.flatMap((facet) => facet.loops);
    const volume = loops.reduce((sum, loop) => sum + loopVolume(loop.map(vertex)), 0);
    expect(volume / (sizes[domain.name] ?? Number.NaN)).toBeCloseTo(1, 12);
  });
});

describe.each(domains.filter((domain) => domain.dimension === 2))('$name (2D)', (domain) => {
  const loops = domain.loops ?? [];
  const area = loops.reduce((sum, loop) => sum + loopArea(loop.map((i) => take(domain.vertices, i))), 0);

  it('turns counter-clockwise outside, clockwise in holes, uses every vertex once and has the area meant', () => {
    loops.forEach((loop, k) => {
      expect(Math.sign(loopArea(loop.map((i) => take(domain.vertices, i))))).toBe(k === 0 ? 1 : -1);
    });
    expect(area / (sizes[domain.name] ?? Number.NaN)).toBeCloseTo(1, 12);
    expect(loops.flat().sort((a, b) => a - b)).toEqual(domain.vertices.map((_, i) => i));
  });
});

describe.each(domains.filter((domain) => domain.reference))('$name (reference mesh)', (domain) => {
  const { nodes, simplices } = domain.reference ?? { nodes: [], simplices: [] };

  it('fills the domain conformally', () => {
    expect(nodes.slice(0, domain.vertices.length)).toEqual(domain.vertices);
    expect(new Set(simplices.flat()).size).toBe(nodes.length);
    const uses = new Map<string, number>();
    let total = 0;
    for (const triangle of simplices) {
      const size = loopArea(triangle.map((i) => take(nodes, i)));
      expect(size).toBeGreaterThan(0.01);
      total += size;
      triangle.forEach((a, k) => {
        const key = edgeKey(a, take(triangle, (k + 1) % 3));
        uses.set(key, (uses.get(key) ?? 0) + 1);
      });
    }
    expect(total).toBeCloseTo(sizes[domain.name] ?? Number.NaN, 12);
    // Edges of one triangle lie on the rectangle's border (all examples with a mesh are rectangles at 0, 0).
    const [right = 0, top = 0] = take(domain.vertices, 2);
    for (const [key, count] of uses) {
      const [a = [], b = []] = key.split(' ').map((i) => take(nodes, Number(i)));
      const shares = (axis: number, value: number): boolean => a[axis] === value && b[axis] === value;
      const onBorder = shares(0, 0) || shares(0, right) || shares(1, 0) || shares(1, top);
      expect(count, `edge ${key}`).toBe(onBorder ? 1 : 2);
    }
  });
});

describe('vertex kinds', () => {
  it.each([
    ['vertex_end', 90],
    ['vertex_side', 200],
    ['vertex_corner', 270],
    ['vertex_reversal', 350],
  ])('%s has an interior angle of %d degrees at vertex 0 and convex others', (name, angle) => {
    const { vertices } = named(name);
    const angles = vertices.map((_, i) => interiorAngle(vertices, i));
    expect(angles[0]).toBeCloseTo(angle, 10);
    for (const other of angles.slice(1)) expect(other).toBeLessThan(135);
  });
});

describe('end vertices', () => {
  it.each([1, 2, 3, 4])('end_vertex_%d has its origin in that many triangles', (count) => {
    const { vertices, reference } = named(`end_vertex_${count}`);
    expect(vertices[0]).toEqual([0, 0]);
    expect(reference?.simplices.filter((triangle) => triangle.includes(0))).toHaveLength(count);
  });
});

describe('figure 12', () => {
  it.each([
    ['figure_12a', ['edge 0 2 near 0: 2 left, 1 right']],
    ['figure_12b', ['virtual point of 3 edge points: 3 hard']],
    ['figure_12c', []],
    ['figure_12d', []],
  ])('%s breaks exactly the rule shown', (name, expected) => {
    expect(violations(named(name))).toEqual(expected);
  });
});
