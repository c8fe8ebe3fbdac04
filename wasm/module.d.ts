// What wasm/bindings.cpp exports. The generated module has no declarations of its own.
declare module '*/build/dualblock.mjs' {
  import type { LoadAnswer, RunAnswer } from './result.ts';

  export interface RawSettings {
    edgeLength: number;
    seed: number;
    tolerance: number;
    /** Below 0: automatic. */
    featureAngle: number;
    timeLimit: number;
    /** 0 or 1. */
    relax: number;
    history: number;
    /** 0: the layered mesh, 1: as coarse as can be. */
    coarsest: number;
    /** 0: parts that give few blocks, 1: parts that give the best shape. */
    shape: number;
    extract: readonly number[];
    insertFacets: Int32Array;
    insertShares: Float64Array;
  }

  export interface RawSession {
    load(format: string, bytes: Uint8Array): LoadAnswer;
    loadSurface(points: Float64Array, offsets: Int32Array, corners: Int32Array): LoadAnswer;
    setName(name: string): void;
    run(settings: RawSettings, progress: ((stage: string, done: number) => void) | null): RunAnswer;
    delete(): void;
  }

  export interface CoreModule {
    Session: new () => RawSession;
    /** Bytes that the core has allocated at this moment. */
    heapInUse(): number;
    /** The whole WebAssembly memory; it grows and never shrinks. */
    HEAPU8: Uint8Array;
  }

  export default function createDualblock(options?: {
    wasmBinary?: Uint8Array | ArrayBuffer;
    /** TetGen prints what it finds wrong, even when asked to be quiet. */
    print?: (line: string) => void;
  }): Promise<CoreModule>;
}

declare module '*/build/refinement.mjs' {
  import type { RefineAnswer, RefineInput } from './refine.ts';

  export interface RefinementModule {
    refine(
      mesh: RefineInput,
      options: {
        intervals: number;
        /** 0: by intervals. */
        size: number;
        /** Elements, at most. */
        limit: number;
        /** D̄-surface and intervals, one after the other. */
        ofSurface: Int32Array;
        gradedFacets: Int32Array;
        growths: Float64Array;
      },
      progress: ((done: number) => void) | null,
    ): RefineAnswer;
  }

  export default function createRefinement(options?: {
    wasmBinary?: Uint8Array | ArrayBuffer;
  }): Promise<RefinementModule>;
}
