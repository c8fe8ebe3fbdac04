// The command line as a value: strict, so that a slip never changes what is computed.
import { resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { type Mode, modes, type Objective, objectives } from '../settings.ts';
import { findOption, nearestOption, options } from './options.ts';
import { type GivenRefinement, refinementOf } from './refinement.ts';
import { type GivenInsertion, insertionOf } from './sides.ts';
import { badValue, between, quote, UsageError } from './usage.ts';

/** Settings that the command line gave; what is absent keeps its default. */
export interface GivenSettings {
  /** No refinement of the reference mesh, or its longest edge in the units of the input. */
  reference?: 'coarse' | number;
  /** 0 to 2^32 - 1. */
  seed?: number;
  /** Relative to the domain's size, over 0 and under 1. */
  tolerance?: number;
  featureAngle?: number | 'auto';
  timeLimit?: number;
  mode?: Mode;
  objective?: Objective;
  extract?: number[];
  relax?: false;
  insert?: GivenInsertion[];
}

export type Source = { kind: 'file'; path: string } | { kind: 'example'; name: string };

export type Command =
  | { kind: 'help' }
  | { kind: 'version' }
  | { kind: 'listExamples' }
  | {
      kind: 'run';
      source: Source;
      /** Files to write the mesh to, in the order given; none is allowed. */
      outputs: string[];
      /** A file for the JSON report, "-" for standard output, null for no report. */
      report: string | null;
      quiet: boolean;
      settings: GivenSettings;
      /** How blocks are divided; null: not at all. */
      refinement: GivenRefinement | null;
    }
  | {
      kind: 'check';
      /** The file with the mesh. */
      mesh: string;
      /** The domain that it should be a mesh of; null to check it by itself. */
      domain: Source | null;
      report: string | null;
      settings: Pick<GivenSettings, 'tolerance' | 'featureAngle'>;
    };

/**
 * Parses the words after the program's name. --help goes before --version, that before everything else; both still need
 * known options. Throws a UsageError for an unknown or repeated option, a missing, superfluous or impossible value, and
 * a missing or second input. Whether files exist and whether their extensions are known is not looked at.
 */
export function parseArguments(words: readonly string[]): Command {
  const { given, inputs } = collect(words);
  const first = (name: string): string | undefined => given.get(name)?.[0];

  if (given.has('help')) return { kind: 'help' };
  if (given.has('version')) return { kind: 'version' };
  if (given.has('list-examples')) {
    if (given.size === 1 && inputs.length === 0) return { kind: 'listExamples' };
    throw new UsageError('--list-examples goes with nothing else', 'write only dualblock --list-examples');
  }

  if (given.has('check')) return checkOf(inputs, given);

  const outputs = given.get('output') ?? [];
  if (outputs.includes('-')) {
    throw new UsageError('the mesh cannot be written to standard output', 'name a file: -o mesh.vtk');
  }
  const report = first('report') ?? null;
  const files = [...outputs, ...(report === null || report === '-' ? [] : [report])];
  const twice = files.find((file, i) => files.slice(0, i).some((other) => isSameFile(file, other)));
  if (twice !== undefined)
    throw new UsageError(`${quote(twice)} would be written twice`, 'give every output a name of its own');
  const source = sourceOf(inputs, first('example'));
  const lost = files.find((file) => source.kind === 'file' && isSameFile(file, source.path));
  if (lost !== undefined)
    throw new UsageError(`${quote(lost)} would replace the domain`, 'give every output a name of its own');
  return {
    kind: 'run',
    source,
    outputs,
    report,
    quiet: given.has('quiet'),
    settings: { ...settingsOf(first), ...meshSettingsOf(given) },
    refinement: refinementOf(given),
  };
}

/** By their paths alone: links are not followed. */
const isSameFile = (a: string, b: string): boolean => resolve(a) === resolve(b);

function checkOf(inputs: string[], given: Map<string, string[]>): Command {
  for (const name of [
    'output',
    'reference',
    'seed',
    'mode',
    'objective',
    'extract',
    'insert',
    'no-relax',
    'refine',
    'size',
    'grade',
  ])
    if (given.has(name)) throw new UsageError(`--${name} does not go with --check`, 'leave it out');
  const first = (name: string): string | undefined => given.get(name)?.[0];
  const [mesh, ...others] = inputs;
  if (mesh === undefined)
    throw new UsageError('there is no mesh to check', 'name a .vtk, .vtu, .msh, .mesh, .inp or .json file');
  if (mesh === '' || mesh === '-')
    throw new UsageError('the mesh is not read from standard input', 'name a file');
  if (others.length > 1)
    throw new UsageError(
      `there are ${others.length} domains: ${others.map(quote).join(', ')}`,
      'give one mesh and one domain',
    );
  const example = first('example');
  const domain = others.length === 0 && example === undefined ? null : sourceOf(others, example);
  const tolerance = first('tolerance');
  const featureAngle = first('feature-angle');
  const report = first('report') ?? null;
  if (report !== null && inputs.some((input) => isSameFile(report, input)))
    throw new UsageError(`the report would replace ${quote(report)}`, 'give it a name of its own');
  return {
    kind: 'check',
    mesh,
    domain,
    report,
    settings: {
      ...(tolerance === undefined ? {} : { tolerance: between('tolerance', tolerance, 1, kToleranceHint) }),
      ...(featureAngle === undefined ? {} : { featureAngle: angleOf(featureAngle) }),
    },
  };
}

/** Options with their values in order, and the other words. */
function collect(words: readonly string[]): { given: Map<string, string[]>; inputs: string[] } {
  const config = Object.fromEntries(
    Object.keys(options).map((name) => {
      const { short, value } = findOption(name) ?? {};
      return [name, { type: value ? 'string' : 'boolean', ...(short ? { short } : {}) } as const];
    }),
  );
  const { tokens } = parseArgs({ args: [...words], options: config, strict: false, tokens: true });
  const given = new Map<string, string[]>();
  const inputs: string[] = [];
  for (const token of tokens) {
    if (token.kind === 'positional') inputs.push(token.value);
    if (token.kind !== 'option') continue;
    const { name, rawName, value, inlineValue } = token;
    const option = findOption(name);
    if (!option) {
      const near = rawName.startsWith('--') ? nearestOption(name) : undefined;
      throw new UsageError(
        `there is no option ${rawName}`,
        near ? `did you mean --${near}?` : 'see dualblock --help',
      );
    }
    if (!option.value && value !== undefined)
      throw new UsageError(`${rawName} takes no value`, `write only ${rawName}`);
    if (option.value && (value === undefined || value === '' || (!inlineValue && /^-./.test(value)))) {
      const found = value ? `, and ${quote(value)} looks like an option` : '';
      throw new UsageError(`${rawName} needs a value${found}`, `write --${name}=${option.value}`);
    }
    const before = given.get(name);
    if (before && option.value && !option.repeatable) {
      throw new UsageError(`${rawName} is given twice`, 'give it once');
    }
    given.set(name, [...(before ?? []), ...(value === undefined ? [] : [value])]);
  }
  return { given, inputs };
}

function sourceOf(inputs: string[], example: string | undefined): Source {
  const [path] = inputs;
  if (inputs.length > 1) {
    throw new UsageError(
      `there are ${inputs.length} inputs: ${inputs.map(quote).join(', ')}`,
      'give one; put -o before an output',
    );
  }
  if (example !== undefined) {
    if (path === undefined) return { kind: 'example', name: example };
    throw new UsageError(`there is both the input ${quote(path)} and --example`, 'give one of them');
  }
  if (path === '') throw new UsageError('the name of the input is empty', 'name a file');
  if (path === '-') throw new UsageError('the domain is not read from standard input', 'name a file');
  if (path !== undefined) return { kind: 'file', path };
  throw new UsageError(
    'there is no input',
    'name a file, or an example with --example; see dualblock --help',
  );
}

const kToleranceHint = 'a number over 0 and under 1, such as 1e-8';

function settingsOf(first: (name: string) => string | undefined): GivenSettings {
  const settings: GivenSettings = {};
  const reference = first('reference');
  const seed = first('seed');
  const tolerance = first('tolerance');
  const timeLimit = first('time-limit');
  const featureAngle = first('feature-angle');
  if (reference !== undefined) {
    settings.reference =
      reference === 'coarse'
        ? 'coarse'
        : between('reference', reference, Infinity, 'coarse or a length over 0');
  }
  if (seed !== undefined) {
    settings.seed = Number(seed);
    if (!/^\d+$/.test(seed) || settings.seed >= 2 ** 32)
      throw badValue('seed', seed, 'a whole number from 0 to 4294967295');
  }
  if (tolerance !== undefined) {
    settings.tolerance = between('tolerance', tolerance, 1, kToleranceHint);
  }
  if (featureAngle !== undefined) settings.featureAngle = angleOf(featureAngle);
  if (timeLimit !== undefined)
    settings.timeLimit = between('time-limit', timeLimit, Infinity, 'seconds over 0');
  return settings;
}

/** Which mesh is made of the layered one. */
function meshSettingsOf(given: Map<string, string[]>): GivenSettings {
  const settings: GivenSettings = {};
  const mode = given.get('mode')?.[0];
  if (mode !== undefined) {
    const known = modes.find((m) => m === mode);
    if (!known) throw badValue('mode', mode, 'layered or coarsest');
    settings.mode = known;
  }
  const objective = given.get('objective')?.[0];
  if (objective !== undefined) {
    const known = objectives.find((o) => o === objective);
    if (!known) throw badValue('objective', objective, 'blocks or shape');
    settings.objective = known;
  }
  const extract = given.get('extract');
  const again = extract?.find((id, k) => extract.indexOf(id) < k);
  if (again !== undefined)
    throw new UsageError(`--extract ${again} is given twice`, 'a D̄-surface is extracted once');
  if (extract)
    settings.extract = extract.map((id) => {
      if (/^\d{1,9}$/.test(id)) return Number(id);
      throw badValue('extract', id, 'the number of a D̄-surface, from 0 on');
    });
  const insert = given.get('insert');
  if (insert) settings.insert = insert.map(insertionOf);
  if (given.has('no-relax')) settings.relax = false;
  return settings;
}

function angleOf(value: string): number | 'auto' {
  if (value === 'auto') return value;
  const degrees = /^\d+\.?\d*$/.test(value) ? Number(value) : Number.NaN;
  if (degrees <= 180) return degrees;
  throw badValue('feature-angle', value, 'auto, or degrees from 0 to 180');
}
