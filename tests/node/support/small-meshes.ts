// Block meshes made by hand, for the writers: two squares, two cubes of different regions.
import type { BlockMesh } from '../../../wasm/io/block-mesh.ts';

/** Two unit squares side by side, crossed by three D̄-curves; six edges on four facets, numbered around. */
export const twoSquares: BlockMesh = {
  dimension: 2,
  name: 'two squares',
  positions: Float64Array.of(0, 0, 1, 0, 2, 0, 0, 1, 1, 1, 2, 1),
  blocks: Int32Array.of(0, 1, 4, 3, 1, 2, 5, 4),
  part: Int32Array.of(0, 1),
  quality: Float64Array.of(1, 0.5),
  surfaces: Int32Array.of(0, 1, 2, 1),
  boundary: {
    faces: Int32Array.of(0, 1, 1, 2, 2, 5, 5, 4, 4, 3, 3, 0),
    facet: Int32Array.of(0, 0, 1, 2, 2, 3),
  },
};

/** Two unit cubes side by side along x, regions 7 and 3, with facet 5 between them; facets 0 to 4 and 6 around. */
export const twoCubes: BlockMesh = {
  dimension: 3,
  name: 'two cubes',
  positions: Float64Array.from(
    [0, 1].flatMap((z) => [0, 1].flatMap((y) => [0, 1, 2].flatMap((x) => [x, y, z]))),
  ),
  blocks: Int32Array.of(0, 1, 4, 3, 6, 7, 10, 9, 1, 2, 5, 4, 7, 8, 11, 10),
  part: Int32Array.of(0, 1),
  region: Int32Array.of(7, 3),
  quality: Float64Array.of(1, 0.5),
  surfaces: Int32Array.of(0, 1, 2, 3, 1, 2),
  boundary: {
    faces: Int32Array.from([
      ...[0, 3, 4, 1, 1, 4, 5, 2], // below
      ...[6, 7, 10, 9, 7, 8, 11, 10], // above
      ...[0, 1, 7, 6, 1, 2, 8, 7], // front
      ...[3, 9, 10, 4, 4, 10, 11, 5], // back
      ...[0, 6, 9, 3], // left
      ...[2, 5, 11, 8], // right
    ]),
    facet: Int32Array.of(0, 0, 1, 1, 2, 2, 3, 3, 4, 6),
  },
  interfaces: { faces: Int32Array.of(1, 4, 10, 7), facet: Int32Array.of(5) },
};
