// The invariants of a result's arrays.
import { expect } from 'vitest';
import type { RunResult } from '../../../wasm/result.ts';
import { countsOf } from './core.ts';

/** Every array's length follows from few counts, and every id names something. */
export function checkArrays(result: RunResult): void {
  const { dimension: n, domain, features, reference, parts, contributions, primal } = result;
  const simplices = reference.simplices.length / (n + 1);
  const curves = features.angle.length;
  const pieces = contributions.piecePart.length;
  const entries = contributions.side.length;
  const { nodes, edges, faces, blocks } = countsOf(result);
  const lengths: [string, ArrayLike<number>, number][] = [
    ['givenVertex', domain.givenVertex, domain.vertices.length / n],
    ['features.facets', features.facets, 2 * curves],
    ['features.kind', features.kind, curves],
    ['features.ideal', features.ideal, curves],
    ['features.vertexKind', features.vertexKind, features.vertices.length],
    ['features.actual', features.actual, curves],
    ['features.ridgeOffsets', features.ridgeOffsets, curves + 1],
    ['neighbors', reference.neighbors, (n + 1) * simplices],
    ['tags', reference.tags, (n + 1) * simplices],
    ['region', reference.region, simplices],
    ['surfacePatch', reference.surfacePatch, reference.surfaceKind.length],
    ['surfaceSource', reference.surfaceSource, reference.surfaceKind.length],
    ['ofSimplex', parts.ofSimplex, simplices],
    ['sidePart', parts.sidePart, parts.sideTag.length],
    ['sideOpposite', parts.sideOpposite, parts.sideTag.length],
    ['contributions.offsets', contributions.offsets, simplices + 1],
    ['mask', contributions.mask, entries],
    ['soft', contributions.soft, simplices],
    ['surfaceOfSide', contributions.surfaceOfSide, parts.sideTag.length],
    ['classOffset', contributions.classOffset, simplices + 1],
    ['pieceCell', contributions.pieceCell, pieces],
    ['pieceSides', contributions.pieceSides, n * pieces],
    ['nodePiece', primal.nodePiece, nodes],
    ['edgeSurface', primal.edgeSurface, edges],
    ['faceSurfaces', primal.faceSurfaces, 2 * faces],
    ['blocks', primal.blocks, 2 ** n * blocks],
    ['blockPart', primal.blockPart, blocks],
    ['blockSides', primal.blockSides, n * blocks],
    ['boundaryFaces', primal.boundaryFaces, 2 ** (n - 1) * primal.boundaryFacet.length],
  ];
  expect(lengths.map(([name, array]) => [name, array.length])).toEqual(
    lengths.map(([name, , length]) => [name, length]),
  );

  const offsets: [string, Int32Array, number][] = [
    ['facetOffsets', domain.facetOffsets, domain.loopOffsets.length - 1],
    ['loopOffsets', domain.loopOffsets, domain.loopVertices.length],
    ['ridgeOffsets', features.ridgeOffsets, features.ridgeNodes.length],
    ['contributions.offsets', contributions.offsets, entries],
    ['classOffset', contributions.classOffset, contributions.pieceOfClass.length],
  ];
  for (const [name, array, end] of offsets) {
    expect([array[0], array.at(-1)], name).toEqual([0, end]);
    expect(
      array.every((value, i) => i === 0 || value >= (array[i - 1] ?? 0)),
      name,
    ).toBe(true);
  }

  const sides = parts.sideTag.length;
  const facets = domain.facetOffsets.length - 1;
  const ids: [string, ArrayLike<number>, number, number][] = [
    ['loopVertices', domain.loopVertices, 0, domain.vertices.length / n],
    ['facetOfGiven', domain.facetOfGiven, 0, facets],
    ['ridgeNodes', features.ridgeNodes, 0, features.nodes.length / n],
    ['features.facets', features.facets, 0, facets],
    ['features.kind', features.kind, 1, 5],
    ['features.ideal', features.ideal, 1, 5],
    ['features.vertices', features.vertices, 0, features.nodes.length / n],
    ['features.vertexKind', features.vertexKind, 0, 4],
    ['simplices', reference.simplices, 0, reference.nodes.length / n],
    ['neighbors', reference.neighbors, -1, simplices],
    ['tags', reference.tags, -1, 2 * reference.surfaceKind.length],
    ['surfaceKind', reference.surfaceKind, 0, 5],
    ['surfacePatch', reference.surfacePatch, -1, facets],
    ['ofSimplex', parts.ofSimplex, 0, parts.count],
    ['sidePart', parts.sidePart, 0, parts.count],
    ['sideOpposite', parts.sideOpposite, -1, sides],
    ['contributions.side', contributions.side, 0, sides],
    ['mask', contributions.mask, 1, 2 ** (n + 1) - 1],
    ['surfaceOfSide', contributions.surfaceOfSide, 0, contributions.surfaces],
    ['pieceOfClass', contributions.pieceOfClass, 0, pieces],
    ['piecePart', contributions.piecePart, 0, parts.count],
    ['pieceCell', contributions.pieceCell, 0, contributions.cells],
    ['pieceSides', contributions.pieceSides, -1, sides],
    ['nodePiece', primal.nodePiece, 0, pieces],
    ['edges', primal.edges, 0, nodes],
    ['edgeSurface', primal.edgeSurface, 0, contributions.surfaces],
    ['faces', primal.faces, 0, nodes],
    ['faceSurfaces', primal.faceSurfaces, 0, contributions.surfaces],
    ['blocks', primal.blocks, 0, nodes],
    ['blockPart', primal.blockPart, 0, parts.count],
    ['blockSides', primal.blockSides, 0, sides],
    ['boundaryFaces', primal.boundaryFaces, 0, nodes],
    ['boundaryFacet', primal.boundaryFacet, 0, facets],
  ];
  for (const [name, array, low, high] of ids) {
    const mayBeEmpty = reference.bentSides > 0 && /^(features|ridge)/.test(name); // a ball has no curve
    if (!mayBeEmpty) expect(array.length, name).toBeGreaterThan(0);
    const wrong = Array.from(array).find((id) => id < low || id >= high);
    expect(wrong, `${name}, from ${low} to below ${high}`).toBeUndefined();
  }

  expect(contributions.cells, 'one primal node in each D-bar-cell').toBe(nodes);
  reference.neighbors.forEach((t, k) => {
    const s = Math.floor(k / (n + 1));
    if (t >= 0) expect(Array.from(reference.neighbors.subarray(t * (n + 1), (t + 1) * (n + 1)))).toContain(s);
  });
}
