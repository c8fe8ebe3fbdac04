// The same for wasm/check, as a Vite plugin: checkMesh and what it imports, which leaves out the readers of files. The
// active mutant is the environment variable DUALBLOCK_MUTANT. Of the kinds of mutate-cpp.mjs there are `mute`, of calls of
// fail() and begin() and of throws, and `widen`.
//
// Why not Stryker: it would make thousands of mutants of this folder, most of them of arithmetic that is right by the
// tests' own comparisons, at seconds each. These are those that a check can die of.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { Changes, codeOnly, lineAt, named } from './source.mjs';

const folder = fileURLToPath(new URL('../../wasm/check/', import.meta.url));

/** Bounds of which the smaller is the wider: what rounding may do, how much is looked at, and what counts as a turn. */
const kSmallerIsWider =
  /\b(kRounding = 64|kSmallest =|kSure|kDoubt|kOnPlane|kInPlane|kMostPlaces|kVoters|kMostFaces|kMostPairs|kNewtonSteps|kDeepest|deepest\w*|kMostBoxes|kMostCrossings)\b/;

/** Not bounds: how trees are divided, for speed; and where an iteration has converged, on lines that break. */
const kNoBounds = /\bkLeaf\b|\bbreak;/;

function filesFrom(file, found = new Set()) {
  if (found.has(file)) return found;
  found.add(file);
  for (const [, other] of readFileSync(join(folder, file), 'utf8').matchAll(/from '\.\/([\w-]+\.ts)'/g))
    filesFrom(other, found);
  return found;
}

export function mutantsOf(file, text, first) {
  const code = codeOnly(text);
  const changes = new Changes(text);
  const mutants = [];
  const add = (kind, place) => {
    const { number, line } = lineAt(text, place);
    mutants.push({ id: first + mutants.length, file, kind, lineNumber: number, line });
    return `globalThis.dualblockMutant === ${first + mutants.length - 1}`;
  };
  const widen = (begin, end) => {
    if (kNoBounds.test(lineAt(text, begin).line)) return;
    const factor = kSmallerIsWider.test(lineAt(text, begin).line) ? '0.001' : '1000';
    changes.wrap(begin, end, `((${add('widen', begin)} ? ${factor} : 1) * (`, '))');
  };
  for (const { index } of code.matchAll(/(?<![\w.:])[\w.]+\.(fail|begin)\(/g))
    changes.insert(index, `${add('mute', index)} ? undefined : `);
  for (const { index } of code.matchAll(/\bthrow (?=[\w.]+\()/g))
    changes.insert(index, `if (!(${add('mute', index)})) `);
  const number = '(?:[\\d._]+(?:e-?\\d+)?|Number\\.EPSILON)';
  const definition = new RegExp(
    `^(?:export )?const \\w+ = (${number}(?: (?:\\*\\*?|/) -?${number})*);`,
    'gm',
  );
  const isDefined = new Set();
  for (const match of code.matchAll(definition)) {
    const begin = match.index + match[0].length - 1 - match[1].length;
    widen(begin, begin + match[1].length);
    isDefined.add(lineAt(text, begin).number);
  }
  for (const match of code.matchAll(/^(?:export )?const \w+(?:: \w+)? = \{(.*)\}(?: as const)?;/gm)) // objects of bounds
    for (const entry of match[1].matchAll(/\b\w+: ([\d.]+(?:e-\d+)?)(?=[, ])/g)) {
      const begin =
        match.index + match[0].indexOf(match[1]) + entry.index + entry[0].length - entry[1].length;
      widen(begin, begin + entry[1].length);
      isDefined.add(lineAt(text, begin).number);
    }
  for (const match of code.matchAll(/\b\d+(\.\d+)?e-\d+\b/g))
    if (!isDefined.has(lineAt(text, match.index).number)) widen(match.index, match.index + match[0].length);
  const start = 'globalThis.dualblockMutant ??= Number(process.env.DUALBLOCK_MUTANT ?? 0); ';
  return { mutants, text: start + changes.result() };
}

/** All mutants, and the changed text of each file by its path. */
export function mutated() {
  const mutants = [];
  const texts = new Map();
  for (const file of [...filesFrom('check.ts')].sort()) {
    const made = mutantsOf(file, readFileSync(join(folder, file), 'utf8'), mutants.length + 1);
    mutants.push(...made.mutants);
    if (made.mutants.length > 0) texts.set(join(folder, file), made.text);
  }
  return { mutants: named(mutants), texts };
}

export function mutation() {
  const { texts } = mutated();
  return {
    name: 'mutation',
    enforce: 'pre',
    transform: (_, id) => texts.get(id.split('?')[0]) ?? null,
  };
}
