// The typed module around the core: the same in the page, in a worker and in Node.
import createDualblock, { type CoreModule } from './build/dualblock.mjs';
import { DualblockError } from './io/errors.ts';
import { mergedNames, namesInFile } from './io/facet-names.ts';
import { readSurface, type Surface, type SurfaceFormat } from './io/surface-readers.ts';
import type { CoreError, Polygons, RunResult } from './result.ts';
import { defaultSettings, formatOf, type Settings } from './settings.ts';

export { defaultSettings, formatOf, type InputFormat, inputFormats, type Settings } from './settings.ts';

export type Progress = (stage: string, done: number) => void;

const surfaceFormats: readonly string[] = ['stl', 'obj', 'ply'] satisfies SurfaceFormat[];
const raise = (error: CoreError, given?: Polygons): never => {
  throw new DualblockError(error.code, error.message, error.entities, given);
};

/** A domain at a time, and runs on it. Call dispose() when done: the core's memory is not collected by itself. */
export class Dualblock {
  private readonly module: CoreModule;
  private readonly session;
  /** Of the facets as loaded; empty where none has a name. */
  private names: string[] = [];

  /** Names of the facets of the domain that is loaded, as the input counts them; empty where it gives none. */
  get facetNames(): readonly string[] {
    return this.names;
  }

  private constructor(module: CoreModule) {
    this.module = module;
    this.session = new module.Session();
  }

  /** Starts the core. In Node, pass the bytes of dualblock.wasm; a browser finds them by itself. */
  static async create(options: { wasmBinary?: Uint8Array } = {}): Promise<Dualblock> {
    return new Dualblock(await createDualblock({ ...options, print: () => {} }));
  }

  /**
   * Loads a domain from a file's bytes; `name` gives the format by its extension. Throws a DualblockError and keeps the
   * domain loaded before.
   */
  load(name: string, bytes: Uint8Array): void {
    const format = formatOf(name);
    const surface = surfaceFormats.includes(format) ? readSurface(format as SurfaceFormat, bytes) : null;
    const names = surface ? surface.names : namesInFile(format, bytes);
    const answer = surface ? this.loadSurface(surface) : this.session.load(format, bytes);
    if (!answer.ok) raise(answer.error);
    this.names = names;
    if (format !== 'json') this.session.setName(name.replace(/^.*[\\/]/, '').replace(/\.[^.]*$/, ''));
  }

  /** Runs every stage on the loaded domain. Throws a DualblockError for bad input. */
  run(settings: Partial<Settings> = {}, progress: Progress | null = null): RunResult {
    const wanted = { ...defaultSettings, ...settings };
    const featureAngle = wanted.featureAngle === 'auto' ? -1 : wanted.featureAngle;
    const { mode, objective, relax, history, insert } = wanted;
    const raw = {
      featureAngle,
      coarsest: Number(mode === 'coarsest'),
      shape: Number(objective === 'shape'),
      relax: Number(relax),
      history: Number(history),
      insertFacets: Int32Array.from(
        insert.flatMap(({ facet }) => [facet].flat().map((f, k) => (k > 0 ? ~f : f))),
      ),
      insertShares: Float64Array.from(insert.flatMap(({ facet, share }) => [facet].flat().map(() => share))),
    };
    const answer = this.session.run({ ...wanted, ...raw }, progress);
    if (!answer.ok) return raise(answer.error, answer.given);
    const { domain } = answer;
    if (this.names.length > 0)
      domain.facetNames = mergedNames(this.names, domain.facetOfGiven, domain.facetOffsets.length - 1);
    return answer;
  }

  /** Bytes of the core's memory: all that it ever needed, and what is in use now. */
  memory(): { peak: number; inUse: number } {
    return { peak: this.module.HEAPU8.length, inUse: this.module.heapInUse() };
  }

  dispose(): void {
    this.session.delete();
  }

  private loadSurface({ points, polygons }: Surface) {
    return this.session.loadSurface(points, polygons.offsets, polygons.corners);
  }
}
