// From a run's result to the block mesh that the writers take.
import type { RefinedMesh } from '../refine.ts';
import type { RunResult } from '../result.ts';
import type { BlockMesh, FacetFaces } from './block-mesh.ts';
import { layeredSurfaces, layeredTags } from './layered.ts';

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

/** The elements of a refined mesh as blocks of their own, which carry their block's part, region and D̄-surfaces. */
export function elementMesh(result: RunResult, refined: RefinedMesh): BlockMesh {
  const { interfaces: _, ...coarse } = blockMesh(result);
  const { dimension, part, region, surfaces } = coarse;
  const { block } = refined;
  const crossing = new Int32Array(dimension * block.length);
  for (let e = 0; e < block.length; e++)
    for (let axis = 0; axis < dimension; axis++)
      crossing[dimension * e + axis] = surfaces![dimension * block[e]! + axis]!;
  const { interfaceFaces, interfaceFacet } = refined;
  return {
    ...coarse,
    positions: refined.positions,
    blocks: refined.elements,
    block,
    part: block.map((b) => part[b]!),
    ...(region ? { region: block.map((b) => region[b]!) } : {}),
    quality: refined.quality,
    surfaces: crossing,
    boundary: { faces: refined.boundaryFaces, facet: refined.boundaryFacet },
    ...(interfaceFacet.length > 0 ? { interfaces: { faces: interfaceFaces, facet: interfaceFacet } } : {}),
  };
}

/** The blocks of a result with the intervals that a refined mesh divides them into, for formats of blocks. */
export function dividedBlocks(result: RunResult, refined: RefinedMesh): BlockMesh {
  // A D̄-surface that is not in the mesh has no intervals, which no block asks for.
  const intervals = refined.intervals.map((n) => Math.max(1, n));
  return { ...blockMesh(result), intervals, spacing: refined };
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
