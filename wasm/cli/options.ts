// The options of the command line: one table for the parser and for --help.

export interface Option {
  short?: string;
  /** The value's name in the help; none for a switch. */
  value?: string;
  /** May be given more than once. */
  repeatable?: boolean;
  help: string;
}

export const options = {
  example: { value: 'NAME', help: 'take a built-in example domain instead of a file' },
  'list-examples': { help: 'list the example domains' },
  check: { help: 'check a block mesh by itself, or against its domain' },
  output: {
    short: 'o',
    value: 'OUTPUT',
    repeatable: true,
    help: 'write the mesh, format by extension; may be repeated',
  },
  report: { value: 'FILE|-', help: 'write the JSON report to a file, or to standard output' },
  quiet: { help: 'no progress on standard error' },
  reference: { value: 'coarse|H', help: 'refinement of the reference mesh: none, or the longest edge H' },
  seed: { value: 'N', help: 'seed of every random choice, 0 to 4294967295' },
  tolerance: { value: 'T', help: "coplanarity tolerance relative to the domain's size, over 0 and under 1" },
  'feature-angle': {
    value: 'DEG',
    help: 'facets that meet at less are one bent side, 0 to 180; auto: 35, if six join',
  },
  mode: { value: 'MODE', help: 'layered: blocks along every side (default); coarsest: as few as can be' },
  objective: {
    value: 'MODE',
    help: 'of the choice of parts: blocks, few of them (default), or shape, the best',
  },
  extract: { value: 'ID', repeatable: true, help: 'collapse the layer of a D̄-surface; may be repeated' },
  insert: {
    value: 'FACET=SHARE',
    repeatable: true,
    help: 'split the layer along a facet, SHARE of it next to that; may be repeated',
  },
  'no-relax': { help: 'leave nodes where they are placed first' },
  refine: {
    value: 'N|ID=N',
    repeatable: true,
    help: 'divide every edge, or those across a D̄-surface, into N; may be repeated',
  },
  size: { value: 'H', help: 'divide edges into as many intervals as keep them no longer than H' },
  grade: {
    value: 'FACET=G',
    repeatable: true,
    help: 'elements grow by the factor G away from a facet; may be repeated',
  },
  straight: { help: 'elements may stay straight, off a bent side, where bent ones fail' },
  'time-limit': { value: 'S', help: 'give up after S seconds; without it a run takes as long as it needs' },
  help: { help: 'print this text' },
  version: { help: 'print the version' },
} as const satisfies Record<string, Option>;

export type OptionName = keyof typeof options;

/** The table's row of an option, or undefined for a name that is none. */
export function findOption(name: string): Option | undefined {
  return Object.hasOwn(options, name) ? options[name as OptionName] : undefined;
}

/** The text of --help, ended by a line end. */
export function helpText(): string {
  const rows = Object.entries<Option>(options).map(([name, { short, value, help }]) => {
    const flag = `${short ? `-${short}, ` : '    '}--${name}${value ? ` ${value}` : ''}`;
    return `  ${flag.padEnd(28)} ${help}`;
  });
  return [
    'dualblock: block meshes of polyhedral and polygonal domains',
    '',
    'usage: dualblock INPUT [-o OUTPUT ...] [--report FILE|-] [options]',
    '       dualblock --example NAME [-o OUTPUT ...] [--report FILE|-] [options]',
    '       dualblock --list-examples',
    '       dualblock --check MESH [DOMAIN | --example NAME] [--report FILE|-]',
    '',
    'INPUT and DOMAIN, by extension: .json .off .stl .obj .ply .poly .smesh',
    'OUTPUT, by extension: .vtk .vtu .msh .mesh .inp .cgns .json, and blockMeshDict by its name',
    'MESH, by extension: .vtk .vtu .msh .mesh .inp .json',
    '',
    ...rows,
    '',
    'exit status: 0 a certified mesh, 1 bad input, 2 bad usage, 3 no valid mesh found, or one that fails --check',
    '',
  ].join('\n');
}

/** The known option closest to an unknown one, when at most two letters differ. */
export function nearestOption(name: string): string | undefined {
  const ranked = Object.keys(options)
    .map((known) => ({ known, distance: editDistance(name, known) }))
    .sort((a, b) => a.distance - b.distance);
  const [best] = ranked;
  return best && best.distance <= 2 ? best.known : undefined;
}

/** Levenshtein's distance. */
function editDistance(a: string, b: string): number {
  let row = Array.from({ length: b.length + 1 }, (_, j) => j);
  for (let i = 1; i <= a.length; i++) {
    const next = [i];
    for (let j = 1; j <= b.length; j++) {
      const change = (row[j - 1] ?? 0) + (a[i - 1] === b[j - 1] ? 0 : 1);
      next.push(Math.min(change, (row[j] ?? 0) + 1, (next[j - 1] ?? 0) + 1));
    }
    row = next;
  }
  return row[b.length] ?? 0;
}
