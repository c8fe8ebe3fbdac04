// Every example's mesh, as written in every format, passes the checker with its domain; broken ones do not, and the
// checker finds the same numbers as the core by other means. The meshes of ../shared/data pass as well.
import { existsSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { beforeAll, describe, expect, it } from 'vitest';
import { checkMesh, defaultCheckSettings } from '../../wasm/check/check.ts';
import { checkNames } from '../../wasm/check/findings.ts';
import type { Mesh } from '../../wasm/check/mesh.ts';
import { domainReader } from '../../wasm/check/read-domain.ts';
import { meshReader } from '../../wasm/check/read-mesh.ts';
import type { Dualblock } from '../../wasm/dualblock.ts';
import { altered, randomNumbers } from './support/block-meshes.ts';
import { curved, exampleBytes, examples, runExample, startCore } from './support/core.ts';
import { box, domainJson, prism, type Solid, together } from './support/solids.ts';
import { bytesOf } from './support/surface-files.ts';
import { meshWriter } from './support/writers.ts';

let core: Dualblock;
beforeAll(async () => {
  core = await startCore();
});

const meshed = examples.map(({ name }) => name).filter((name) => !name.startsWith('figure_12'));
const domainOf = (name: string) => domainReader(`${name}.json`)(exampleBytes(name));
function meshOf(name: string, extension = 'vtk'): Mesh {
  const text = meshWriter(`a.${extension}`)(runExample(core, name));
  return meshReader(`a.${extension}`)(bytesOf(text));
}
const failed = (mesh: Mesh, name: string): string[] => {
  const { verdicts } = checkMesh(mesh, domainOf(name), defaultCheckSettings).findings;
  return checkNames.filter((check) => verdicts[check] === false);
};

describe('meshes of the examples', () => {
  it.each(meshed)('%s', (name) => {
    const { certificate, primal, dimension } = runExample(core, name);
    for (const extension of ['vtk', 'vtu', 'msh', 'mesh', 'json']) {
      const result = checkMesh(meshOf(name, extension), domainOf(name), defaultCheckSettings);
      expect(result.findings.failures).toEqual([]);
      const approximates = curved.includes(name); // then the measure has no verdict
      const notAsked = [approximates ? 'measure' : 'fidelity'];
      const { regions: told, ...others } = result.findings.verdicts;
      expect(others).toEqual(
        Object.fromEntries(
          checkNames
            .filter((check) => check !== 'regions')
            .map((check) => [check, notAsked.includes(check) ? null : true]),
        ),
      );
      expect(told).not.toBe(false);
      expect(result.findings.notes).toEqual(
        extension === 'mesh' || extension === 'msh'
          ? [expect.stringMatching(/of fewer dimensions were left out/)]
          : [],
      );
      expect(result.counts).toMatchObject({
        nodes: primal.positions.length / dimension,
        edges: primal.edges.length / 2,
        blocks: primal.quality.length,
        boundaryFaces: primal.boundaryFacet.length,
      });
      expect(result.measure).toBeCloseTo(certificate.meshMeasure, 12);
      expect(result.comparison?.domainMeasure).toBeCloseTo(certificate.domainMeasure, 12);
      expect(result.geometry.minScaledJacobian).toBeCloseTo(Math.min(...primal.quality), 12);
    }
  });
});

describe('meshes of the examples, broken', () => {
  const solid = [
    'square_ring',
    'protrusion',
    'hexagonal_pyramid',
    'icosahedron',
    'two_holes_2d',
    'vertex_side',
  ];
  it.each(solid)('%s', (name) => {
    const mesh = meshOf(name);
    const size = 2 ** mesh.dimension;
    const random = randomNumbers(name.length);
    const pick = (n: number): number => Math.floor(random() * n);
    for (let round = 0; round < 8; round++) {
      const block = pick(mesh.blocks.length / size);
      const node = mesh.blocks[pick(mesh.blocks.length)] ?? 0;
      const dropped = { ...mesh, blocks: mesh.blocks.filter((_, i) => Math.floor(i / size) !== block) };
      expect(failed(dropped, name)).toContain('measure');
      const doubled = {
        ...mesh,
        blocks: Int32Array.of(...mesh.blocks, ...mesh.blocks.subarray(size * block, size * (block + 1))),
      };
      expect(failed(doubled, name)).toContain('topology');
      const moved = altered(mesh, (m) => m.points.set([1e3, -1e3], 3 * node));
      expect(failed(moved, name).some((check) => check === 'geometry' || check === 'facets')).toBe(true);
      const corner = size * block;
      const swapped = altered(mesh, (m) =>
        m.blocks.set([mesh.blocks[corner + 1] ?? 0, mesh.blocks[corner] ?? 0], corner),
      );
      expect(failed(swapped, name)).toContain('geometry');
      const merged = altered(mesh, (m) => {
        m.blocks = m.blocks.map((id) => (id === node ? (mesh.blocks[corner] ?? 0) : id));
      });
      if (node !== mesh.blocks[corner]) expect(failed(merged, name)).toContain('geometry');
    }
  });

  it('every example is refused for the domain of every other, but for those that are the same', () => {
    const same = /square_2d|end_vertex|protrusion|box_on_box/; // unit squares, and a box on a slab, given several times
    for (const name of meshed) {
      const mesh = meshOf(name);
      for (const other of meshed) {
        if (other === name || (same.test(name) && same.test(other))) continue;
        expect({ name, other, isRefused: failed(mesh, other).length > 0 }).toEqual({
          name,
          other,
          isRefused: true,
        });
      }
    }
  });
});

describe('meshes of assemblies, contacts and curved solids', () => {
  const circle = Array.from({ length: 24 }, (_, k) => [
    Math.cos((Math.PI * k) / 12),
    Math.sin((Math.PI * k) / 12),
  ]);
  /** A lens: its rim's ends are corners of two sides, and a ridge goes up from each and fades out. */
  const lens = (): Solid => {
    const [around, rings] = [24, 5];
    const points = Array.from({ length: around * rings + 1 }, (_, i) => {
      const [turn, height] = [(Math.PI * (i % around)) / (around / 2), Math.floor(i / around) / rings];
      const bulge = Math.sin(turn) * 0.5 * (1 - 0.4 * Math.cos(2 * turn));
      const shrunk = Math.cos((height * Math.PI) / 2);
      const side = Math.acos(Math.cos(turn)) / Math.PI; // 0 to 1, there and back
      return [shrunk * (1 - 2 * side), shrunk * bulge, 0.5 * Math.sin((height * Math.PI) / 2)];
    });
    const facets = [Array.from({ length: around }, (_, k) => around - 1 - k)];
    for (let r = 0; r < rings; r++)
      for (let k = 0; k < around; k++) {
        const [a, b] = [r * around + k, r * around + ((k + 1) % around)];
        if (r + 1 === rings) facets.push([a, b, around * rings]);
        else facets.push([a, b, b + around], [a, b + around, a + around]);
      }
    return { points, facets };
  };
  const cubes = (x: number[]): Solid =>
    together(
      box([0, 0, 0], [1, 1, 1]),
      box(
        x,
        x.map((v) => v + 1),
      ),
    );
  const columnAndBox = together(
    box([0, 0, 0], [1, 1, 1]),
    ...[0, 1, 2].map((z) => box([1, 1, z], [2, 2, z + 1])),
  );
  const placeOf = (loop: number[]): string =>
    loop
      .map((i) => columnAndBox.points[i]?.join())
      .sort()
      .join(' ');
  columnAndBox.facets = columnAndBox.facets.filter(
    (facet, _, all) => all.filter((other) => placeOf(other) === placeOf(facet)).length === 1,
  );
  const regions = [{ point: [1.5, 1.5, 1.5], id: 3 }];
  const nested = together(box([0, 0, 0], [4, 4, 4]), box([1, 1, 1], [2, 2, 2]));
  it.each<[string, string, string[], boolean | null]>([
    ['two boxes that share a facet', domainJson(cubes([1, 0, 0])), [], true],
    ['two boxes that touch along an edge', domainJson(cubes([1, 1, 0])), ['3 boundary'], true],
    ['a column of three boxes and one that touches its edge', domainJson(columnAndBox), ['1 boundary'], true],
    ['two boxes that touch at a vertex', domainJson(cubes([1, 1, 1])), ['1 boundary'], true],
    ['a region in a box', domainJson(nested, { regions }), [], true],
    ['a cylinder', domainJson(prism(circle, 0, 2)), [], null],
    ['a lens', domainJson(lens()), [], null],
  ])('%s', (_, file, notes, measure) => {
    core.load('a.json', bytesOf(file));
    const result = core.run();
    expect(result.certificate.valid).toBe(true);
    const mesh = meshReader('a.vtk')(bytesOf(meshWriter('a.vtk')(result)));
    const { findings } = checkMesh(mesh, domainReader('a.json')(bytesOf(file)), defaultCheckSettings);
    expect(findings.failures).toEqual([]);
    expect(findings.notes).toEqual(notes.map((note) => expect.stringContaining(note)));
    expect(findings.verdicts.measure).toBe(measure);
  });
});

const data = fileURLToPath(new URL('../../../shared/data/', import.meta.url));
const dataFiles = [
  'assembly/example.poly',
  'curved/pinion_small.off',
  'curved/joint.off',
  'planar/mirror.ply',
  'planar/mpi.off',
  'planar/star.off',
  'nasty/multibody.stl',
  'planar/n09o_pyramid.poly',
  'planar/n04o_transition_prism.poly',
];
if (!existsSync(data)) console.log(`skipped: meshes of files in ${data}, which is absent`);
describe.skipIf(!existsSync(data))('meshes of files made by others', () => {
  it.each(dataFiles)('%s', (file) => {
    const bytes = readFileSync(`${data}${file}`);
    core.load(file, bytes);
    const result = core.run();
    expect(result.certificate.valid).toBe(true);
    const mesh = meshReader('a.vtk')(bytesOf(meshWriter('a.vtk')(result)));
    const { findings } = checkMesh(mesh, domainReader(file)(bytes), defaultCheckSettings);
    expect(findings.failures).toEqual([]);
  });
});
