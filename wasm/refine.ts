// Refinement: blocks divided into elements, by intervals per D̄-surface.
import { DualblockError } from './io/errors.ts';
import { layeredSurfaces, layeredTags } from './io/layered.ts';
import type { Certificate, CoreError, RunResult } from './result.ts';

/** How blocks are divided. All edges that one D̄-surface crosses are divided alike. */
export interface Refinement {
  /** Intervals on every edge, 1 or more. */
  intervals: number;
  /** Over 0: as many intervals as keep them no longer than this, in the units of the input, instead. */
  size: number;
  /** Intervals of the edges that single D̄-surfaces cross, instead. */
  ofSurface: { surface: number; intervals: number }[];
  /** Elements get larger by the factor `growth` (1 to 1000) from one to the next, away from the facet's side. */
  gradings: { facet: number; growth: number }[];
  /** Blocks may keep straight elements beside a bent side where bent ones would be invalid, off the domain. */
  straight: boolean;
}

export const noRefinement: Refinement = {
  intervals: 1,
  size: 0,
  ofSurface: [],
  gradings: [],
  straight: false,
};

/** Whether it divides anything at all. */
export const isRefined = (r: Refinement): boolean =>
  r.intervals > 1 || r.size > 0 || r.ofSurface.some(({ intervals }) => intervals > 1);

/** Elements that a refined mesh may have: what a WebAssembly memory of 4 GB holds, with room to spare. */
export const mostElements = 12_000_000;

export interface RefinedMesh {
  positions: Float64Array;
  /** 4 or 8 nodes each, in VTK's order. */
  elements: Int32Array;
  /** The block of each element. */
  block: Int32Array;
  /** Minimum scaled Jacobian of each element. */
  quality: Float64Array;
  /** Edges (2D) or faces of elements on the boundary, and the facet of each. */
  boundaryFaces: Int32Array;
  boundaryFacet: Int32Array;
  /** The element that each of them belongs to. */
  boundaryElement: Int32Array;
  /** The same inside the domain, each once. */
  interfaceFaces: Int32Array;
  interfaceFacet: Int32Array;
  /** Along the blocks' edges: two nodes and an element that has them, one after the other. */
  outline: Int32Array;
  /** Per D̄-surface; 0 for one that is not in the mesh. */
  intervals: Int32Array;
  /** Per D̄-surface (offsets): where along the edges that it crosses their nodes are, from 0 to 1. */
  placeOffsets: Int32Array;
  places: Float64Array;
  /** Per block and axis: 1 where its D̄-surface runs against the axis, so that its places count from the other end. */
  isReversed: Uint8Array;
  /** Blocks with straight elements, because ones that follow the domain's bent sides would have been invalid. */
  straightened: number;
  /** Of the elements, `matching` and `cells` being the blocks' own matter: null. Only a valid mesh may be handed out. */
  certificate: Certificate;
}

export type RefineAnswer = ({ ok: true } & RefinedMesh) | { ok: false; error: CoreError };

/** What refinement needs to know of a result. */
export interface RefineInput {
  dimension: 2 | 3;
  positions: Float64Array;
  blocks: Int32Array;
  tags: Int32Array;
  surfaces: Int32Array;
  surfacePatch: Int32Array;
  faces: Float64Array;
  patchOfFace: Int32Array;
  segments: Float64Array;
  patchesOfSegment: Int32Array;
  /** Area or volume. */
  domainMeasure: number;
}

/** Of the mesh that a result hands out; it shares arrays with the result. */
export function refineInput(result: RunResult): RefineInput {
  const { dimension, mesh, primal, reference, bent, certificate } = result;
  const { positions, blocks } = mesh ?? primal;
  return {
    dimension,
    positions,
    blocks,
    tags: mesh ? mesh.blockTags : layeredTags(result),
    surfaces: mesh ? mesh.blockSurfaces : layeredSurfaces(result),
    surfacePatch: reference.surfacePatch,
    ...bent,
    domainMeasure: certificate.domainMeasure,
  };
}

/** Refines meshes. Its memory is never smaller than the largest of them: drop it after such a one. */
export class Refiner {
  private readonly module;

  private constructor(module: Awaited<ReturnType<typeof load>>) {
    this.module = module;
  }

  /** Loads the module. In Node, pass the bytes of refinement.wasm; a browser finds them by itself. */
  static async create(options: { wasmBinary?: Uint8Array } = {}): Promise<Refiner> {
    return new Refiner(await load(options));
  }

  /** Throws a DualblockError, `badOption` for a refinement that cannot be. `progress`: the share of the work done. */
  refine(
    mesh: RefineInput,
    refinement: Partial<Refinement>,
    progress: ((done: number) => void) | null = null,
    limit = mostElements,
  ): RefinedMesh {
    const { intervals, size, ofSurface, gradings, straight } = { ...noRefinement, ...refinement };
    for (const count of [intervals, ...ofSurface.map((of) => of.intervals)])
      if (!Number.isInteger(count) || Math.abs(count) >= 2 ** 31)
        throw new DualblockError(
          'badOption',
          `Edges cannot be divided into ${count} intervals: give 1 or more.`,
        );
    const options = {
      intervals,
      size,
      limit,
      ofSurface: Int32Array.from(ofSurface.flatMap((of) => [of.surface, of.intervals])),
      gradedFacets: Int32Array.from(gradings, ({ facet }) => facet),
      growths: Float64Array.from(gradings, ({ growth }) => growth),
      straight,
    };
    const answer = this.module.refine(mesh, options, progress);
    if (answer.ok) return answer;
    throw new DualblockError(answer.error.code, answer.error.message, answer.error.entities);
  }
}

async function load(options: { wasmBinary?: Uint8Array }) {
  const { default: createRefinement } = await import('./build/refinement.mjs');
  return createRefinement(options);
}
