// Compiled by `tsc`, never run: what a user of the typed module may write, and what the types have to refuse.
import { Dualblock, type InputFormat, type Progress, type Settings } from '../../wasm/dualblock.ts';
import type { ErrorCode } from '../../wasm/error-codes.ts';
import { DualblockError } from '../../wasm/io/errors.ts';
import { meshWriter } from '../../wasm/io/write-mesh.ts';
import { type RefinedMesh, Refiner, refineInput } from '../../wasm/refine.ts';
import { makeReport, type Report } from '../../wasm/report.ts';
import type { Check, RunResult } from '../../wasm/result.ts';

export async function use(bytes: Uint8Array): Promise<Report | ErrorCode> {
  const settings: Settings = {
    edgeLength: 0.5,
    seed: 1,
    tolerance: 1e-6,
    featureAngle: 20,
    timeLimit: 60,
    mode: 'coarsest',
    objective: 'shape',
    extract: [3],
    insert: [{ facet: 0, share: 0.25 }],
    relax: false,
    history: true,
  };
  const progress: Progress = (stage, done) => console.log(stage.toUpperCase(), done.toFixed(2));
  const core = await Dualblock.create({ wasmBinary: bytes });
  try {
    core.load('part.stl', bytes);
    const result: RunResult = core.run({ seed: 2 }, progress);
    const blocks: Int32Array = result.primal.blocks;
    const dimension: 2 | 3 = result.dimension;
    const check: Check | undefined = result.certificate.failures[0]?.check;
    const refiner = await Refiner.create({ wasmBinary: bytes });
    const refined: RefinedMesh = refiner.refine(refineInput(result), { intervals: 3 });
    const file: (string | Uint8Array)[] = [];
    for await (const piece of meshWriter('part.vtk')(result, refined)) file.push(piece);
    console.log(blocks.length, dimension, check, file.length, core.memory().inUse);
    return makeReport(result, settings, core.memory().peak);
  } catch (error) {
    if (error instanceof DualblockError) return error.code;
    throw error;
  } finally {
    core.dispose();
  }
}

export function misuse(core: Dualblock): void {
  // @ts-expect-error a domain needs bytes
  core.load('part.stl');
  // @ts-expect-error no such setting
  core.run({ edge: 1 });
  // @ts-expect-error a setting is a number
  core.run({ seed: '1' });
  // @ts-expect-error the constructor is private
  new Dualblock();
  // @ts-expect-error no such code
  const code: ErrorCode = 'oops';
  // @ts-expect-error no such format
  const format: InputFormat = 'step';
  console.log(code, format);
}
