// From a run's result to the block mesh that the writers take.
import type { RunResult } from '../result.ts';
import type { BlockMesh, FacetFaces } from './block-mesh.ts';

/** The block mesh of a result, as the writers take it; it shares arrays with the result. */
export function blockMesh(result: RunResult): BlockMesh {
  const { dimension, name, title, primal, parts, reference, domain, mesh } = result;
  const { positions, blocks, blockPart, quality, boundaryFaces, boundaryFacet } = mesh ?? primal;
  const several = parts.region.some((region) => region !== parts.region[0]);
  const interfaces = interfacesOf(dimension, blocks, mesh ? mesh.blockTags : layeredTags(result));
  return {
    dimension,
    name: title || name,
    positions,
    blocks,
    part: blockPart,
    ...(several ? { region: blockPart.map((part) => parts.region[part]!) } : {}),
    quality,
    surfaces: mesh ? mesh.blockSurfaces : layeredSurfaces(result),
    boundary: { faces: boundaryFaces, facet: boundaryFacet },
    ...(interfaces.facet.length > 0 ? { interfaces } : {}),
    ...(domain.facetNames ? { facetNames: domain.facetNames } : {}),
    patchOfFacet: reference.surfacePatch.slice(0, domain.facetOffsets.length - 1),
  };
}

/** The D̄-surface that crosses each block of the layered mesh along each axis. */
export function layeredSurfaces({ primal, contributions }: RunResult): Int32Array {
  return primal.blockSides.map((side) => contributions.surfaceOfSide[side]!);
}

/** Tags of the layered mesh's faces, as `blockTags` of the final one: low faces are towards the part's centre. */
function layeredTags({ primal, parts, reference }: RunResult): Int32Array {
  const kFacet = 0; // of surfaceKind
  return Int32Array.from({ length: 2 * primal.blockSides.length }, (_, i) => {
    if (i % 2 === 0) return -1;
    const tag = parts.sideTag[primal.blockSides[i >> 1]!]!;
    return reference.surfaceKind[tag >> 1] === kFacet ? tag : -1; // a tag is 2 * surface, plus 1 in front of it
  });
}

/** Faces on facets that two blocks share; each once, as the block that comes first sees it. */
function interfacesOf(dimension: 2 | 3, blocks: Int32Array, tags: Int32Array): FacetFaces {
  const corners = 2 ** dimension;
  const local = blockFaces(dimension);
  const found = new Map<string, { face: number[]; surface: number; twice: boolean }>();
  tags.forEach((tag, i) => {
    if (tag < 0) return;
    const start = corners * Math.floor(i / local.length);
    const face = local[i % local.length]!.map((corner) => blocks[start + corner]!);
    const key = face.toSorted((a, b) => a - b).join(' ');
    const first = found.get(key);
    if (first) first.twice = true;
    else found.set(key, { face, surface: tag >> 1, twice: false });
  });
  const shared = [...found.values()].filter(({ twice }) => twice);
  return {
    faces: Int32Array.from(shared.flatMap(({ face }) => face)),
    facet: Int32Array.from(shared, ({ surface }) => surface),
  };
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
