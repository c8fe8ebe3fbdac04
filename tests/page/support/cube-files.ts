// A cube in every format that the page opens.
const corners = [
  [0, 0, 0],
  [1, 0, 0],
  [1, 1, 0],
  [0, 1, 0],
  [0, 0, 1],
  [1, 0, 1],
  [1, 1, 1],
  [0, 1, 1],
] as const;
const facets = [
  [0, 3, 2, 1],
  [4, 5, 6, 7],
  [0, 1, 5, 4],
  [1, 2, 6, 5],
  [2, 3, 7, 6],
  [3, 0, 4, 7],
] as const;
const triangles = facets.flatMap(([a, b, c, d]) => [
  [a, b, c],
  [a, c, d],
]);
const lines = (rows: readonly (readonly (number | string)[])[]): string =>
  rows.map((r) => r.join(' ')).join('\n');

export const cubeFiles: Record<string, string> = {
  'cube.json': JSON.stringify({
    format: 'dualblock-domain/1',
    dimension: 3,
    vertices: corners,
    facets: facets.map((loop) => ({ loops: [loop] })),
  }),
  'cube.off': `OFF\n8 6 0\n${lines(corners)}\n${lines(facets.map((f) => [4, ...f]))}\n`,
  'cube.obj': `${lines(corners.map((c) => ['v', ...c]))}\n${lines(facets.map((f) => ['f', ...f.map((v) => v + 1)]))}\n`,
  'cube.ply': `ply\nformat ascii 1.0\nelement vertex 8\nproperty double x\nproperty double y\nproperty double z\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n${lines(corners)}\n${lines(facets.map((f) => [4, ...f]))}\n`,
  'cube.stl': `solid cube\n${triangles
    .map(
      (t) =>
        `facet normal 0 0 0\nouter loop\n${lines(t.map((v) => ['vertex', ...corners[v!]!]))}\nendloop\nendfacet`,
    )
    .join('\n')}\nendsolid cube\n`,
  'cube.poly': `8 3 0 0\n${lines(corners.map((c, k) => [k + 1, ...c]))}\n6 0\n${facets
    .map((f) => `1\n4 ${f.map((v) => v + 1).join(' ')}`)
    .join('\n')}\n0\n0\n`,
  'cube.smesh': `8 3 0 0\n${lines(corners.map((c, k) => [k + 1, ...c]))}\n6 0\n${facets
    .map((f) => `4 ${f.map((v) => v + 1).join(' ')}`)
    .join('\n')}\n0\n0\n`,
};
