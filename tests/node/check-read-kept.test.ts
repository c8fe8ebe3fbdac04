// The checker's readers on small files that VTK, Gmsh and meshio wrote, kept in tests/fixtures/meshes: two cubes side by
// side along x, of the regions 7 and 3. Then on what is left of these files when they are cut or damaged.
import { readdirSync, readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { checkMesh, defaultCheckSettings } from '../../wasm/check/check.ts';
import type { Mesh } from '../../wasm/check/mesh.ts';
import { meshReader } from '../../wasm/check/read-mesh.ts';
import { DualblockError } from '../../wasm/io/errors.ts';
import { randomNumbers } from './support/block-meshes.ts';
import { blockLines } from './support/same-mesh.ts';
import { twoCubes } from './support/small-meshes.ts';
import { writeVtk } from './support/writers.ts';

const folder = new URL('../fixtures/meshes/', import.meta.url);
const names = readdirSync(folder).sort();
const bytesOf = (name: string): Uint8Array => readFileSync(new URL(name, folder));
const read = (name: string, bytes: Uint8Array): Mesh => meshReader(name)(bytes);
const ours = meshReader('a.vtk')(new TextEncoder().encode(writeVtk(twoCubes)));

/** The lines without what Gmsh turns: it may begin a block's corners elsewhere. */
const cornersOf = (mesh: Mesh): string[] =>
  blockLines(mesh, ours)
    .map((line) => {
      const [corners = '', region] = line.split(': ');
      return `${corners.split(' ').sort().join(' ')}: ${region}`;
    })
    .sort();

describe('files of other programs', () => {
  it.each(names)('%s', (name) => {
    const mesh = read(name, bytesOf(name));
    expect(mesh.regions).toBeDefined();
    if (name === 'gmsh-binary.vtk') {
      // Gmsh numbers its entities here, and groups them nowhere.
      expect(mesh.regions).toMatchObject({ isNumbered: false, source: 'cell data "CellEntityIds"' });
      mesh.regions!.ofBlock = mesh.regions!.ofBlock.map((entity) => [0, 3, 7][entity]!);
    } else expect(mesh.regions?.isNumbered).toBe(true);
    expect(cornersOf(mesh)).toEqual(cornersOf(ours));
    const { findings, measure } = checkMesh(mesh, null, defaultCheckSettings);
    expect(findings.failures).toEqual([]);
    expect(measure).toBe(2);
  });
});

/** The mesh, or null where it is refused; whatever else is thrown is a fault. */
function readOrRefuse(name: string, bytes: Uint8Array, how: string): Mesh | null {
  try {
    return read(name, bytes);
  } catch (error) {
    if (error instanceof DualblockError) return null;
    throw new Error(`${how}: ${error}`, { cause: error });
  }
}

describe('what is left of a file', () => {
  it.each(names)('%s cut anywhere is refused, or only data are lost', (name) => {
    const bytes = bytesOf(name);
    const whole = [...read(name, bytes).blocks];
    const step = bytes.length > 1000 ? 3 : 1;
    for (let length = bytes.length - 1; length >= 0; length -= step) {
      const mesh = readOrRefuse(name, bytes.subarray(0, length), `${length} bytes`);
      // Abaqus's files do not say how much they hold.
      if (mesh && !name.endsWith('.inp')) expect([...mesh.blocks]).toEqual(whole);
    }
  });

  it.each(names)('%s with any bytes changed is refused, or some mesh', (name) => {
    const seen = { refused: 0, read: 0 };
    for (let seed = 1; seed <= 200; seed++) {
      const random = randomNumbers(seed);
      const bytes = Uint8Array.from(bytesOf(name));
      for (let k = 0; k < 1 + 3 * random(); k++)
        bytes[Math.floor(random() * bytes.length)] = random() < 0.3 ? 255 : 256 * random();
      seen[readOrRefuse(name, bytes, `seed ${seed}`) ? 'read' : 'refused']++;
    }
    console.log(`${name}, seeds 1 to 200:`, seen);
    expect(seen.refused).toBeGreaterThan(20);
  });
});
