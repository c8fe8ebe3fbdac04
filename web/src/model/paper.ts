// The paper's pictures, each a view one click away, with a caption of our own.
import type { ViewState } from '../state/view-state.ts';

export interface Figure {
  figure: string;
  title: string;
  caption: string;
  example: string;
  view: Partial<ViewState>;
}

const rows: [string, string, Partial<ViewState>][] = [
  ['i', 'Reference mesh', { step: 2 }],
  [
    'ii',
    'Local dual contributions',
    { step: 4, layers: { 4: { hard: { opacity: 1 }, soft: { opacity: 1 } } } },
  ],
  ['iii', 'D̄-cells', { step: 6, explode: 0 }],
  ['iv', 'Primal nodes and edges', { step: 7 }],
  ['v', 'Blocks', { step: 8 }],
];

const captions13: Record<string, Record<string, string>> = {
  a: {
    i: 'A brick tapered in two directions, filled with six tetrahedra.',
    ii: 'One D̄-surface along each of the six facets. Red contributions are hard; the blue, hatched ones are where two or three surfaces coincide.',
    iii: 'The 27 D̄-cells: eight vertices, twelve curves, six facets and the inside.',
    iv: 'A node for each cell, in its colour, and an edge for each pair that a hard contribution separates.',
    v: 'Eight blocks, one at each vertex: midpoint subdivision, found without looking for it.',
  },
  b: {
    i: 'A pentagon, extruded: a shape that submapping cannot take evenly.',
    ii: 'Seven D̄-surfaces along the seven facets. Where the fan of triangles meets a vertex, soft contributions close the gap.',
    iii: 'The 33 D̄-cells. A soft contribution still separates cells here; it only yields no edge.',
    iv: 'No edge joins the top’s vertex with its centre: what lies between them is soft.',
    v: 'Ten blocks, five on each level around the axis.',
  },
  c: {
    i: 'Two pyramids on a common square: four curves meet at every vertex.',
    ii: 'Planes through the vertices split the domain into four tetrahedra, with a pair of parallel D̄-surfaces along each plane.',
    iii: 'The 35 D̄-cells of four tetrahedra that share faces.',
    iv: 'Edges inside the cut planes join the four parts.',
    v: 'Sixteen blocks, four in each tetrahedron.',
  },
};

const figure13 = (['a', 'b', 'c'] as const).flatMap((letter) => {
  const example = { a: 'tapered_brick', b: 'extruded_pentagon', c: 'double_pyramid' }[letter];
  return rows.map(
    ([row, title, view]): Figure => ({
      figure: `13(${letter}) ${row}`,
      title,
      caption: captions13[letter]![row]!,
      example,
      view,
    }),
  );
});

const contributions2d: Partial<ViewState> = {
  step: 4,
  layers: { 4: { hard: { opacity: 1 }, wire: { opacity: 0.8 } } },
};

export const figures: Figure[] = [
  {
    figure: '1',
    title: 'The dual and its discrete form',
    caption:
      'Left the blocks with their edges, right the D̄-curves in the triangles that carry them: broken lines that cross where the blocks are.',
    example: 'pentagon_2d',
    view: {
      step: 5,
      compare: 8,
      layers: {
        5: { wire: { visible: true, opacity: 0.6 } },
        8: { surfaces: { visible: true, opacity: 1 } },
      },
    },
  },
  {
    figure: '9(a)',
    title: 'A rectangle on two triangles',
    caption: 'The coarsest reference mesh of a rectangle. Its four D̄-curves follow the sides.',
    example: 'square_2d_first',
    view: contributions2d,
  },
  {
    figure: '9(b)',
    title: 'The same rectangle on seven triangles',
    caption:
      'Another reference mesh, and soft contributions (blue, dashed) where a corner belongs to more triangles.',
    example: 'square_2d_second',
    view: contributions2d,
  },
  {
    figure: '9(c)',
    title: 'Their common dual',
    caption: 'Four D̄-curves, one along each side, that cross near the corners: one of them in each colour.',
    example: 'square_2d_second',
    view: { step: 5 },
  },
  {
    figure: '9(d)',
    title: 'The same four blocks',
    caption: 'Whatever the triangles were, the primal is the same: four quadrilaterals.',
    example: 'square_2d_second',
    view: { step: 8, layers: { 8: { nodes: { visible: true } } } },
  },
  ...(['a', 'b', 'c', 'd'] as const).map((letter, k): Figure => {
    const count = ['one triangle', 'two triangles', 'three triangles', 'four triangles'][k]!;
    return {
      figure: `10(${letter})`,
      title: `An end vertex in ${count}`,
      caption:
        k < 2
          ? 'Two D̄-curves cross at one point near the vertex: hard contributions are enough.'
          : 'The two D̄-curves have to cross, but no contribution of one triangle reaches across: in between they run together, softly.',
      example: `end_vertex_${k + 1}`,
      view: contributions2d,
    };
  }),
  ...(['a', 'b'] as const).map(
    (letter, k): Figure => ({
      figure: `11(${letter})`,
      title: `Hard and soft, in ${['three', 'four'][k]} triangles`,
      caption:
        'Soft node contributions (blue, dashed) count as one point. Collapse them in thought, and two curves cross there as they should.',
      example: `end_vertex_${k + 3}`,
      view: { ...contributions2d, compare: 6 },
    }),
  ),
  {
    figure: '12(a)',
    title: 'Not valid: three meet at one point',
    caption:
      'Two hard contributions arrive from one side of the diagonal and one from the other. The place in magenta breaks the rule for inner edges: both numbers must be equal.',
    example: 'figure_12a',
    view: contributions2d,
  },
  {
    figure: '12(b)',
    title: 'Not valid: three where soft ones collapse',
    caption:
      'Soft contributions join the places between them into one point, and three hard ones arrive there. It has to be two or four.',
    example: 'figure_12b',
    view: contributions2d,
  },
  {
    figure: '12(c)',
    title: 'Valid: as many from both sides',
    caption: 'Two hard contributions from the left, two from the right: two D̄-curves that cross.',
    example: 'figure_12c',
    view: contributions2d,
  },
  {
    figure: '12(d)',
    title: 'Valid: four where soft ones collapse',
    caption: 'Two hard contributions on either side of the soft ones: two D̄-curves that cross.',
    example: 'figure_12d',
    view: contributions2d,
  },
  ...figure13,
  ...(
    [
      [
        'a',
        'square_ring',
        'A square ring, extruded',
        'The hole has four curves of type corner: three blocks around each, as its angle asks for.',
      ],
      [
        'b',
        'protrusion',
        'A slab with a protrusion',
        'The curves around the protrusion’s foot are corners; planes through them cut slab and protrusion alike.',
      ],
    ] as const
  ).flatMap(([letter, example, title, caption]): Figure[] => [
    {
      figure: `14(${letter}) i`,
      title: `${title}: D̄-surfaces`,
      caption:
        'All contributions: red ones hard, blue and hatched ones soft. Pairs of parallel surfaces run along every cut.',
      example,
      view: rows[1]![2],
    },
    { figure: `14(${letter}) ii`, title: `${title}: blocks`, caption, example, view: { step: 8 } },
  ]),
];
