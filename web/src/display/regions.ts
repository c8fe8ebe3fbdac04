// How the contributions present in a simplex cut it (paper 4.1; ARCHITECTURE.md 1): the convex classes of its regions as
// polytopes in barycentric coordinates, computed once for each set of contributions that occurs.
import { contributionLabel, cutPolytope, PointPool, type Polytope, wholeSimplex } from './polytope.ts';

export interface TemplateFace {
  /** Points of the template, counter-clockwise seen from outside the class. In 2D: the two ends of an edge. */
  loop: number[];
  cls: number;
  /** The class behind a contribution; -1 for a face that lies on a face of the simplex. */
  other: number;
  /** Mask of the contribution, or 0. */
  mask: number;
  /** Local number of the simplex's face, or -1. */
  side: number;
}

export interface Template {
  /** Barycentric coordinates. */
  points: number[][];
  /** Per class, the set of contributions that it lies inside of: bit m for the one of vertex mask m. */
  inside: number[];
  faces: TemplateFace[];
  /** 2D: the outline of each class, counter-clockwise. */
  outlines: number[][];
}

/** The value 1 - δ that the weights of a contribution's vertices add up to (paper 4.1). */
export const levelOf = (dimension: number): number => 1 - 1 / (dimension + 2);

const weightOf = (point: number[], mask: number): number =>
  point.reduce((sum, x, v) => sum + ((mask >> v) & 1 ? x : 0), 0);

/** Templates for simplices of one dimension. */
export class Templates {
  private readonly dimension: 2 | 3;
  private readonly regions: number[];
  private readonly cache = new Map<number, Template>();

  constructor(dimension: 2 | 3) {
    this.dimension = dimension;
    this.regions = allRegions(dimension);
  }

  /** `present`: the set of contributions, bit m for vertex mask m. Classes are numbered as the core numbers them. */
  get(present: number): Template {
    let template = this.cache.get(present);
    if (!template) {
      template = this.build(present);
      this.cache.set(present, template);
    }
    return template;
  }

  /** How many classes a simplex with these contributions has. */
  private build(present: number): Template {
    const n = this.dimension;
    const level = levelOf(n);
    const inside: number[] = [];
    for (const region of this.regions) if (!inside.includes(region & present)) inside.push(region & present);

    const pool = new PointPool(n + 1);
    let pieces: { polytope: Polytope; set: number }[] = [{ polytope: wholeSimplex(pool), set: 0 }];
    for (const mask of masksOf(present)) {
      pieces = pieces.flatMap(({ polytope, set }) => {
        const [into, out] = cutPolytope(
          pool,
          polytope,
          (p) => weightOf(p, mask) - level,
          contributionLabel + mask,
        );
        return [
          ...(into ? [{ polytope: into, set: set | (1 << mask) }] : []),
          ...(out ? [{ polytope: out, set }] : []),
        ];
      });
    }
    const faces: TemplateFace[] = [];
    const outlines: number[][] = [];
    for (const { polytope, set } of pieces) {
      const cls = inside.indexOf(set);
      for (const { loop, label } of polytope.facets) {
        const mask = label >= contributionLabel ? label - contributionLabel : 0;
        const other = mask ? inside.indexOf(set ^ (1 << mask)) : -1;
        faces.push({ loop, cls, other, mask, side: mask ? -1 : label });
      }
      if (n === 2) outlines[cls] = chain(polytope);
    }
    return { points: pool.points, inside, faces, outlines };
  }
}

/** The vertex masks in a set of contributions, ascending. */
export function masksOf(set: number): number[] {
  const masks: number[] = [];
  for (let m = 1; set >> m; m++) if ((set >> m) & 1) masks.push(m);
  return masks;
}

function chain({ facets }: Polytope): number[] {
  const next = new Map(facets.map(({ loop }) => [loop[0]!, loop[1]!]));
  const outline: number[] = [];
  for (let p = facets[0]!.loop[0]!; outline.length < facets.length; p = next.get(p)!) outline.push(p);
  return outline;
}

/**
 * The regions that all contributions together cut a simplex into, each as the set it lies inside of, ascending: found,
 * like the core's, from the points of a lattice that no contribution meets (22 per edge; neither 4 nor 5 divides 21).
 */
function allRegions(dimension: 2 | 3): number[] {
  const d = 21;
  const found = new Set<number>();
  const visit = (point: number[], rest: number): void => {
    if (point.length < dimension) {
      for (let k = 0; k <= rest; k++) visit([...point, k], rest - k);
      return;
    }
    const whole = [...point, rest];
    let set = 0;
    for (let mask = 1; mask < (1 << (dimension + 1)) - 1; mask++)
      if (weightOf(whole, mask) * (dimension + 2) > d * (dimension + 1)) set |= 1 << mask;
    found.add(set);
  };
  visit([], d);
  return [...found].sort((a, b) => a - b);
}
