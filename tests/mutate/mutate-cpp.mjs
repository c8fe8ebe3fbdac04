// Writes a copy of core/certificate/*.cpp in which every check can be switched off and every bound widened, one at a
// time, by the environment variable DUALBLOCK_MUTANT; and the list of these mutants.
//
//   node tests/mutate/mutate-cpp.mjs <folder>
//
// Kinds: `mute`, a call of fail() is not made; `skip`, the body of an `if` is never run; `leave`, an `if` before a
// return, continue or break always does it, so that what follows is not done; `keep`, such a return of a value that is no
// approval is never made; `widen`, a bound is a thousand times as large (or as small, where that is the wider one).
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { Changes, closing, codeOnly, lineAt, named } from './source.mjs';

const folder = fileURLToPath(new URL('../../core/certificate/', import.meta.url));

/** Bounds of which the smaller is the wider: named constants, and lines with others. */
const kSmallerIsWider = [
  /constexpr .*\b(kSamples|kElementSamples|kPieces|kMostDivisions|kCrossings|kElementCrossings|kPairsOfFaces|kAttempts) =/, // more is looked at
  /constexpr .*\bkBorder =|outward\) <= 1e-7/, // more rays are unclear
  /<= error\) return -1/, // more is refused
  /!\(.* > (tolerance|1e-9 \* length)\)/, // has to be exceeded
];

/** Tolerances have these names, or are constants. */
const kBound = /\b(tolerance|allowed|error|overlap_|bound|slack|margin|facetDeviation|unit)\b/g;

/** Behind the statement that an `if` may begin with; what ends with a semicolon within a lambda is none. */
function startOfCondition(inside) {
  let depth = 0;
  for (let k = 0; k < inside.length; k++) {
    if ('([{'.includes(inside[k])) depth++;
    if (')]}'.includes(inside[k])) depth--;
    if (inside[k] === ';' && depth === 0) return k + 1;
  }
  return 0;
}

export function mutantsOf(file, text, constants, first) {
  const code = codeOnly(text);
  const changes = new Changes(text);
  const mutants = [];
  const add = (kind, place) => {
    const { number, line } = lineAt(text, place);
    mutants.push({ id: first + mutants.length, file, kind, lineNumber: number, line });
    return first + mutants.length - 1;
  };
  const widen = (begin, end) => {
    const { line } = lineAt(text, begin);
    const factor = kSmallerIsWider.some((pattern) => pattern.test(line)) ? '0.001' : '1000';
    changes.wrap(begin, end, `widened(${add('widen', begin)}, ${factor}, `, ')');
  };

  for (const { index } of code.matchAll(/(?<![\w.:])\w+(?:\([^()]*\))?\.fail\(/g))
    changes.insert(index, `mutantIs(${add('mute', index)}) ? void() : `);

  // What is worked out when compiling cannot ask: tables.
  const tables = [...code.matchAll(/\bconstexpr [\w:<>]+ \w+\([^()]*\) \{/g)].map((match) => {
    const open = match.index + match[0].length - 1;
    return [open, closing(code, open)];
  });
  for (const { index, 0: head } of code.matchAll(/\bif \(/g)) {
    if (tables.some(([from, to]) => index > from && index < to)) continue;
    const open = index + head.length - 1;
    const close = closing(code, open);
    const inside = code.slice(open + 1, close);
    const begin = open + 1 + startOfCondition(inside);
    if (/^\s*(const )?[\w:<>]+ [*&]?\w+ = /.test(code.slice(begin, close))) continue; // a declaration by itself
    const body = code
      .slice(close + 1)
      .trimStart()
      .replace(/^\{\s*/, '');
    const isExit = /^(return|continue|break)\b/.test(body);
    if (isExit) changes.wrap(begin, close, ` mutantIs(${add('leave', index)}) || (`, ')');
    if (!isExit || /^return (?!true;|1;)[^;]/.test(body))
      changes.wrap(begin, close, ` !mutantIs(${add(isExit ? 'keep' : 'skip', index)}) && (`, ')');
  }

  // Named constants: no longer known when compiling, but when the program starts.
  const definition = /(static |inline )?constexpr ((?:double|int|Index|std::size_t) k\w+ =) ([\d.e/ -]+);/g;
  for (const match of code.matchAll(definition)) {
    const value = match.index + match[0].lastIndexOf('= ') + 2;
    changes.cut(match.index, match.index + match[0].indexOf(match[2]));
    changes.insert(match.index, match[1] ? 'static inline const ' : 'const ');
    widen(value, match.index + match[0].length - 1);
  }
  const isDefined = (place) => /constexpr/.test(lineAt(code, place).line);

  for (const match of code.matchAll(/\b\d+(\.\d+)?e-\d+\b|\b\d+(?= \* kDegree\b)/g))
    if (!isDefined(match.index)) widen(match.index, match.index + match[0].length);
  for (const match of code.matchAll(kBound)) {
    const before = code.slice(0, match.index).replace(/in\.$/, '');
    const isPart = match[0] === 'unit' ? /\d \* $/ : /([<>]=?|[-+*]) $/; // of a comparison, a sum or a product
    // Ranges that are searched are no bounds: in wider ones the search only takes longer.
    if (/^for \(|lower_bound/.test(lineAt(text, match.index).line)) continue;
    if (!isPart.test(before) || /Vec<\d> $/.test(before)) continue;
    widen(before.length, match.index + match[0].length);
  }
  for (const match of code.matchAll(/\bk[A-Z]\w*\b/g))
    if (constants.has(match[0])) widen(match.index, match.index + match[0].length);

  return { mutants, text: changes.result() };
}

/** All mutants, and the changed text of each file by its name. */
export function mutated() {
  const files = readdirSync(folder).sort();
  const read = (file) => readFileSync(join(folder, file), 'utf8');
  // Headers stay as they are, for others read them, too: their constants are widened wherever they are used.
  const constants = new Set();
  for (const file of files.filter((name) => name.endsWith('.h')))
    for (const match of codeOnly(read(file)).matchAll(/constexpr double (k\w+) = [\d. /]+;/g))
      constants.add(match[1]);
  const mutants = [];
  const texts = new Map();
  for (const file of files.filter((name) => name.endsWith('.cpp'))) {
    const made = mutantsOf(file, read(file), constants, mutants.length + 1);
    mutants.push(...made.mutants);
    texts.set(file, `#include "mutate/mutant.h"\n#line 1 "core/certificate/${file}"\n${made.text}`);
  }
  return { mutants: named(mutants), texts };
}

function main(target) {
  mkdirSync(target, { recursive: true });
  const { mutants, texts } = mutated();
  for (const [file, text] of texts) writeFileSync(join(target, file), text);
  writeFileSync(join(target, 'mutants.json'), `${JSON.stringify(mutants, null, 1)}\n`);
}

if (process.argv[1] === fileURLToPath(import.meta.url)) main(process.argv[2]);
