// Numbers as the module reads them, to the last bit: it does not use the C library's strtod (wasm/strtod.cpp).
// JavaScript's own reading is the other oracle; that native builds read the same is asserted by digests.
import { beforeAll, describe, expect, it } from 'vitest';
import type { Dualblock } from '../../wasm/dualblock.ts';
import { errorOf, runFile, startCore } from './support/core.ts';

let core: Dualblock;
beforeAll(async () => {
  core = await startCore();
});

/** Numbers of 1 to 25 digits around a circle, in every notation. */
const notations: readonly ((x: number, k: number) => string)[] = [
  (x) => String(x),
  (x, k) => x.toFixed(4 + (k % 16)),
  (x, k) => x.toExponential(4 + (k % 20)),
  (x, k) => x.toPrecision(15 + (k % 4)),
  (x) => x.toFixed(6).replace('0.', '000.').replace('-000.', '-0.'),
  (x) => `${(x * 1e20).toFixed(0)}e-20`,
  (x) => `${(x * 1e-30).toFixed(60)}0000E+30`,
];
const inOffOnly: readonly ((x: number, k: number) => string)[] = [
  (x) => x.toFixed(9).replace('0.', '.'),
  (x) => (x < 0 ? String(x) : `+${x}`),
];

/** A polygon whose corners are written so; a turn by less than the angle between corners keeps it convex. */
function corners(
  count: number,
  write: readonly ((x: number, k: number) => string)[],
): (readonly [string, string])[] {
  return Array.from({ length: count }, (_, k) => {
    const angle = (2 * Math.PI * (k + 0.3 * Math.sin(k * k))) / count;
    const text = write[k % write.length] as (x: number, k: number) => string;
    return [text(Math.cos(angle), k), text(Math.sin(angle), k)] as const;
  });
}

describe('decimal notation', () => {
  it('is read to the last bit in JSON', () => {
    const points = corners(70, notations.slice(0, 1).concat(notations.slice(2, 4), notations.slice(5)));
    const text = `{"format": "dualblock-domain/1", "dimension": 2, "vertices": [${points.map((p) => `[${p.join(',')}]`).join(',')}],
      "loops": [[${points.map((_, k) => k).join(',')}]]}`;
    const { domain } = runFile(core, 'a.json', text);
    expect(Array.from(domain.vertices)).toEqual(points.flat().map(Number));
  });

  it('is read to the last bit in OFF', () => {
    const points = corners(60, [...notations, ...inOffOnly]);
    const n = points.length;
    const faces = [
      `${n} ${points.map((_, k) => n - 1 - k).join(' ')}`,
      `${n} ${points.map((_, k) => n + k).join(' ')}`,
      ...points.map((_, k) => `4 ${k} ${(k + 1) % n} ${n + ((k + 1) % n)} ${n + k}`),
    ];
    const rows = ['0', '5.e-1'].flatMap((z) => points.map((p) => `${p.join(' ')} ${z}`));
    const { domain } = runFile(
      core,
      'a.off',
      ['OFF', `${2 * n} ${n + 2} 0`, ...rows, ...faces, ''].join('\n'),
    );
    expect(Array.from(domain.vertices)).toEqual(rows.flatMap((row) => row.split(' ').map(Number)));
  });

  it.each(['1e', '1e+', '.', '-', '1.2.3', '--1', '1e5.5', '0x10', '1,5', 'nan'])('refuses %s', (text) => {
    const bad = `OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 ${text}\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n`;
    expect(errorOf(() => runFile(core, 'a.off', bad)).message).toContain('6');
  });

  it.each(['1e400', '-1e309', '1e99999999999'])('refuses %s: no double holds it', (text) => {
    const bad = `OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 ${text}\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n`;
    expect(errorOf(() => runFile(core, 'a.off', bad)).code).toBe('notFinite');
  });
});
