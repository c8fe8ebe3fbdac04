// From a run's result to the block mesh that the writers take.
import type { RunResult } from '../result.ts';
import type { BlockMesh, FacetFaces } from './block-mesh.ts';

/** A block's edges from its first corner, one along each axis. */
const kAxisEnds = [1, 3, 4];
/** Per axis the face (2D: edge) on the far side of a block, from outside: there lies the block's side of the part. */
const kFarEdges = [
  [1, 2],
  [2, 3],
];
const kFarFaces = [
  [1, 2, 6, 5],
  [3, 7, 6, 2],
  [4, 5, 6, 7],
];

/** The block mesh of a result, as the writers take it; it shares arrays with the result. */
export function blockMesh(result: RunResult): BlockMesh {
  const { dimension, name, title, primal, parts, reference, domain, mesh } = result;
  const { positions, blocks, blockPart, quality, boundaryFaces, boundaryFacet } = mesh ?? primal;
  const several = parts.region.some((region) => region !== parts.region[0]);
  const interfaces = mesh ? interfacesOfTags(dimension, mesh.blocks, mesh.blockTags) : interfacesOf(result);
  return {
    dimension,
    name: title || name,
    positions,
    blocks,
    part: blockPart,
    ...(several ? { region: blockPart.map((part) => parts.region[part]!) } : {}),
    quality,
    surfaces: mesh ? mesh.blockSurfaces : surfacesOf(result),
    boundary: { faces: boundaryFaces, facet: boundaryFacet },
    ...(interfaces.facet.length > 0 ? { interfaces } : {}),
    ...(domain.facetNames ? { facetNames: domain.facetNames } : {}),
    patchOfFacet: reference.surfacePatch.slice(0, domain.facetOffsets.length - 1),
  };
}

/** The D̄-surface that crosses each block along each axis. All parallel edges of a block cross the same one. */
function surfacesOf({ dimension, primal }: RunResult): Int32Array {
  const nodes = primal.positions.length / dimension;
  const key = (a: number, b: number): number => (a < b ? a * nodes + b : b * nodes + a);
  const surfaceOfEdge = new Map<number, number>();
  for (let edge = 0; edge < primal.edgeSurface.length; edge++) {
    const [a, b] = [primal.edges[2 * edge]!, primal.edges[2 * edge + 1]!];
    surfaceOfEdge.set(key(a, b), primal.edgeSurface[edge]!);
  }
  const corners = 2 ** dimension;
  return Int32Array.from({ length: primal.quality.length * dimension }, (_, i) => {
    const first = corners * Math.floor(i / dimension);
    const end = first + kAxisEnds[i % dimension]!;
    return surfaceOfEdge.get(key(primal.blocks[first]!, primal.blocks[end]!)) ?? -1;
  });
}

/** Faces on facets that two blocks share; each once, as the block that comes first sees it. */
function interfacesOfTags(dimension: 2 | 3, blocks: Int32Array, tags: Int32Array): FacetFaces {
  const corners = 2 ** dimension;
  const first = new Map<string, { face: number[]; surface: number }>();
  const faces: number[] = [];
  const facet: number[] = [];
  tags.forEach((tag, i) => {
    if (tag < 0) return;
    const start = corners * Math.floor(i / (2 * dimension));
    const face = blockFaces(dimension)[i % (2 * dimension)]!.map((corner) => blocks[start + corner]!);
    const key = face.toSorted((a, b) => a - b).join(' ');
    const other = first.get(key);
    if (!other) {
      first.set(key, { face, surface: tag >> 1 });
      return;
    }
    faces.push(...other.face);
    facet.push(other.surface);
  });
  return { faces: Int32Array.from(faces), facet: Int32Array.from(facet) };
}

/** Faces (2D: edges) of a block from outside, at the low and the high end of each axis. */
function blockFaces(dimension: 2 | 3): readonly (readonly number[])[] {
  return dimension === 2
    ? [
        [3, 0],
        [1, 2],
        [0, 1],
        [2, 3],
      ]
    : [
        [0, 4, 7, 3],
        [1, 2, 6, 5],
        [0, 1, 5, 4],
        [3, 7, 6, 2],
        [0, 3, 2, 1],
        [4, 5, 6, 7],
      ];
}

/** Faces of blocks on facets that have parts on both sides; each once, as the block that comes first sees it. */
function interfacesOf({ dimension, primal, parts, reference }: RunResult): FacetFaces {
  const kFacet = 0; // of surfaceKind
  const corners = 2 ** dimension;
  const far = dimension === 2 ? kFarEdges : kFarFaces;
  const seen = new Set<string>();
  const faces: number[] = [];
  const facet: number[] = [];
  primal.blockSides.forEach((side, i) => {
    const surface = parts.sideTag[side]! >> 1; // a tag is 2 * surface, plus 1 in front of it
    if (parts.sideOpposite[side]! < 0 || reference.surfaceKind[surface] !== kFacet) return;
    const block = Math.floor(i / dimension);
    const face = far[i % dimension]!.map((corner) => primal.blocks[corners * block + corner]!);
    const key = face.toSorted((a, b) => a - b).join(' ');
    if (seen.has(key)) return;
    seen.add(key);
    faces.push(...face);
    facet.push(surface);
  });
  return { faces: Int32Array.from(faces), facet: Int32Array.from(facet) };
}
