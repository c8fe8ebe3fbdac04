// The core in Chromium: in a module worker through the page's client, and in the page's own thread.

import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { Dualblock } from '../../wasm/dualblock.ts';
import { DualblockError } from '../../wasm/io/errors.ts';
import { writeJson } from '../../wasm/io/write-json.ts';
import { noRefinement, refineInput } from '../../wasm/refine.ts';
import { CoreClient } from '../../web/src/core/core-client.ts';
import { packResult } from '../../web/src/core/pack.ts';

let client = new CoreClient();
let ring: Uint8Array;
beforeAll(async () => {
  ring = new Uint8Array(await (await fetch('/examples/square_ring.json')).arrayBuffer());
});
afterEach(() => {
  client.dispose();
  client = new CoreClient();
});

const off = new TextEncoder().encode('OFF\n4 4 0\n0 0 0\n1 0 0\n');
/** Far more work than a test waits for. */
const long = { edgeLength: 0.02 };

/** Starts a run that takes long; resolves when it is under way. */
async function startLongRun(): Promise<{ outcome: Promise<unknown> }> {
  let outcome: Promise<unknown> = Promise.resolve();
  await new Promise<void>((underWay) => {
    outcome = client.run('ring.json', ring, long, () => underWay()).catch((error: unknown) => error);
  });
  return { outcome };
}

describe('in a module worker', () => {
  it('runs, and reports its progress', async () => {
    const seen: [string, number][] = [];
    const { result, memory } = await client.run('ring.json', ring, {}, (stage, done) =>
      seen.push([stage, done]),
    );
    expect(result.certificate.valid).toBe(true);
    expect(result.primal.blocks).toBeInstanceOf(Int32Array);
    expect(result.primal.blocks).toHaveLength(64 * 8);
    expect(result.primal.positions.byteLength).toBe(144 * 3 * 8);
    expect(memory).toBeGreaterThan(2 ** 20);
    expect(seen[0]).toEqual(['domain', 0]);
    expect(seen.slice(-2).map(([stage]) => stage)).toEqual(['certificate', 'display']);
    expect(seen.length).toBeGreaterThan(5);
  });

  it('takes settings, and gives the same bits as the page’s own thread', async () => {
    const settings = { edgeLength: 0.8, seed: 3 };
    const { result } = await client.run('ring.json', ring, settings);
    const core = await Dualblock.create();
    core.load('ring.json', ring);
    const own = core.run(settings);
    core.dispose();
    expect(own.certificate.valid).toBe(true);
    expect([...writeJson(result)]).toEqual([...writeJson(own)]);
  });

  it('brings an error across as what it is, and goes on', async () => {
    const error = await client.run('a.off', off).catch((e: unknown) => e);
    expect(error).toBeInstanceOf(DualblockError);
    expect(error).toMatchObject({
      code: 'fileTruncated',
      message: expect.stringContaining('2 of the 4'),
      entities: [{ kind: 'line', index: 4 }],
    });
    await expect(client.run('a.step', off)).rejects.toMatchObject({ code: 'formatUnknown' });
    await expect(client.run('ring.json', ring, { seed: -1 })).rejects.toMatchObject({ code: 'badOption' });
    expect((await client.run('ring.json', ring)).result.primal.quality).toHaveLength(64);
  });

  it('packs what is drawn, and moves it instead of copying', async () => {
    const { result, display } = await client.run('ring.json', ring);
    expect(display.blocks.count).toBe(64);
    expect(display.dual.cells.count).toBe(144);
    expect(display.contributions.count).toBe(result.contributions.hardCount + result.contributions.softCount);
    expect(display.blocks.points.buffer.byteLength).toBe(64 * 8 * 3 * 4);
  });

  it('refines blocks, and unpacks what was packed', async () => {
    const { result } = await client.run('ring.json', ring);
    const { positions } = result.primal;
    const refined = await client.refine(refineInput(result), { ...noRefinement, intervals: 2 });
    expect(refined.cells.count).toBe(64 * 8);
    const whole = await client.elements(refineInput(result), { ...noRefinement, intervals: 2 });
    expect(whole.elements.length).toBe(64 * 8 * 8);
    await expect(
      client.refine(refineInput(result), { ...noRefinement, intervals: 200 }),
    ).rejects.toMatchObject({ code: 'badOption' });
    expect(positions.length).toBe(144 * 3); // the page keeps its own
    const again = await client.unpack(await packResult(result));
    expect([...writeJson(again.result)]).toEqual([...writeJson(result)]);
  });

  it('says what is wrong with a packed result', async () => {
    await expect(client.unpack(new Uint8Array([1, 2, 3]))).rejects.toMatchObject({ code: 'internal' });
    expect((await client.run('ring.json', ring)).result.certificate.valid).toBe(true);
  });

  it('brings the domain along when it is at fault', async () => {
    const bent = 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 2 3\n'.replace(
      '3 0 2 3',
      '3 0 2 1',
    );
    const error = await client.run('a.off', new TextEncoder().encode(bent)).catch((e: unknown) => e);
    expect(error).toBeInstanceOf(DualblockError);
    expect((error as DualblockError).given?.vertices).toHaveLength(12);
    expect((error as DualblockError).given?.facetOffsets).toHaveLength(5);
  });

  it('is cancelled at once, and the next run works', async () => {
    const { outcome } = await startLongRun();
    const started = performance.now();
    client.cancel();
    expect(await outcome).toMatchObject({ name: 'AbortError' });
    expect(performance.now() - started).toBeLessThan(200);
    expect((await client.run('ring.json', ring)).result.certificate.valid).toBe(true);
  });

  it('drops a run for a newer one', async () => {
    const { outcome } = await startLongRun();
    const next = client.run('ring.json', ring);
    expect(await outcome).toMatchObject({ name: 'AbortError' });
    expect((await next).result.certificate.valid).toBe(true);
  });

  it('does nothing when there is nothing to cancel', async () => {
    client.cancel();
    expect((await client.run('ring.json', ring)).result.certificate.valid).toBe(true);
    client.cancel();
  });
});

describe('in the page’s own thread', () => {
  it('runs, and throws errors as what they are', async () => {
    const core = await Dualblock.create();
    const seen: string[] = [];
    core.load('ring.json', ring);
    expect(core.run({}, (stage) => seen.push(stage)).primal.quality).toHaveLength(64);
    expect(seen).toContain('primal');
    const code = (work: () => unknown): string => {
      try {
        work();
      } catch (error) {
        if (error instanceof DualblockError) return error.code;
      }
      return 'none';
    };
    expect(code(() => core.load('a.off', off))).toBe('fileTruncated');
    expect(core.run().certificate.valid).toBe(true);
    core.dispose();
  });
});
