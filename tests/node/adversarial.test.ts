// Files that once met a wrong verdict on the command line, each with what is right.
import { describe, expect, it } from 'vitest';
import { useCommandLine } from './support/command-line.ts';
import { repositoryFile } from './support/core.ts';

const { dualblock, write } = useCommandLine();
const copy = (path: string): string => {
  const name = path.replace(/^.*\//, '');
  write(name, repositoryFile(`tests/fixtures/${path}`));
  return name;
};

describe('meshes that --check has to accept', () => {
  it.each([
    ['hull_sphere_50_3', []], // was taken for a ball; a quarter of it was missing
    ['circle64', []],
    ['aniso_1e4', []], // one ten-thousandth as high as wide: right, and refused
    ['slot_5e-6', []], // a slot of five millionths of its width: right, and refused
    ['aniso_1e4', ['--mode', 'coarsest']],
    ['slot_5e-6', ['--mode', 'coarsest']],
    ['nested_rings_extruded', []], // islands in the holes of facets
    ['nested_rings_extruded', ['--refine', '4']],
    ['hull_sphere_50_3', ['--refine', '4']],
  ])('%s %j', (name, options) => {
    const domain = copy(`adversarial/${name}.json`);
    const made = dualblock(domain, '-o', 'mesh.vtk', '--quiet', ...options);
    expect({ status: made.status, stderr: made.stderr }).toEqual({ status: 0, stderr: '' });
    const { status, stdout } = dualblock('--check', 'mesh.vtk', domain);
    expect(stdout).toMatch(/\n {2}valid: /);
    expect(status).toBe(0);
  });

  it('a ring whose square section makes a quarter of a turn', { timeout: 120000 }, () => {
    const domain = copy('wrong-meshes/torus_twist1_24.json'); // 42 % were missing
    expect(dualblock(domain, '-o', 'ring.vtk', '--quiet').status).toBe(0);
    const { status, stdout } = dualblock('--check', 'ring.vtk', domain);
    expect(stdout).toMatch(/\n {2}valid: /);
    expect(status).toBe(0);
  });

  it('a file of meshio, of VTK version 5.1', () => {
    const { status, stdout, stderr } = dualblock('--check', copy('adversarial/k_meshio_ascii51.vtk'));
    expect({ status, stderr }).toEqual({ status: 0, stderr: '' });
    expect(stdout).toMatch(/^k_meshio_ascii51\.vtk: \d+ blocks \(hexahedra\), \d+ nodes/);
  });
});

describe('domains that are none', () => {
  const refusal = (path: string) => {
    const { status, stderr } = dualblock(copy(path), '-o', 'none.vtk', '--quiet');
    expect(status).toBe(1);
    return stderr;
  };

  it('two cubes that cross: the triangles, and where they cross', () => {
    const message = refusal('adversarial/g10_overlapping.stl');
    const places = [...message.matchAll(/\d+ and \d+ (?:meet )?at \(([^)]*)\)/g)].map(([, place]) => place);
    expect(places).toHaveLength(8); // of the crossing triangles the first few
    const corners = ['1, 1, 2', '1, 2, 1', '1, 2, 2', '2, 1, 1', '2, 1, 2', '2, 2, 1'];
    expect(corners).toEqual(expect.arrayContaining(places));
    expect(new Set(places).size).toBeGreaterThan(3);
    expect(message).toMatch(/, and others: \d+ pairs in all, where they share no edge/);
  });

  it('the tip of a cavity in a wall', () => {
    expect(refusal('adversarial/cavity_touch_wall_point.json')).toMatch(/facets 5 and 9 meet at \(2, 2, 4\)/);
  });

  it('a wave that crosses itself', () => {
    expect(refusal('adversarial/s_wave3.json')).toMatch(
      /crosses or touches itself: facets \d+ and \d+ meet at/,
    );
  });
});
