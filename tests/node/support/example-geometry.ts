// Plain geometry of the example domains for tests, and the 2D matching rules of section 4.3 written out
// directly: nothing is shared with the product.

export type Point = readonly number[];

export interface ExampleDomain {
  format: string;
  dimension: 2 | 3;
  name: string;
  title: string;
  figure: string;
  vertices: Point[];
  facets?: { loops: number[][] }[];
  loops?: number[][];
  reference?: { nodes: Point[]; simplices: number[][] };
  contributions?: { simplex: number; nodes: number[]; kind: 'hard' | 'soft' }[];
}

const at = (points: readonly Point[], i: number): [number, number, number] => {
  const [x = Number.NaN, y = Number.NaN, z = 0] = points[i % points.length] ?? [];
  return [x, y, z];
};

/** The key of the undirected edge of two node ids: "smaller larger". */
export const edgeKey = (a: number, b: number): string => `${Math.min(a, b)} ${Math.max(a, b)}`;

/** Signed area of a 2D loop, positive when it turns counter-clockwise. */
export const loopArea = (loop: readonly Point[]): number => newell(loop)[2] / 2;

/** Newell's normal of a loop: twice its vector area, on the side from which it turns counter-clockwise. */
export function newell(loop: readonly Point[]): [number, number, number] {
  const sum: [number, number, number] = [0, 0, 0];
  loop.forEach((_, i) => {
    const [ax, ay, az] = at(loop, i);
    const [bx, by, bz] = at(loop, i + 1);
    sum[0] += ay * bz - az * by;
    sum[1] += az * bx - ax * bz;
    sum[2] += ax * by - ay * bx;
  });
  return sum;
}

/** A planar loop's share of the signed volume of the closed surface that it belongs to. */
export function loopVolume(loop: readonly Point[]): number {
  const [ax, ay, az] = at(loop, 0);
  const [nx, ny, nz] = newell(loop);
  return (ax * nx + ay * ny + az * nz) / 6;
}

/** Interior angle, in degrees from 0 to 360, of a counter-clockwise polygon at vertex `i`. */
export function interiorAngle(loop: readonly Point[], i: number): number {
  const [x, y] = at(loop, i);
  const [nx, ny] = at(loop, i + 1);
  const [px, py] = at(loop, i + loop.length - 1);
  const turn = Math.atan2(py - y, px - x) - Math.atan2(ny - y, nx - x);
  return ((((turn * 180) / Math.PI) % 360) + 360) % 360;
}

/**
 * The places where a 2D domain's explicit contributions break the matching rules, as text. A contribution of
 * subset s of a triangle touches an edge that shares exactly one node with s, at the point near that node. Soft
 * contributions join the two points that they touch into one virtual point, which needs two or four hard
 * arrivals; a point of its own needs as many hard arrivals from the left as from the right when it is inner, and
 * at most one on the boundary.
 */
export function violations(domain: ExampleDomain): string[] {
  const simplices = domain.reference?.simplices ?? [];
  const triangles = new Map<string, number[]>();
  simplices.forEach((triangle, t) => {
    for (const [a, b] of edges(triangle)) {
      triangles.set(edgeKey(a, b), [...(triangles.get(edgeKey(a, b)) ?? []), t]);
    }
  });

  const hard = new Map<string, number[]>(); // point -> the triangles its hard contributions lie in
  const joined = new Map<string, string>(); // point -> a point of the same virtual point
  const root = (p: string): string => {
    const next = joined.get(p);
    return next === undefined ? p : root(next);
  };
  for (const { simplex, nodes, kind } of domain.contributions ?? []) {
    const touched: string[] = [];
    for (const [a, b] of edges(simplices[simplex] ?? [])) {
      if (nodes.includes(a) === nodes.includes(b)) continue;
      touched.push(`edge ${edgeKey(a, b)} near ${nodes.includes(a) ? a : b}`);
    }
    for (const p of touched) hard.set(p, [...(hard.get(p) ?? []), ...(kind === 'hard' ? [simplex] : [])]);
    const [p = '', q = ''] = touched.map(root);
    if (kind === 'soft' && p !== q) joined.set(p, q);
  }

  const groups = new Map<string, string[]>();
  for (const p of hard.keys()) groups.set(root(p), [...(groups.get(root(p)) ?? []), p]);
  const found: string[] = [];
  for (const points of groups.values()) {
    const arrivals = points.flatMap((p) => hard.get(p) ?? []);
    if (points.length > 1) {
      if (arrivals.length !== 2 && arrivals.length !== 4) {
        found.push(`virtual point of ${points.length} edge points: ${arrivals.length} hard`);
      }
      continue;
    }
    const [point = ''] = points;
    const sides = triangles.get(point.slice('edge '.length, point.indexOf(' near'))) ?? [];
    const [left = 0, right = 0] = sides.map((t) => arrivals.filter((other) => other === t).length);
    if (sides.length === 1 ? left > 1 : left !== right) found.push(`${point}: ${left} left, ${right} right`);
  }
  return found;
}

/** The three edges of a triangle as pairs of node ids. */
function edges(triangle: readonly number[]): [number, number][] {
  const [a = -1, b = -1, c = -1] = triangle;
  return [
    [a, b],
    [b, c],
    [c, a],
  ];
}
