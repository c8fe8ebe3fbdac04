// The block mesh's faces by the facet of the domain that they lie on: what solvers put their conditions on.
import { type BlockMesh, boundaryCorners } from './block-mesh.ts';

export interface FacetGroup {
  /** The lowest facet of the group, from 0. */
  facet: number;
  name: string;
  /** On the boundary, or inside: a facet with the domain on both sides. */
  isInner: boolean;
  /** 2 (2D) or 4 (3D) node ids per edge or face, in the order of the block mesh's own lists. */
  faces: number[][];
}

/**
 * Groups, in the order of their facets. Facets that are one bent side are one group, since which of them a face of
 * straight blocks comes nearest to says nothing; so are facets of the same given name. A bent side of several names has
 * them all, joined by "+". A facet without a name is called `facet`, a blank, and its number from 0.
 */
export function facetGroups(mesh: BlockMesh): FacetGroup[] {
  const sideOf = (facet: number): number => {
    const patch = mesh.patchOfFacet?.[facet] ?? -1;
    return patch >= 0 ? patch : facet;
  };
  const names = new Map<number, Set<string>>();
  mesh.facetNames?.forEach((name, facet) => {
    const side = sideOf(facet);
    if (name) names.set(side, (names.get(side) ?? new Set()).add(name));
  });
  const groups = new Map<string, FacetGroup>();
  const width = boundaryCorners(mesh);
  for (const [list, isInner] of [[mesh.boundary, false] as const, [mesh.interfaces, true] as const]) {
    list?.facet.forEach((given, i) => {
      const facet = sideOf(given);
      const name = [...(names.get(facet) ?? [`facet ${facet}`])].join('+');
      // A name may stand for faces on the boundary and inside, but only those on it can be a solver's patch.
      const key = `${isInner} ${name}`;
      const group = groups.get(key) ?? { facet, name, isInner, faces: [] };
      group.facet = Math.min(group.facet, facet);
      group.faces.push([...list.faces.subarray(width * i, width * (i + 1))]);
      groups.set(key, group);
    });
  }
  for (const group of groups.values())
    if (group.isInner && groups.has(`false ${group.name}`)) group.name += ' inside';
  return [...groups.values()].sort((a, b) => a.facet - b.facet || Number(a.isInner) - Number(b.isInner));
}

/** The regions of a mesh in ascending order; none where it has one only. */
export const regionsOf = (mesh: BlockMesh): number[] =>
  mesh.region ? [...new Set(mesh.region)].sort((a, b) => a - b) : [];

/**
 * Words for names, each once, for formats where a name is one word: what is neither a letter, a digit nor in `allowed`
 * becomes `_`, and names that would then be equal to one another or to one of `taken` get numbers. Every word begins with
 * a letter and has `longest` characters at the most, before such a number.
 */
export function uniqueWords(names: readonly string[], form: WordForm = {}): string[] {
  const { allowed = '', longest = kLongestWord } = form;
  // Solvers ignore case, so that counts as equal too.
  const taken = new Set(form.taken?.map((name) => name.toLowerCase()));
  return names.map((name) => {
    const clean = [...name].map((c) => (/[A-Za-z0-9_]/.test(c) || allowed.includes(c) ? c : '_')).join('');
    const word = (/^[A-Za-z]/.test(clean) ? clean : `f_${clean}`).slice(0, longest);
    let unique = word;
    for (let n = 2; taken.has(unique.toLowerCase()); n++) unique = `${word}_${n}`;
    taken.add(unique.toLowerCase());
    return unique;
  });
}

interface WordForm {
  allowed?: string;
  longest?: number;
  taken?: readonly string[];
}

/** Abaqus takes 80 characters; some are left for what is added to a word. */
const kLongestWord = 60;
