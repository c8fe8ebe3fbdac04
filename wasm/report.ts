// The report of a run (format "dualblock-report/1"): what every script that calls dualblock depends on.
import { version } from '../package.json';
import { changesText } from './changes.ts';
import type { RefinedMesh } from './refine.ts';
import type { Certificate, CoreError, RunResult } from './result.ts';
import type { Settings } from './settings.ts';

export const reportFormat = 'dualblock-report/1';
export const featureKinds = ['end', 'side', 'corner', 'reversal'] as const;
export const vertexKinds = ['face', 'semiEdge', 'edge', 'vertex'] as const;
const histogramBins = 20;

export interface FeatureTally {
  kind: (typeof featureKinds)[number];
  ideal: number;
  /** Fewest blocks at any place of the curve. */
  actual: number;
  curves: number;
}

/** A run's result as a plain object, ready for JSON. `memory` is the core's peak in bytes. */
export function makeReport(
  result: RunResult,
  settings: Settings,
  memory: number,
  refined: RefinedMesh | null = null,
) {
  const { domain, reference, parts, contributions, primal, mesh, certificate } = result;
  return {
    format: reportFormat,
    version,
    settings,
    input: {
      name: result.name,
      dimension: result.dimension,
      vertices: domain.vertices.length / result.dimension,
      facets: domain.facetOffsets.length - 1,
      regions: domain.regions,
      repairs: domain.repairs,
    },
    reference: {
      nodes: reference.nodes.length / result.dimension,
      simplices: reference.simplices.length / (result.dimension + 1),
      filled: reference.filled,
      cuts: reference.cuts,
      cutsBy: {
        reflexCurves: reference.cuts - reference.vertexCuts - reference.bentCuts,
        vertices: reference.vertexCuts,
        bentSides: reference.bentCuts,
      },
      bentSides: reference.bentSides,
      repairs: reference.repairs,
      refinement: settings.edgeLength > 0 ? settings.edgeLength : 'coarse',
      remedy: reference.remedy,
    },
    parts: {
      count: parts.count,
      fallback: parts.fallbackComponents > 0,
      fallbackComponents: parts.fallbackComponents,
      remeshedComponents: parts.remeshedComponents,
      fallbackReason: parts.fallbackReason,
      cutShort: parts.isCutShort,
      alternatives: {
        cuts: alternative(parts.alternatives[0]),
        confined: alternative(parts.alternatives[1]),
        simplices: alternative(parts.alternatives[2]),
      },
      cutChoices: Array.from(parts.cutTrials.blocks, (blocks, k) => ({
        largestAngle: degrees(parts.cutTrials.largestAngle[k]),
        turn: degrees(parts.cutTrials.turn[k]),
        dishes: parts.cutTrials.dishes[k] === 1,
        blocks: alternative(blocks),
        smallestSine: parts.cutTrials.worstSine[k] ?? 0,
        components: parts.cutTrials.components[k] ?? 0,
      })),
      objective: {
        objective: settings.objective,
        candidates: Array.from(parts.candidates.minScaledJacobian, (min, k) => ({
          parts: parts.candidates.parts[k] ?? 0,
          blocks: parts.candidates.blocks[k] ?? 0,
          minScaledJacobian: Number.isFinite(min) ? min : 'not valid',
          chosen: parts.candidates.chosen[k] === 1,
        })),
      },
      confinedFallback: { components: parts.pulledComponents, parts: parts.pulledParts },
    },
    contributions: { hard: contributions.hardCount, soft: contributions.softCount },
    dual: { surfaces: contributions.surfaces, cells: contributions.cells },
    primal: {
      nodes: primal.positions.length / result.dimension,
      edges: primal.edges.length / 2,
      faces: primal.faces.length / 4,
      blocks: primal.quality.length,
    },
    mesh: {
      mode: settings.mode,
      extracted: Array.from(mesh?.extracted ?? []),
      inserted: (mesh?.inserted.length ?? 0) / 2 - (mesh?.doubled ?? 0),
      doubled: mesh?.doubled ?? 0,
      nodes: (mesh ?? primal).positions.length / result.dimension,
      blocks: (mesh ?? primal).quality.length,
    },
    ...(refined ? { refined: describeRefined(refined, result.dimension) } : {}),
    certificate,
    features: {
      curves: tallyFeatures(result),
      vertices: tallyVertices(result),
      notIdeal: curvesNotIdeal(result),
    },
    quality: { scaledJacobian: summarize((mesh ?? primal).quality), angleBound: result.features.angleBound },
    timings: result.timings,
    peakMemory: memory,
  };
}
export type Report = ReturnType<typeof makeReport>;

/** What blocks were divided into, with a certificate of its own. */
function describeRefined(refined: RefinedMesh, dimension: 2 | 3) {
  const intervals = Object.fromEntries(
    Array.from(refined.intervals, (n, surface) => [surface, n] as const).filter(([, n]) => n > 0),
  );
  return {
    nodes: refined.positions.length / dimension,
    elements: refined.quality.length,
    /** Per D̄-surface. */
    intervals,
    straightenedBlocks: refined.straightened,
    certificate: refined.certificate,
    scaledJacobian: summarize(refined.quality),
  };
}

/** Blocks that a choice of parts would give; why there is no number, where there is none. */
function degrees(radians: number | undefined): number {
  return Math.round(((radians ?? 0) * 180e9) / Math.PI) / 1e9;
}

function alternative(blocks: number | undefined): number | 'not valid' | 'not counted' {
  if (blocks === undefined || blocks < 0) return 'not counted';
  return Number.isFinite(blocks) ? blocks : 'not valid';
}

/** The report of a run that an error ended: what was asked, and the error. */
export function makeErrorReport(name: string, settings: Settings, error: CoreError) {
  return { format: reportFormat, version, settings, input: { name }, error };
}

/** Curves of the domain by kind and by the blocks around them, most ideal blocks last. */
export function tallyFeatures({ features }: RunResult): FeatureTally[] {
  const tally = new Map<string, FeatureTally>();
  features.ideal.forEach((ideal, k) => {
    const actual = features.actual[k] ?? 0;
    const kind = featureKinds[ideal - 1] ?? 'end';
    const row = tally.get(`${ideal} ${actual}`) ?? { kind, ideal, actual, curves: 0 };
    row.curves += 1;
    tally.set(`${ideal} ${actual}`, row);
  });
  return [...tally.values()].sort((a, b) => a.ideal - b.ideal || a.actual - b.actual);
}

/** Where another number of blocks meets around a curve (2D: vertex) than is ideal (paper 2.4), and where that is. */
export interface CurveNotIdeal {
  kind: (typeof featureKinds)[number];
  ideal: number;
  /** Fewest blocks at any place of the curve. */
  actual: number;
  /** The two facets (2D: segments) that meet there, as the input numbers them, from 0. */
  facets: number[];
  /** A point of the curve, in the units of the input. */
  place: number[];
}

/** Those curves, in the order of the domain's curves. */
export function curvesNotIdeal({ dimension, features, domain }: RunResult): CurveNotIdeal[] {
  const given = new Map<number, number>(); // the first facet of the input that each facet was
  domain.facetOfGiven.forEach((facet, k) => {
    if (!given.has(facet)) given.set(facet, k);
  });
  const size = dimension - 1; // nodes of a ridge
  const list: CurveNotIdeal[] = [];
  features.ideal.forEach((ideal, k) => {
    const actual = features.actual[k] ?? 0;
    if (ideal === actual) return;
    const [first = 0, last = 0] = [features.ridgeOffsets[k], features.ridgeOffsets[k + 1]];
    const middle = first + size * Math.floor((last - first) / size / 2);
    const nodes = Array.from(features.ridgeNodes.subarray(middle, middle + size));
    list.push({
      kind: featureKinds[ideal - 1] ?? 'end',
      ideal,
      actual,
      facets: [0, 1].map((side) => given.get(features.facets[2 * k + side] ?? -1) ?? -1),
      place: Array.from(
        { length: dimension },
        (_, axis) => nodes.reduce((sum, n) => sum + (features.nodes[dimension * n + axis] ?? 0), 0) / size,
      ),
    });
  });
  return list;
}

/** Vertices of a solid by kind; none in 2D, where the vertices are tallied as curves. */
export function tallyVertices({
  dimension,
  features,
}: RunResult): Partial<Record<(typeof vertexKinds)[number], number>> {
  const tally: Partial<Record<(typeof vertexKinds)[number], number>> = {};
  if (dimension === 2) return tally;
  for (const code of features.vertexKind) {
    const kind = vertexKinds[code] ?? 'vertex';
    tally[kind] = (tally[kind] ?? 0) + 1;
  }
  return tally;
}

/** Minimum, mean and a histogram of equal bins from -1 to 1; null where there is nothing to measure. */
export function summarize(values: Float64Array) {
  if (values.length === 0) return null;
  const histogram = new Array<number>(histogramBins).fill(0);
  let min = Number.POSITIVE_INFINITY;
  let sum = 0;
  for (const v of values) {
    min = Math.min(min, v);
    sum += v;
    const bin = Math.min(histogramBins - 1, Math.max(0, Math.floor(((v + 1) / 2) * histogramBins)));
    histogram[bin] = (histogram[bin] ?? 0) + 1;
  }
  return { min, mean: sum / values.length, histogram };
}

/** The report in a few lines for people. */
export function describe(report: Report): string {
  const { input, reference, parts, primal, mesh, certificate } = report;
  if (primal.blocks === 0 && certificate.cells === null) return describeMatching(report);
  const kind = input.dimension === 2 ? 'quadrilaterals' : 'hexahedra';
  const confined = parts.confinedFallback.parts;
  const split = parts.fallback
    ? `${parts.count} parts, ${parts.remeshedComponents > 0 ? 'simplices made for their shape' : 'by the fallback'} (${parts.fallbackReason})`
    : confined > 0
      ? `${parts.count} parts, simplices where ${confined} would not be simple (${parts.fallbackReason})`
      : `${parts.count} part(s)`;
  const quality = report.quality.scaledJacobian;
  const handedOut = report.refined?.certificate ?? certificate;
  return [
    `${input.name || 'domain'}: ${primal.blocks} blocks (${kind}), ${primal.nodes} nodes, ${primal.edges} edges`,
    mesh.extracted.length + mesh.inserted + mesh.doubled > 0
      ? `  ${changesText(mesh)}: ${mesh.blocks} blocks, ${mesh.nodes} nodes`
      : '',
    `  from ${reference.filled} reference simplices, ${reference.cuts} cut(s), ${split}`,
    describeObjective(parts.objective),
    parts.cutShort ? '  the time limit came before all was tried: the best mesh until then' : '',
    quality
      ? `  scaled Jacobian: minimum ${shapeText(quality.min, report.quality.angleBound)}, mean ${quality.mean.toFixed(3)}`
      : '',
    report.refined
      ? `  refined: ${report.refined.elements} elements, ${report.refined.nodes} nodes, scaled Jacobian: minimum ${report.refined.scaledJacobian?.min.toFixed(3)}`
      : '',
    report.refined?.straightenedBlocks && handedOut.valid
      ? `  ${straightenedText(report.refined.straightenedBlocks)}`
      : '',
    describeFidelity(reference.bentSides, handedOut, report.refined ? 'elements' : 'blocks'),
    describeFeatures(report.features, input.dimension),
    handedOut.valid && certificate.valid
      ? `  certified${report.refined ? ', its elements' : ''}: matching, cells, topology, geometry, features`
      : '  NOT VALID:',
    ...(certificate.valid ? handedOut : certificate).failures.map((f) => `    ${f.check}: ${f.message}`),
    certificate.valid && !handedOut.valid ? `  ${refusedElements}` : '',
  ]
    .filter((line) => line !== '')
    .join('\n');
}

/** A smallest scaled Jacobian; with what the domain's own angles allow, where that is little. */
const shapeText = (min: number, bound: number): string =>
  bound < 0.3 ? `${min.toFixed(3)} (the domain's own angles allow ${bound.toFixed(3)})` : min.toFixed(3);

/** What to do about elements that their certificate refuses, though their blocks have passed. */
export const refusedElements =
  'The blocks are certified, these elements are not: give other numbers of intervals, smaller facets where the domain bends sharply, or take the blocks.';

/** A share in words. */
export const percent = (share: number): string => `${(100 * share).toFixed(0)} %`;

/** How near the mesh that is handed out comes to bent sides. */
function describeFidelity(bentSides: number, { isExact, fidelity }: Certificate, what: string): string {
  if (isExact) return '';
  const off = 100 * fidelity.volumeDifference;
  const than = `${Math.abs(off).toFixed(off * off < 0.01 ? 2 : 1)} % ${off < 0 ? 'less' : 'more'} than the domain`;
  const distance = `${percent(fidelity.largestDistance)} of their size (${percent(fidelity.largestDepth)} of the thickness there)`;
  const strayed = `${percent(fidelity.strayedVolume)} of its volume lies between them and the sides`;
  return `  ${bentSides} bent side(s): straight ${what} hold ${than}, ${strayed}; they stray by up to ${distance}, and turn by up to ${fidelity.largestTurning.toFixed(0)}° each`;
}

/** How many curves (2D: vertices) have another number of blocks around them than is ideal, and the first place. */
function describeFeatures(
  { curves, notIdeal: [first, ...more] }: Report['features'],
  dimension: 2 | 3,
): string {
  if (!first) return '';
  const all = curves.reduce((sum, row) => sum + row.curves, 0);
  const place = first.place.map((x) => Number(x.toPrecision(4))).join(', ');
  return `  ${more.length + 1} of ${all} ${dimension === 2 ? 'vertices' : 'curves'} do not have their ideal number of blocks: at (${place}) ${first.actual} for ${first.ideal}${more.length > 0 ? ', … (all are in the report)' : ''}`;
}

/** Of blocks whose elements do not follow the bent sides beside them. */
export const straightenedText = (blocks: number): string =>
  `${blocks} block(s) keep straight elements beside a bent side, which would turn some inside out: there nodes are off the domain. Other intervals may serve.`;

/** What the objective `blocks` would have given, where other parts were chosen. */
function describeObjective({ candidates }: Report['parts']['objective']): string {
  const [first] = candidates;
  if (!first || first.chosen) return '';
  const min = first.minScaledJacobian;
  const shape = typeof min === 'number' ? `scaled Jacobian: minimum ${min.toFixed(3)}` : min;
  return `  best shape of ${candidates.length} choices of parts; for few blocks: ${first.blocks} blocks, ${shape}`;
}

function describeMatching({ input, certificate }: Report): string {
  const verdict = certificate.valid ? 'match (paper 4.3)' : 'do not match:';
  return [
    `${input.name}: the given contributions ${verdict}`,
    ...certificate.failures.map((f) => `    ${f.message}`),
  ].join('\n');
}
