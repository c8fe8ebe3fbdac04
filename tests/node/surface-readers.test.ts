// The readers of surfaces on files made by others: counts and volumes as they were found before.
import { existsSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';
import { readSurface, type Surface, type SurfaceFormat } from '../../wasm/io/surface-readers.ts';
import { polygons } from './support/surface-files.ts';

const dataFolder = fileURLToPath(new URL('../../../shared/data/', import.meta.url));
const hasData = existsSync(`${dataFolder}PROVENANCE.tsv`);
if (!hasData) console.log('skipped: the surfaces of ../shared/data, a folder that is absent');

describe.runIf(hasData)('surfaces made by others', () => {
  const table = hasData ? readFileSync(`${dataFolder}PROVENANCE.tsv`, 'utf8') : '';
  const rows = table
    .split('\n')
    .map((row) => row.split('\t'))
    .filter(([file = '']) => /\.(stl|obj|ply)$/i.test(file))
    .map((columns) => ({
      file: columns[0] ?? '',
      vertices: Number(columns[5]),
      faces: Number(columns[6]),
      // The volume of an open or misoriented surface depends on the origin, so nothing is compared there.
      volume: columns[7] === 'closed' && !columns[8]?.includes('misoriented') ? Number(columns[13]) : null,
    }));

  it('are seven', () => {
    expect(rows).toHaveLength(7);
  });

  it.each(rows)(
    '$file has $vertices vertices, $faces faces and the volume $volume',
    ({ file, vertices, faces, volume }) => {
      const format = file.slice(-3).toLowerCase() as SurfaceFormat;
      const surface = readSurface(format, readFileSync(dataFolder + file));
      expect(surface.points.length / 3).toBe(vertices);
      expect(surface.polygons.offsets.length - 1).toBe(faces);
      if (volume !== null) expect(signedVolume(surface) / volume).toBeCloseTo(1, 3);
    },
  );

  it('keep the digits of a text beyond single precision', () => {
    const file = `${dataFolder}nasty/Generic_Twin_7863.1.t0_left.obj`;
    const first = readFileSync(file, 'utf8').match(/^v (\S+)/m)?.[1];
    expect(readSurface('obj', readFileSync(file)).points[0]).toBe(Number(first));
  });
});

function signedVolume(surface: Surface): number {
  const point = (id = 0): [number, number, number] => {
    const [x = 0, y = 0, z = 0] = surface.points.subarray(3 * id, 3 * id + 3);
    return [x, y, z];
  };
  let six = 0;
  for (const polygon of polygons(surface)) {
    const [ax, ay, az] = point(polygon[0]);
    for (let i = 1; i + 1 < polygon.length; i++) {
      const [bx, by, bz] = point(polygon[i]);
      const [cx, cy, cz] = point(polygon[i + 1]);
      six += ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx);
    }
  }
  return six / 6;
}
