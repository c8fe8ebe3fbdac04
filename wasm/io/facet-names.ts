// The names that an input gives to its facets, and what becomes of them when facets are merged.
import { DualblockError } from './errors.ts';
import { polyMarkers } from './poly-markers.ts';

/**
 * The name of each facet of a JSON, .poly or .smesh file, in the core's order; empty for facets without one; no entries
 * where nothing is named. Whether the rest of the file is right is left to the core. Throws `syntax` for a name that is
 * no string.
 */
export function namesInFile(format: string, bytes: Uint8Array): string[] {
  if (format === 'json') return jsonNames(new TextDecoder().decode(bytes));
  if (format === 'poly' || format === 'smesh')
    return telling(
      polyMarkers(new TextDecoder().decode(bytes), format === 'smesh').map((marker) =>
        marker === 0 ? '' : `marker ${marker}`,
      ),
    );
  return [];
}

/** The names, or none where all are the same: a name of the whole says nothing about a facet. */
export const telling = (names: readonly string[]): string[] =>
  names.some((name) => name !== names[0]) ? [...names] : [];

/**
 * The name of each merged facet: the different names of the facets that went into it, in their order, joined by "+".
 * `facetOfGiven` leads from a given facet to the merged one, or to -1.
 */
export function mergedNames(given: readonly string[], facetOfGiven: Int32Array, facets: number): string[] {
  const found = Array.from({ length: facets }, () => new Set<string>());
  facetOfGiven.forEach((facet, i) => {
    if (facet >= 0 && given[i]) found[facet]?.add(given[i]);
  });
  return found.map((names) => [...names].join('+'));
}

/** 3D: the facets' `name`s. 2D: `names`, lists like `loops`, with a name for each segment that begins at a vertex. */
function jsonNames(text: string): string[] {
  const domain = parsed(text);
  const given: [unknown, string][] =
    member(domain, 'dimension') === 2
      ? list(member(domain, 'loops')).flatMap((loop, l) =>
          list(loop).map((_, k): [unknown, string] => [
            list(list(member(domain, 'names'))[l])[k],
            `names[${l}][${k}]`,
          ]),
        )
      : list(member(domain, 'facets')).map((facet, f) => [member(facet, 'name'), `facets[${f}].name`]);
  if (given.every(([name]) => name === undefined)) return [];
  return given.map(([name, where]) => {
    if (name === undefined || typeof name === 'string') return name ?? '';
    throw new DualblockError(
      'syntax',
      `${where} is no string; put the name between quotes, or leave it out.`,
      [{ kind: 'file', index: 0 }],
    );
  });
}

function parsed(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    return null; // the core says what is wrong, and where
  }
}

const list = (value: unknown): unknown[] => (Array.isArray(value) ? value : []);
const member = (value: unknown, name: string): unknown =>
  typeof value === 'object' && value !== null ? (value as Record<string, unknown>)[name] : undefined;
