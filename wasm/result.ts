// What the core hands back: every stage's result in typed arrays that own their memory. Ids count from 0, -1
// stands for none. A "tag" is 2 * surface, plus 1 where the simplex lies in front of the surface.
import type { ErrorCode } from './error-codes.ts';
import type { EntityReference } from './io/errors.ts';

export interface CoreError {
  code: ErrorCode;
  message: string;
  entities: EntityReference[];
}
export type LoadAnswer = { ok: true } | { ok: false; error: CoreError };
export type RunAnswer = (RunResult & { ok: true }) | { ok: false; error: CoreError; given?: Polygons };

/** Facets (2D: segments) as loops of vertices, numbered as in the input; 2 or 3 coordinates per vertex. */
export interface Polygons {
  vertices: Float64Array;
  facetOffsets: Int32Array;
  loopOffsets: Int32Array;
  loopVertices: Int32Array;
}

export type Check = 'matching' | 'cells' | 'topology' | 'geometry' | 'features';

export interface Certificate extends Record<Check, boolean | null> {
  /** True when every check passed; null checks were not run (a domain with contributions of its own). */
  valid: boolean;
  failures: { check: Check; message: string; entities: EntityReference[] }[];
  /** Area or volume of the domain, from its facets, and of the blocks. */
  domainMeasure: number;
  meshMeasure: number;
  /** The smallest Bezier coefficient of a block's Jacobian over that block's largest. */
  worstCoefficient: number;
  /** The two measures agree to rounding; where sides are bent, straight blocks may only come near. */
  isExact: boolean;
  fidelity: Fidelity;
}

/** How near a mesh comes to a domain with bent sides; zeros where it is the domain. */
export interface Fidelity {
  /** The largest distance between a face and its side, or an edge and its curve, as a share of the face's or edge's size. */
  largestDistance: number;
  /** The largest distance between a face and its side as a share of how thick the mesh is behind the face. */
  largestDepth: number;
  /** Degrees: the most that a side turns by in a face, or a curve along an edge. */
  largestTurning: number;
  /** Of the mesh's volume from the domain's, as a share of that. */
  volumeDifference: number;
  /** Between bent sides and faces, lost and gained alike, as a share of the same. */
  strayedVolume: number;
  /** The bent sides, each by one of its facets. */
  sides: { facet: number; distance: number; depth: number; turning: number }[];
}

export interface RunResult {
  dimension: 2 | 3;
  name: string;
  title: string;
  figure: string;
  /** The domain gave its own contributions: only their matching was checked. */
  onlyMatching: boolean;
  /** The domain after merging: facets as large as they are planar. */
  domain: Polygons & {
    givenVertex: Int32Array;
    /** -1 for facets that were dropped: triangles with two corners at one point. */
    facetOfGiven: Int32Array;
    /** The facets' names, where the input gives any; those of merged facets joined by "+", empty for none. */
    facetNames?: string[];
    regions: number;
    deviation: number;
    repairs: string[];
  };
  /** Curves (2D: vertices) of the domain, by the ridges of the uncut reference mesh that they run along. */
  features: {
    nodes: Float64Array;
    ridgeOffsets: Int32Array;
    ridgeNodes: Int32Array;
    angle: Float64Array;
    facets: Int32Array;
    /** 1 end, 2 side, 3 corner, 4 reversal (paper 2.4). */
    kind: Uint8Array;
    /** Blocks that should meet along the curve, and the fewest that do; empty where no mesh was certified. */
    ideal: Uint8Array;
    actual: Int32Array;
    /** Vertices by the feature curves that meet there: 0 face, 1 semi-edge, 2 edge, 3 vertex (paper, figure 3). */
    vertices: Int32Array;
    vertexKind: Uint8Array;
    /** The most that the smallest scaled Jacobian can be, by the domain's own acute angles. */
    angleBound: number;
  };
  reference: {
    nodes: Float64Array;
    simplices: Int32Array;
    neighbors: Int32Array;
    tags: Int32Array;
    region: Int32Array;
    /** 0 facet, 1 cut at a reflex curve, 2 cut at a vertex, 3 faces of simplices, 4 cut across bent sides. */
    surfaceKind: Uint8Array;
    /** Facets that are one bent side have the lowest of them; -1 for surfaces that are a side each. */
    surfacePatch: Int32Array;
    surfaceSource: Int32Array;
    filled: number;
    remedy: string;
    /** Split surfaces in all; of those, at vertices and across bent sides. */
    cuts: number;
    vertexCuts: number;
    bentCuts: number;
    /** Sides that are bent. */
    bentSides: number;
    repairs: number;
  };
  parts: {
    count: number;
    fallbackComponents: number;
    /** Of them: whose simplices were made for their shape. */
    remeshedComponents: number;
    /** Why simplices became parts, in all or in some parts; empty where none did. */
    fallbackReason: string;
    /** Whether the time limit came before all that might be better was tried. */
    isCutShort: boolean;
    /**
     * Blocks that cuts alone, the confined fallback and all reference simplices would give, as far as they were counted:
     * infinity where they give no valid mesh, below 0 where nobody asked.
     */
    alternatives: Float64Array;
    /**
     * Policies of cutting that were tried, the standard one first: curves of more than `largestAngle` are cut, and planes
     * may `turn` by as much to serve two curves (radians); `dishes` is 1 where round rims get one cut each and hollow
     * sides are cut along. `blocks` that the whole domain would get, the smallest sine of an angle in a part, and the
     * `components` that took it.
     */
    cutTrials: {
      largestAngle: Float64Array;
      turn: Float64Array;
      dishes: Int32Array;
      blocks: Float64Array;
      worstSine: Float64Array;
      components: Int32Array;
    };
    /**
     * Parts that were carried through to a mesh; first those that the objective `blocks` gives, and only those where it is
     * asked for. Minus infinity where the mesh is not valid; `chosen` is 1 for one of them.
     */
    candidates: {
      parts: Int32Array;
      blocks: Int32Array;
      minScaledJacobian: Float64Array;
      chosen: Uint8Array;
    };
    /** Components where only the parts that cuts left over became simplices, and how many parts those were. */
    pulledComponents: number;
    pulledParts: number;
    region: Int32Array;
    ofSimplex: Int32Array;
    sidePart: Int32Array;
    sideTag: Int32Array;
    sideOpposite: Int32Array;
  };
  /** Contributions per simplex (offsets), and the dual that they make. */
  contributions: {
    hardCount: number;
    softCount: number;
    offsets: Int32Array;
    side: Int32Array;
    mask: Uint8Array;
    /** Per simplex, bit m: the contribution of vertex mask m is soft. */
    soft: Uint16Array;
    surfaceOfSide: Int32Array;
    surfaces: number;
    cells: number;
    classOffset: Int32Array;
    pieceOfClass: Int32Array;
    piecePart: Int32Array;
    pieceCell: Int32Array;
    pieceSides: Int32Array;
  };
  primal: {
    positions: Float64Array;
    nodePiece: Int32Array;
    edges: Int32Array;
    edgeSurface: Int32Array;
    faces: Int32Array;
    faceSurfaces: Int32Array;
    blocks: Int32Array;
    blockPart: Int32Array;
    blockSides: Int32Array;
    quality: Float64Array;
    /** Positions as placed, then after every round of relaxation; empty where they were not asked for. */
    history: Float64Array;
    boundaryFaces: Int32Array;
    boundaryFacet: Int32Array;
  };
  /**
   * The mesh that is handed out where D̄-surfaces have been extracted or inserted; null where it is the primal.
   * `blockSurfaces` numbers those of the layered mesh, and inserted ones after them.
   */
  mesh: {
    positions: Float64Array;
    blocks: Int32Array;
    blockPart: Int32Array;
    /** Per block and face (low and high end of each axis) the tag of the facet that it lies on, or -1. */
    blockTags: Int32Array;
    /** Per block, the D̄-surface that crosses it along each axis. */
    blockSurfaces: Int32Array;
    quality: Float64Array;
    /** D̄-surfaces, in the order that they went. */
    extracted: Int32Array;
    /** Inserted D̄-surfaces, each with the one whose layer it was split from. */
    inserted: Int32Array;
    /** How many of the inserted ones, the first, double others so that blocks follow bent sides. */
    doubled: number;
    boundaryFaces: Int32Array;
    boundaryFacet: Int32Array;
  } | null;
  /** The facets of bent sides and the segments of their curves, 9 and 6 coordinates each, and their patches. */
  bent: {
    faces: Float64Array;
    patchOfFace: Int32Array;
    segments: Float64Array;
    patchesOfSegment: Int32Array;
  };
  certificate: Certificate;
  /** Milliseconds per stage. */
  timings: Record<string, number>;
}
