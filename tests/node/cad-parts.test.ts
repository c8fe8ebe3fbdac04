// Parts as a modeller makes them: Gmsh's OpenCASCADE kernel builds and tessellates them, and each is cut, not filled with
// simplices; `--check`'s checker, which shares no code with the core, finds the mesh valid for the tessellation.
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { checkMesh, defaultCheckSettings } from '../../wasm/check/check.ts';
import { domainReader } from '../../wasm/check/read-domain.ts';
import { meshReader } from '../../wasm/check/read-mesh.ts';
import type { Dualblock } from '../../wasm/dualblock.ts';
import { runFile, startCore } from './support/core.ts';
import { hasProgram, runIn, useFolder } from './support/programs.ts';
import { bytesOf } from './support/surface-files.ts';
import { meshWriter } from './support/writers.ts';

/** What is left of volume `from` without the tools. */
const drill = (from: number, ...tools: readonly [kind: string, ...dimensions: number[]][]): string =>
  `${tools.map(([kind, ...dimensions], k) => `${kind}(${100 + k})={${dimensions.join()}};`).join('')}
  BooleanDifference{Volume{${from}};Delete;}{Volume{100:${99 + tools.length}};Delete;}`;

interface Part {
  name: string;
  /** Facets around a full turn. */
  turn: number;
  /** No more than by hand, or than the run that this test was written after; simplices give thousands. */
  blocks: number;
  script: string;
}
const parts: readonly Part[] = [
  {
    name: 'plate with a counterbore',
    turn: 12,
    blocks: 96,
    script: `Box(1)={-1,-1,0,2,2,.5}; ${drill(1, ['Cylinder', 0, 0, -1, 0, 0, 3, 0.3], ['Cylinder', 0, 0, 0.2, 0, 0, 0.9, 0.6])}`,
  },
  {
    name: 'bracket',
    turn: 12,
    blocks: 92,
    script: `Box(1)={0,0,0,3,2,.4}; Box(2)={0,0,0,.4,2,2}; BooleanUnion(3)={Volume{1};Delete;}{Volume{2};Delete;};
      ${drill(3, ['Cylinder', 2, 1, -1, 0, 0, 3, 0.3], ['Cylinder', -1, 1, 1.3, 3, 0, 0, 0.3])}`,
  },
  {
    name: 'flange',
    turn: 12,
    blocks: 224,
    script: `Cylinder(1)={0,0,0,0,0,.4,2}; Cylinder(2)={0,0,0,0,0,2,1}; BooleanUnion(3)={Volume{1};Delete;}{Volume{2};Delete;};
      ${drill(3, ['Cylinder', 0, 0, -1, 0, 0, 4, 0.6], ['Cylinder', 1.5, 0, -1, 0, 0, 4, 0.2], ['Cylinder', -1.5, 0, -1, 0, 0, 4, 0.2], ['Cylinder', 0, 1.5, -1, 0, 0, 4, 0.2], ['Cylinder', 0, -1.5, -1, 0, 0, 4, 0.2])}`,
  },
  {
    name: 'rod with two eyes, finely tessellated, whose facets tilt',
    turn: 32,
    blocks: 100,
    script: `Cylinder(1)={0,0,0,0,0,.4,1};Cylinder(2)={4,0,0,0,0,.4,.6};Box(3)={0,-.4,0,4,.8,.4};
      BooleanUnion(4)={Volume{1};Delete;}{Volume{2,3};Delete;};
      ${drill(4, ['Cylinder', 0, 0, -1, 0, 0, 3, 0.5], ['Cylinder', 4, 0, -1, 0, 0, 3, 0.3])}`,
  },
  {
    name: 'dumbbell, whose rims would be cut by cones',
    turn: 12,
    blocks: 104,
    script: `Cylinder(1)={0,0,0,0,0,4,.4}; Sphere(2)={0,0,0,1}; Sphere(3)={0,0,4,1};
      BooleanUnion{Volume{1};Delete;}{Volume{2,3};Delete;}`,
  },
  {
    name: 'tee of equal pipes, whose crease fades out',
    turn: 16,
    blocks: 80,
    script: `Cylinder(1)={-3,0,0,6,0,0,1}; Cylinder(2)={0,0,0,0,0,3,1}; BooleanUnion{Volume{1};Delete;}{Volume{2};Delete;}`,
  },
  {
    name: 'tee of unequal pipes',
    turn: 20,
    blocks: 80,
    script: `Cylinder(1)={-3,0,0,6,0,0,1}; Cylinder(2)={0,0,0,0,0,3,.5}; BooleanUnion{Volume{1};Delete;}{Volume{2};Delete;}`,
  },
  {
    name: 'hollow tee',
    turn: 20,
    blocks: 248,
    script: `Cylinder(1)={-3,0,0,6,0,0,1}; Cylinder(2)={0,0,0,0,0,3,.6}; BooleanUnion(3)={Volume{1};Delete;}{Volume{2};Delete;};
      ${drill(3, ['Cylinder', -3, 0, 0, 6, 0, 0, 0.8], ['Cylinder', 0, 0, 0, 0, 0, 3, 0.45])}`,
  },
  {
    name: 'box with a ball for a void, one of whose facets stands askew',
    turn: 12,
    blocks: 76,
    script: `Box(1)={-1,-1,-1,2,2,2}; ${drill(1, ['Sphere', 0, 0, 0, 0.5])}`,
  },
  {
    name: 'angle with a rounded inner edge',
    turn: 16,
    blocks: 48,
    script: `Box(1)={0,0,0,3,2,.4}; Box(2)={0,0,0,.4,2,2}; BooleanUnion(3)={Volume{1};Delete;}{Volume{2};Delete;};
      Fillet{3}{18}{0.2}`,
  },
  {
    name: 'pin with rounded ends',
    turn: 24,
    blocks: 176,
    script: 'Cylinder(1)={0,0,0,0,0,2,.5}; Fillet{1}{1,3}{0.2}',
  },
  {
    name: 'plate with a pocket of rounded corners',
    turn: 12,
    blocks: 184,
    script: `Box(1)={0,0,0,4,3,1}; Box(2)={.5,.5,.5,3,2,1}; Fillet{2}{13,15,17,19}{0.4}
      BooleanDifference{Volume{1};Delete;}{Volume{2};Delete;}`,
  },
  {
    name: 'crossing pipes of one width',
    turn: 24,
    blocks: 96,
    script: `Cylinder(1)={-3,0,0,6,0,0,1}; Cylinder(2)={0,0,-3,0,0,6,1}; BooleanUnion{Volume{1};Delete;}{Volume{2};Delete;}`,
  },
  {
    name: 'box with all edges rounded',
    turn: 12,
    blocks: 32,
    script: 'Box(1)={0,0,0,4,3,2}; Fillet{1}{1:12}{0.5}',
  },
  {
    name: 'torus of coarse facets, whose parts by cuts have good angles and poor blocks',
    turn: 0,
    blocks: 240,
    script: 'Torus(1)={0,0,0,2,0.6}; Mesh.CharacteristicLengthMax=0.5;',
  },
];

const folder = useFolder();
let core: Dualblock;
beforeAll(async () => {
  core = await startCore();
});
afterAll(() => core.dispose());

describe.runIf(hasProgram('gmsh', 'gmsh'))('parts from OpenCASCADE', () => {
  it.each(parts)('$name', ({ script, turn, blocks }) => {
    writeFileSync(
      join(folder, 'part.geo'),
      `SetFactory("OpenCASCADE");\n${script}\nMesh.MeshSizeFromCurvature=${turn};\nMesh.Binary=0;\n`,
    );
    const { status, output } = runIn(
      folder,
      'gmsh',
      '-2',
      '-v',
      '2',
      '-format',
      'stl',
      '-o',
      'part.stl',
      'part.geo',
    );
    expect(status, output).toBe(0);
    const stl = readFileSync(join(folder, 'part.stl'));
    const result = runFile(core, 'part.stl', stl);
    expect(result.certificate.failures).toEqual([]);
    expect(result.certificate.valid).toBe(true);
    expect(result.parts.fallbackReason).toBe('');
    expect(result.primal.quality.length).toBeLessThanOrEqual(blocks);
    const mesh = meshReader('part.vtk')(bytesOf(meshWriter('part.vtk')(result)));
    const { findings } = checkMesh(mesh, domainReader('part.stl')(stl), defaultCheckSettings);
    expect(findings.failures).toEqual([]);
  });
});
