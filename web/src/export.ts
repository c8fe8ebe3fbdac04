// What leaves the page: pictures, meshes, what is seen as glTF, reports.

import type { AsyncChunks, Chunks } from '../../wasm/io/block-mesh.ts';
import { DualblockError } from '../../wasm/io/errors.ts';
import { refineInput } from '../../wasm/refine.ts';
import { makeReport, refusedElements, summarize } from '../../wasm/report.ts';
import { defaultSettings } from '../../wasm/settings.ts';
import type { App } from './app.ts';
import { refinementOf } from './model/final-mesh.ts';
import type { Model } from './model/model.ts';
import { placeSlice } from './scene/filters.ts';
import { planesOf } from './scene/model-scene.ts';
import { viewToJson } from './state/codec.ts';
import { embedText } from './state/png.ts';

/** Hands a file to the browser. */
export function download(blob: Blob, name: string): void {
  const url = URL.createObjectURL(blob);
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}

const baseName = ({ result, title }: Model): string =>
  (result.name || title || 'domain').replace(/[^\w.-]+/g, '_').slice(0, 80);

/** The picture as a PNG that holds the view; see readers in app.ts. */
async function picture(app: App, scale: number, transparent: boolean): Promise<Blob> {
  const blob = await app.stage.viewer.picture(scale, transparent);
  const bytes = embedText(new Uint8Array(await blob.arrayBuffer()), viewToJson(app.saved()));
  return new Blob([bytes], { type: 'image/png' });
}

export async function pictureOf(app: App, scale: number, transparent: boolean): Promise<void> {
  const { model } = app;
  if (!model) throw new Error('Nothing is shown yet.');
  download(await picture(app, scale, transparent), `${baseName(model)}-step${app.view.state.step}.png`);
  app.say('Picture saved. Drop it here to come back to this view.');
}

/** Bins of the histogram and how many blocks are in each, of the mesh that is handed out. */
function histogramCsv({ result }: Model): string {
  const summary = summarize((result.mesh ?? result.primal).quality);
  const counts = summary?.histogram ?? [];
  const width = 2 / Math.max(1, counts.length);
  const rows = counts.map(
    (n, k) => `${(-1 + k * width).toFixed(1)},${(-1 + (k + 1) * width).toFixed(1)},${n}`,
  );
  return `from,to,blocks\n${rows.join('\n')}\n`;
}

interface Exporter {
  id: string;
  name: string;
  hint: string;
  allowed: (app: App) => boolean;
  save: (app: App, work: Work) => Promise<void>;
}

/** An export under way: told what is being done (`done`: the share, null where nobody knows), and told when to stop. */
export interface Work {
  progress: (text: string, done: number | null) => void;
  signal: AbortSignal;
}

const valid = ({ model }: App): boolean =>
  model?.result.certificate.valid === true && !model.result.onlyMatching;
const any = ({ model }: App): boolean => model !== null;

/** A file of pieces, with pauses for the page between them. */
async function blobOf(pieces: Chunks | AsyncChunks, { progress, signal }: Work): Promise<Blob> {
  const parts: (string | Uint8Array<ArrayBuffer>)[] = [];
  let since = performance.now();
  for await (const piece of pieces) {
    parts.push(piece);
    if (performance.now() - since < 30) continue;
    progress('Writing', null);
    await new Promise((go) => setTimeout(go));
    signal.throwIfAborted();
    since = performance.now();
  }
  return new Blob(parts);
}

/** The elements that are asked for in place of blocks; null for blocks. */
async function elementsOf(app: App, work: Work) {
  if (!app.ui.state.exportsElements) return null;
  const { result } = app.model!;
  const refinement = refinementOf(app.view.state, result);
  return app.core.elements(refineInput(result), refinement, (_, done) => work.progress('Refining', done));
}

/** Only certified meshes are handed out. */
const mesh = (extension: string, name: string, hint: string): Exporter => ({
  id: extension,
  name,
  hint,
  allowed: valid,
  save: async (app, work) => {
    const { meshWriter } = await import('../../wasm/io/write-mesh.ts');
    const model = app.model!;
    const { result } = model;
    const refined = await elementsOf(app, work);
    const fault = refined?.certificate.failures[0];
    if (fault)
      throw new DualblockError(
        'badOption',
        `Nothing was written, as the refined mesh is not valid: ${fault.message}. ${refusedElements}`,
        fault.entities,
      );
    const pieces = meshWriter(`mesh.${extension}`)(result, refined);
    download(await blobOf(pieces, work), `${baseName(model)}.${extension}`);
  },
});

export const exporters: Exporter[] = [
  mesh('vtk', 'Mesh, VTK', 'blocks with part and quality; for ParaView'),
  mesh('vtu', 'Mesh, VTK XML', 'the same and D̄-surfaces, binary; for ParaView'),
  mesh('msh', 'Mesh, Gmsh', 'blocks and boundary in physical groups'),
  mesh('inp', 'Mesh, Abaqus', 'with sets and surfaces; also for CalculiX'),
  mesh('cgns', 'Mesh, CGNS', 'with families and fields, in HDF5'),
  mesh('blockMeshDict', 'Blocks, OpenFOAM', 'blockMeshDict with a patch per facet'),
  mesh('mesh', 'Mesh, Medit', 'blocks and boundary with references'),
  mesh('json', 'Everything, JSON', 'every stage’s result, from tetrahedra to blocks'),
  {
    id: 'gltf',
    name: 'What is seen, glTF',
    hint: 'as binary .glb, with colours',
    allowed: any,
    save: async (app) => {
      const { sceneToGlb } = await import('./scene/gltf.ts');
      const { display } = app.model!;
      const { slice } = app.view.state;
      const planes = slice?.capped ? planesOf(placeSlice(slice, display.box)) : [];
      download(await sceneToGlb(app.stage.scene!, planes), `${baseName(app.model!)}.glb`);
    },
  },
  {
    id: 'report',
    name: 'Report, JSON',
    hint: 'counts, certificate, quality; as from the command line',
    allowed: any,
    save: async (app, work) => {
      const model = app.model!;
      const { result, reference, timeLimit, memory } = model;
      const settings = { ...defaultSettings, ...reference, timeLimit };
      const refined = valid(app) ? await elementsOf(app, work) : null;
      const report = makeReport(result, settings, memory, refined);
      download(new Blob([JSON.stringify(report, null, 1)]), `${baseName(model)}-report.json`);
    },
  },
  {
    id: 'csv',
    name: 'Histogram, CSV',
    hint: 'scaled Jacobians in 20 bins',
    allowed: valid,
    save: async (app) =>
      download(new Blob([histogramCsv(app.model!)]), `${baseName(app.model!)}-quality.csv`),
  },
];
