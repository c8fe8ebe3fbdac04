// The block mesh as the writers get it: D̄-surfaces along the axes of blocks, inner facets, groups.
import { beforeAll, describe, expect, it } from 'vitest';
import type { Dualblock } from '../../wasm/dualblock.ts';
import { blockMesh } from '../../wasm/io/block-mesh-of.ts';
import { facetGroups } from '../../wasm/io/facet-groups.ts';
import { examples, interfaces, runExample, startCore } from './support/core.ts';

let core: Dualblock;
beforeAll(async () => {
  core = await startCore();
});

const meshed = examples.map(({ name }) => name).filter((name) => !name.startsWith('figure_12'));

describe.each(meshed)('%s', (name) => {
  it('every edge of a block is crossed by the D̄-surface of its axis', () => {
    const result = runExample(core, name);
    const { dimension, blocks, surfaces } = blockMesh(result);
    const { edges, edgeSurface } = result.primal;
    const key = (a: number, b: number): string => `${Math.min(a, b)} ${Math.max(a, b)}`;
    const surfaceOf = new Map(
      [...edgeSurface].map((surface, i) => [key(edges[2 * i]!, edges[2 * i + 1]!), surface]),
    );
    // Corners of a block by their position along the axes, as VTK orders them.
    const corner = (position: number): number => [0, 1, 3, 2, 4, 5, 7, 6][position]!;
    const wrong: string[] = [];
    for (let block = 0; block < result.primal.quality.length; block++) {
      for (let axis = 0; axis < dimension; axis++) {
        for (let low = 0; low < 2 ** dimension; low++) {
          if (low & (1 << axis)) continue;
          const [a, b] = [low, low | (1 << axis)].map((p) => blocks[2 ** dimension * block + corner(p)]!);
          if (surfaceOf.get(key(a!, b!)) !== surfaces?.[dimension * block + axis])
            wrong.push(`block ${block}, axis ${axis}`);
        }
      }
    }
    expect(wrong).toEqual([]);
    expect(new Set(surfaces).size).toBe(result.contributions.surfaces);
  });

  it('inner facets are listed once', () => {
    const mesh = blockMesh(runExample(core, name));
    expect([...new Set(mesh.interfaces?.facet)]).toEqual(interfaces[name] ?? []);
    const inner = facetGroups(mesh).filter(({ isInner }) => isInner);
    expect(inner.map(({ faces }) => faces.length)).toEqual(name === 'box_on_box' ? [4] : []);
  });
});

it('a bent side is one group', () => {
  const names = facetGroups(blockMesh(runExample(core, 'cylinder'))).map((group) => group.name);
  expect(names).toEqual(['facet 0', 'facet 1', 'facet 2']);
});
