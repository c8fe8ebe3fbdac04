// What each step is, in two sentences, where the paper has it, and its numbers for the shown model.

import type { Refinement } from '../../../wasm/refine.ts';
import { featureKinds, percent, summarize, tallyFeatures } from '../../../wasm/report.ts';
import type { Certificate, Check, RunResult } from '../../../wasm/result.ts';
import { reasons } from '../display/contributions.ts';
import type { Entity, LayerId, LayerSetting, Step, ViewState } from '../state/view-state.ts';
import { elementCount, intervalsAcross, type SurfaceLayer, surfaceLayers } from './final-mesh.ts';
import { kindName, type Model } from './model.ts';
import { facetOfSide, relate, sidesOfContribution } from './provenance.ts';
import { roundCount, roundOf } from './relaxation.ts';

type Count = [string, string];

export interface Explanation {
  text: string;
  section: string;
  /** Name and value. */
  counts: Count[];
  /** What holds, in one line. */
  invariant: string;
}

const plural = (n: number, one: string, many = `${one}s`): string =>
  `${n.toLocaleString('en')} ${n === 1 ? one : many}`;

export function explain(
  { result, display }: Model,
  step: Step,
  refinement: Refinement | null,
  round: number | null = null,
): Explanation {
  const { dimension, reference, parts, contributions, primal, domain, features } = result;
  const flat = dimension === 2;
  const simplexName = flat ? 'triangle' : 'tetrahedron';
  const simplexNames = flat ? 'triangles' : 'tetrahedra';
  const blockNames = flat ? 'quadrilaterals' : 'hexahedra';
  const surfaceName = flat ? 'D̄-curve' : 'D̄-surface';
  const simplices = reference.simplices.length / (dimension + 1);
  const nodes = primal.positions.length / dimension;
  const number = (n: number): string => n.toLocaleString('en');
  const given = result.onlyMatching
    ? 'The example brings its contributions along, so nothing is meshed here. '
    : '';
  switch (step) {
    case 1: {
      const tally = tallyFeatures(result);
      const kinds = featureKinds.map(
        (kind) => [kind, tally.filter((t) => t.kind === kind).reduce((s, t) => s + t.curves, 0)] as const,
      );
      return {
        text: flat
          ? 'The domain is bounded by straight segments. Each vertex is an end, a side, a corner or a reversal, after the number of blocks that its angle has room for.'
          : 'The domain is bounded by planar facets that meet along curves. Each curve is an end, a side, a corner or a reversal, after the number of blocks that its angle has room for.',
        section: 'Paper, section 2.4, figures 2 and 3',
        counts: [
          [flat ? 'Segments' : 'Facets', number(domain.facetOffsets.length - 1)],
          ['Vertices', number(domain.vertices.length / dimension)],
          ...(result.onlyMatching ? [] : kinds).map(([kind, n]): [string, string] => [
            `${flat ? 'Vertices' : 'Curves'}: ${kind}`,
            number(n),
          ]),
        ],
        invariant: result.onlyMatching
          ? given
          : features.actual.length > 0
            ? `${plural(features.kind.length, flat ? 'vertex' : 'curve', flat ? 'vertices' : 'curves')}, each with the blocks around it counted against its ideal.`
            : '',
      };
    }
    case 2:
      return {
        text: `TetGen fills the domain with ${simplexNames}, as few as it can. Planes through reflex ${flat ? 'vertices' : 'curves'}${flat ? '' : ', and through vertices where more than three sides meet,'} then cut them into parts that are convex and simple.`,
        section: 'Paper, section 3.2, algorithm 1; for the cuts 4.4',
        counts: [
          [flat ? 'Triangles' : 'Tetrahedra', number(simplices)],
          ['As filled', number(reference.filled)],
          ['Cuts', number(reference.cuts)],
          ['Choices of cuts tried', number(parts.cutTrials.blocks.length)],
          ['Parts', number(parts.count)],
          ['Repairs', number(reference.repairs)],
        ],
        invariant:
          parts.fallbackComponents > 0
            ? `Fallback: every ${simplexName} is a part, because ${parts.fallbackReason}.`
            : parts.pulledParts > 0
              ? `${number(parts.pulledParts)} part(s) became ${simplexName}s, because ${parts.fallbackReason}.`
              : parts.isCutShort
                ? 'The time limit came before all that might be better was tried.'
                : 'Other simplices that fill the same domain lead to the same blocks.',
      };
    case 3:
      return {
        text: `Each side of a part puts a piece of ${flat ? 'line' : 'plane'} into every ${simplexName} it touches: it cuts off the vertices that lie on the side. A contribution that belongs to one side alone is hard: crossing it means crossing into another cell, along an edge of the mesh.`,
        section: 'Paper, sections 4.1 and 4.4, algorithm 2, figures 6 to 8',
        counts: contributionCounts(result, display.contributions.soft, display.contributions.size, 0),
        invariant: result.onlyMatching
          ? matching(result)
          : 'On every inner face of the reference mesh, what arrives from one side leaves on the other.',
      };
    case 4:
      return {
        text: `Where several sides cut off the same vertices of a ${simplexName}, their contributions coincide: the ${surfaceName}s cross there, and the contribution is soft. It counts as collapsed to nothing, so no edge of the mesh crosses it.`,
        section: 'Paper, section 4.2, figures 10 and 11; matching rules 4.3',
        counts: contributionCounts(result, display.contributions.soft, display.contributions.size, 1),
        invariant: result.onlyMatching
          ? matching(result)
          : contributions.softCount === 0
            ? 'All contributions are hard here.'
            : 'Two or four hard contributions arrive wherever soft ones collapse.',
      };
    case 5:
      return {
        text: `The contributions of one side, continued across the cuts, make up a ${surfaceName}: the middle ${flat ? 'line' : 'sheet'} of one layer of blocks. Where ${flat ? 'two' : 'three'} of them cross there is a block${flat ? '' : ', where two cross a column of blocks'}.`,
        section: 'Paper, sections 2.2 and 2.3, figure 1',
        counts: [
          [`${surfaceName}s`, number(contributions.surfaces)],
          ['Hard contributions', number(contributions.hardCount)],
          ['Soft contributions', number(contributions.softCount)],
        ],
        invariant: `Each ${surfaceName} runs through a layer of ${blockNames}.`,
      };
    case 6:
      return {
        text: `The ${surfaceName}s and the boundary enclose the D̄-cells. Every cell stands for one node of the mesh: of a vertex, a curve, a ${flat ? 'side' : 'facet'}, or the inside of a part.`,
        section: 'Paper, section 3.2, algorithm 1',
        counts: [
          ['D̄-cells', number(contributions.cells)],
          [`${surfaceName}s`, number(contributions.surfaces)],
          ['Parts', number(parts.count)],
        ],
        invariant: `${plural(contributions.cells, 'D̄-cell')}, one primal node each.`,
      };
    case 7:
      return {
        text: 'Each D̄-cell becomes a node, in the colour of its cell; cells that a hard contribution separates are joined by an edge. Nodes sit at vertices, at the middle of curves and sides, and inside the parts.',
        section: 'Paper, sections 2.2 and 3.2: the dual of the dual',
        counts: [
          ['Nodes', number(nodes)],
          ['Edges', number(primal.edges.length / 2)],
          ['Faces', number(primal.faces.length / 4)],
        ],
        invariant: 'Edges and faces are derived twice, from the dual and from the blocks, and agree.',
      };
    case 8: {
      const { quality } = roundOf(result, round);
      const before = roundCount(result) > 0 ? summarize(roundOf(result, 0).quality) : null;
      const euler = nodes - primal.edges.length / 2 + primal.faces.length / 4 - (flat ? 0 : quality.length);
      const shape = summarize(quality);
      const isPlayed = round !== null && round < roundCount(result);
      return {
        text: `${flat ? 'Where two D̄-curves cross' : 'Where three D̄-surfaces cross'} there is a block, a ${flat ? 'quadrilateral' : 'hexahedron'}. Colours show its scaled Jacobian: 1 for a ${flat ? 'rectangle' : 'box'}, 0 and below for a block that is of no use.`,
        section: 'Paper, sections 2.1 and 5, figures 13 and 14',
        counts: [
          ['Blocks', number(quality.length)],
          ['Minimum scaled Jacobian', shape ? shape.min.toFixed(3) : '–'],
          ['Mean', shape ? shape.mean.toFixed(3) : '–'],
          ...(before && !isPlayed
            ? [
                [
                  'Before relaxation',
                  `${before.min.toFixed(3)}, mean ${before.mean.toFixed(3)}`,
                ] satisfies Count,
              ]
            : []),
          ...(isPlayed
            ? [['Relaxation', round === 0 ? 'as placed' : `after ${plural(round, 'round')}`] satisfies Count]
            : []),
        ],
        invariant: result.certificate.valid
          ? `V − E + F${flat ? '' : ' − B'} = ${String(euler).replace('-', '−')}: the Euler characteristic of the domain.`
          : 'Not valid: see the certificate.',
      };
    }
    case 9: {
      const { mesh } = result;
      const blockCount = (mesh ?? primal).quality.length;
      const lead = mesh?.extracted.length
        ? 'D̄-surfaces have been extracted, each with the layer of blocks that it crosses, while every feature was kept. '
        : mesh?.doubled
          ? 'D̄-surfaces have been doubled where blocks were too far from bent sides: each layer of blocks that one crosses is two. '
          : '';
      return {
        text: `${lead}Every block is divided along its edges, and filled by transfinite interpolation. All edges that one ${surfaceName} crosses get the same number of intervals, so that neighbours fit; on bent sides nodes lie on the domain’s own facets.`,
        section: 'Beyond the paper; section 5 leaves it to a mesher of blocks',
        counts: [
          ...(mesh
            ? ([
                ['Blocks', number(blockCount)],
                mesh.doubled
                  ? ['D̄-surfaces doubled', number(mesh.doubled)]
                  : ['D̄-surfaces extracted', number(mesh.extracted.length)],
              ] as [string, string][])
            : []),
          ['Elements', refinement ? number(elementCount(result, refinement)) : '–'],
          ['Intervals per edge', refinement ? intervalRange(refinement, surfaceLayers(result)) : '–'],
        ],
        invariant: 'Conformal: neighbours share the nodes of their common faces.',
      };
    }
  }
}

/** The fewest and the most intervals of an edge. */
function intervalRange(refinement: Refinement, layers: readonly SurfaceLayer[]): string {
  const across = intervalsAcross(refinement);
  const counts = layers.map(({ surface }) => across(surface));
  const [low, high] = [Math.min(...counts), Math.max(...counts)];
  return low === high ? String(low) : `${low} to ${high}`;
}

function contributionCounts(
  result: RunResult,
  soft: Uint8Array,
  size: Uint8Array,
  wanted: 0 | 1,
): [string, string][] {
  const names = result.dimension === 2 ? ['', 'Node', 'Edge'] : ['', 'Node', 'Edge', 'Face'];
  const { hardCount, softCount } = result.contributions;
  const rows: [string, string][] = [[wanted ? 'Soft' : 'Hard', String(wanted ? softCount : hardCount)]];
  for (let k = names.length - 1; k > 0; k--) {
    const n = size.reduce((sum, s, c) => sum + (s === k && soft[c] === wanted ? 1 : 0), 0);
    rows.push([`${names[k]} contributions`, n.toLocaleString('en')]);
  }
  return rows;
}

const matching = ({ certificate }: RunResult): string =>
  certificate.valid ? 'The matching rules hold.' : (certificate.failures[0]?.message ?? '');

export interface CheckText {
  check: Check;
  title: string;
  /** What it looked at, with numbers. */
  looked: string;
  /** The view that shows it. */
  view: Partial<ViewState>;
}

/** Elements that have been checked, in the place of blocks. */
interface CheckedElements {
  quality: { length: number };
  certificate: Certificate;
}

/** The checks of the certificate (ARCHITECTURE.md 6) with what each of them looked at. */
export function checkTexts({ result }: Model, elements: CheckedElements | null = null): CheckText[] {
  const texts = blockTexts(result);
  if (!elements) return texts;
  const { quality, certificate } = elements;
  const count = quality.length.toLocaleString('en');
  const looked: Partial<Record<Check, string>> = {
    topology: `The faces of ${count} elements: each in one or two of them, on opposite sides, the others the boundary.`,
    geometry: `${count} Jacobians by their Bézier coefficients, the smallest ${certificate.worstCoefficient.toPrecision(3)} of its element’s largest; ${measuresText(certificate, result.dimension)}.`,
    features: certificate.isExact
      ? 'Elements are pieces of blocks that keep them.'
      : `Whether the elements’ boundary crosses itself, and how near to bent sides it is.${fidelityText(certificate)}`,
  };
  return texts.map((text) => ({ ...text, looked: looked[text.check] ?? text.looked }));
}

const measuresText = ({ meshMeasure, domainMeasure }: Certificate, dimension: 2 | 3): string =>
  `${dimension === 2 ? 'areas' : 'volumes'} ${meshMeasure.toPrecision(7)} and ${domainMeasure.toPrecision(7)}`;

/** How near straight faces come to bent sides; empty where nothing bends. */
const fidelityText = ({ isExact, fidelity }: Certificate): string =>
  isExact
    ? ''
    : ` Bent sides are up to ${percent(fidelity.largestDistance)} of a face’s size off it, up to ${percent(fidelity.largestDepth)} of the thickness behind one, and turn by up to ${fidelity.largestTurning.toFixed(0)}° within one; ${percent(fidelity.strayedVolume)} of the volume lies between.`;

function blockTexts(result: RunResult): CheckText[] {
  const { dimension, reference, contributions, primal, mesh, domain, features, certificate } = result;
  const n = dimension;
  const flat = n === 2;
  // Extracted and inserted surfaces make a mesh of their own, which the last three checks are about.
  const blocks = (mesh ?? primal).quality.length;
  const which = mesh ? `the ${blocks} that are handed out, in step 9` : `${blocks} blocks`;
  let inner = 0;
  for (const other of reference.neighbors) if (other >= 0) inner++;
  const show = (step: Step, layers: Partial<Record<LayerId, Partial<LayerSetting>>>): Partial<ViewState> => ({
    step,
    compare: null,
    layers: { [step]: layers },
    solo: {},
    selection: null,
  });
  return [
    {
      check: 'matching',
      title: 'Contributions match across every face',
      looked: `${(inner / 2).toLocaleString('en')} inner ${flat ? 'edges' : 'faces'} of the reference mesh, ${(n === 2 ? 2 : 6) * (inner / 2)} places: what arrives from one side leaves on the other.`,
      view: show(4, { hard: { opacity: 0.8 }, wire: { visible: true, opacity: 1 } }),
    },
    {
      check: 'cells',
      title: 'One primal node in every D̄-cell',
      looked: `${contributions.cells.toLocaleString('en')} D̄-cells in ${contributions.piecePart.length.toLocaleString('en')} pieces: no label twice, each with the Euler characteristic of a ball.`,
      view: { ...show(6, { cells: { visible: true, opacity: 1 } }), explode: 0.45 },
    },
    {
      check: 'topology',
      title: 'A conforming complex like the domain',
      looked: mesh
        ? `Faces of blocks, each in one or two of ${which}, the others the boundary.`
        : `${primal.faces.length / 4} faces, each in one or two of ${which}; ${primal.boundaryFacet.length} of them close the boundary.`,
      view: { ...show(8, { blocks: { visible: true, opacity: 1 } }), shrink: 0.82 },
    },
    {
      check: 'geometry',
      title: certificate.isExact
        ? 'No block is inverted; measures agree'
        : 'No block is inverted; straight blocks come near',
      looked: `Jacobians of ${which}, by their Bézier coefficients, the smallest ${certificate.worstCoefficient.toPrecision(3)} of its block’s largest; ${measuresText(certificate, dimension)}.`,
      view: { ...show(8, { blocks: { visible: true, opacity: 1 } }), shrink: 1 },
    },
    {
      check: 'features',
      title: 'Vertices, curves and facets are kept',
      looked: certificate.isExact
        ? `${domain.vertices.length / n} vertices, ${features.kind.length} ${flat ? 'angles' : 'curves'}, ${domain.facetOffsets.length - 1} ${flat ? 'segments' : 'facets'}: nodes, chains of edges and unions of faces of the mesh.`
        : `${features.kind.length} curves, the vertices that they end at, and the sides between them: chains of edges, nodes and unions of faces of the mesh.${fidelityText(certificate)}`,
      view: show(7, {
        curves: { visible: true, opacity: 1 },
        vertices: { visible: true, opacity: 1 },
        facets: { visible: true, opacity: 0.35 },
      }),
    },
  ];
}

const featureBlocks = ['one block', 'two blocks', 'three blocks', 'four blocks'];

/** What there is to say of an entity: name, value; the reason of a contribution among it. */
export function describeEntity(
  model: Model,
  entity: Entity,
  blockOfElement?: Int32Array,
): [string, string][] {
  const { result, display } = model;
  const { id, kind } = entity;
  const { dimension, reference, contributions, primal, features } = result;
  const rows: [string, string][] = [];
  const coordinates = (values: ArrayLike<number>, at: number): string =>
    `(${Array.from({ length: dimension }, (_, k) => Number(values[at + k]!.toPrecision(5))).join(', ')})`;
  if (kind === 'contribution') {
    const c = display.contributions;
    const type = ['', 'node', 'edge', 'face'][c.size[id]!]!;
    rows.push(['Kind', `${c.soft[id] ? 'soft' : 'hard'} ${type} contribution`]);
    rows.push(['Why', reasonOf(model, id)]);
    rows.push(['In', `${kindName('simplex', dimension).toLowerCase()} ${c.simplex[id]}`]);
  } else if (kind === 'node' || kind === 'cell') {
    const piece = primal.nodePiece[id]!;
    const sides = Array.from(
      contributions.pieceSides.subarray(dimension * piece, dimension * (piece + 1)),
    ).filter((s) => s >= 0);
    const inside = ['the inside of a part', 'a side', dimension === 2 ? 'a corner' : 'a curve', 'a corner'][
      sides.length
    ]!;
    rows.push(['Stands for', inside]);
    rows.push(['Position', coordinates(primal.positions, dimension * id)]);
  } else if (kind === 'block') {
    rows.push(['Scaled Jacobian', primal.quality[id]!.toFixed(4)]);
    rows.push(['Part', String(primal.blockPart[id])]);
    rows.push([
      'Nodes',
      Array.from(primal.blocks.subarray((1 << dimension) * id, (1 << dimension) * (id + 1))).join(', '),
    ]);
  } else if (kind === 'edge') {
    rows.push(['Nodes', `${primal.edges[2 * id]}, ${primal.edges[2 * id + 1]}`]);
    rows.push(['Crosses', `${kindName('surface', dimension)} ${primal.edgeSurface[id]}`]);
  } else if (kind === 'curve' || (kind === 'vertex' && dimension === 2 && !result.onlyMatching)) {
    const ideal = features.kind[id]!;
    rows.push(['Kind', `${featureKinds[ideal - 1]}: ${featureBlocks[ideal - 1]} ideal`]);
    rows.push(['Angle', `${((features.angle[id]! * 180) / Math.PI).toFixed(1)}°`]);
    if (features.actual[id] !== undefined) rows.push(['Blocks around it', String(features.actual[id])]);
  } else if (kind === 'vertex') {
    rows.push(['Position', coordinates(display.domain.vertices, 3 * id)]);
  } else if (kind === 'simplex') {
    rows.push(['Part', String(result.parts.ofSimplex[id] ?? '–')]);
    const own = reference.simplices.subarray((dimension + 1) * id, (dimension + 1) * (id + 1));
    rows.push(['Nodes', Array.from(own).join(', ')]);
  } else if (kind === 'element' && blockOfElement) rows.push(['Block', String(blockOfElement[id])]);
  const related = relate(model, entity, blockOfElement);
  for (const other of ['simplex', 'contribution', 'surface', 'cell', 'edge', 'block'] as const) {
    if (other === kind || (kind === 'node' && other === 'cell')) continue;
    const ids = [...related[other]];
    if (ids.length === 0) continue;
    const name = ids.length === 1 ? kindName(other, dimension) : pluralName(other, dimension);
    rows.push([name, ids.length <= 6 ? ids.join(', ') : `${ids.length}`]);
  }
  return rows;
}

function pluralName(kind: Entity['kind'], dimension: 2 | 3): string {
  return kind === 'simplex' && dimension === 3 ? 'Tetrahedra' : `${kindName(kind, dimension)}s`;
}

/** Why a contribution is there (paper, algorithm 2). */
function reasonOf(model: Model, contribution: number): string {
  const { reference, parts, dimension } = model.result;
  const sides = sidesOfContribution(model, contribution);
  if (sides.length === 0) return 'given with the example';
  const each = sides.map((side) => {
    const surface = parts.sideTag[side]! >> 1;
    const kind = reference.surfaceKind[surface]!;
    const facet = facetOfSide(model, side);
    const reason = kind === 1 && dimension === 2 ? 'corner vertex' : reasons[kind]!;
    return facet >= 0 ? `${reason} along ${kindName('facet', dimension).toLowerCase()} ${facet}` : reason;
  });
  return [...new Set(each)].join('; ');
}
