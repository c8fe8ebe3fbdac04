// Comparing pictures.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import pixelmatch from 'pixelmatch';
import { PNG } from 'pngjs';
import { expect } from 'vitest';

const golden = new URL('../../golden/', import.meta.url);
const failed = new URL('../../../build/pictures/', import.meta.url);

/** Share of pixels that differ visibly; 1 for pictures of different sizes. */
export function difference(a: Buffer, b: Buffer): { share: number; picture: PNG | null } {
  const [p, q] = [PNG.sync.read(a), PNG.sync.read(b)];
  if (p.width !== q.width || p.height !== q.height) return { share: 1, picture: null };
  const picture = new PNG({ width: p.width, height: p.height });
  const count = pixelmatch(p.data, q.data, picture.data, p.width, p.height, { threshold: 0.15 });
  return { share: count / (p.width * p.height), picture };
}

/**
 * Compares with tests/golden/NAME.png: at most 1 % of the pixels may differ. UPDATE_GOLDEN=1 writes the pictures instead.
 * What differs goes to build/pictures/.
 */
export function expectGolden(name: string, picture: Buffer): void {
  const file = new URL(`${name}.png`, golden);
  if (process.env['UPDATE_GOLDEN']) {
    mkdirSync(golden, { recursive: true });
    writeFileSync(file, picture);
    return;
  }
  const { share, picture: marked } = difference(readFileSync(file), picture);
  if (share > 0.01) {
    mkdirSync(failed, { recursive: true });
    writeFileSync(new URL(`${name}.png`, failed), picture);
    if (marked) writeFileSync(new URL(`${name}-difference.png`, failed), PNG.sync.write(marked));
  }
  expect(share, `${name} differs from tests/golden/${name}.png, see build/pictures`).toBeLessThanOrEqual(
    0.01,
  );
}

/** How many pixels are about of a colour. */
export function countColour(picture: Buffer, [r, g, b]: readonly number[], within = 24): number {
  const { data } = PNG.sync.read(picture);
  let n = 0;
  for (let k = 0; k < data.length; k += 4)
    if (Math.max(Math.abs(data[k]! - r!), Math.abs(data[k + 1]! - g!), Math.abs(data[k + 2]! - b!)) <= within)
      n++;
  return n;
}

/** How many different colours there are: a blank picture has one or two. */
export function colours(picture: Buffer): number {
  const { data } = PNG.sync.read(picture);
  const seen = new Set<number>();
  for (let k = 0; k < data.length; k += 4) seen.add((data[k]! << 16) | (data[k + 1]! << 8) | data[k + 2]!);
  return seen.size;
}
