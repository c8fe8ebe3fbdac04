// Tests that notice when a check dies: switches off every check and widens every bound of the certificate
// (core/certificate) and of the checker (wasm/check), one at a time, and runs their tests. What no test notices has to
// have its reason in survivors.json, and no other may be there.
//
//   node tests/mutate/mutate.mjs [native|check] [--sample <count>] [--preset <CMake preset>] [--only <text>]
import { readFileSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { parseArgs } from 'node:util';
import { check } from './check.mjs';
import { native } from './native.mjs';

const kLeastScore = 95; // per cent

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    sample: { type: 'string' },
    preset: { type: 'string', default: 'native' },
    only: { type: 'string' },
    verbose: { type: 'boolean' },
  },
});
const isSample = values.sample !== undefined;
const reasons = JSON.parse(readFileSync(new URL('survivors.json', import.meta.url), 'utf8'));

/**
 * All mutants, or so many of them, evenly spread over the files: the same ones every time, and none of those known to
 * survive, for which all tests would be run.
 */
function chosen(mutants, known) {
  const named = mutants.filter(
    ({ name }) => name.includes(values.only ?? '') && !(isSample && name in known),
  );
  const step = named.length / Number(values.sample ?? named.length);
  return named.filter((_, k) => Math.floor(k / step) !== Math.floor((k - 1) / step));
}

async function judge({ name, mutants, run, workers = availableParallelism(), close = () => {} }) {
  const begin = Date.now();
  const known = reasons[name] ?? {};
  const queue = chosen(mutants, known);
  const survivors = [];
  const count = queue.length;
  const work = async () => {
    for (let mutant = queue.shift(); mutant; mutant = queue.shift()) {
      const { passed, by, seconds } = await run(mutant);
      if (passed || values.verbose)
        console.log(`${mutant.id} ${passed ? 'SURVIVES' : by} ${seconds.toFixed(1)} s: ${mutant.name}`);
      if (passed) survivors.push(mutant);
    }
  };
  await Promise.all(Array.from({ length: workers }, work));
  await close();
  survivors.sort((a, b) => a.id - b.id);

  let isRight = true;
  for (const mutant of survivors) {
    const reason = known[mutant.name];
    console.log(`survives: ${mutant.name} (line ${mutant.lineNumber})\n    ${reason ?? 'NO REASON GIVEN'}`);
    isRight &&= reason !== undefined;
  }
  const left = new Set(survivors.map((mutant) => mutant.name));
  const tried = new Set(chosen(mutants, known).map((mutant) => mutant.name));
  const names = new Set(mutants.map((mutant) => mutant.name));
  for (const stale of Object.keys(known).filter(
    (key) => !names.has(key) || (tried.has(key) && !left.has(key)),
  )) {
    console.log(
      `${names.has(stale) ? 'is noticed by now' : 'is no mutant any more'}, take out its reason: ${stale}`,
    );
    isRight = false;
  }
  const score = (100 * (count - survivors.length)) / Math.max(count, 1);
  const seconds = ((Date.now() - begin) / 1000).toFixed(0);
  console.log(
    `${name}: ${count - survivors.length} of ${count} mutants noticed, ${score.toFixed(1)} %, ${seconds} s`,
  );
  return isRight && (isSample || values.only !== undefined || score >= kLeastScore);
}

const kinds = { native: () => native(values.preset), check: () => check(isSample) };
const wanted = positionals.length > 0 ? positionals : Object.keys(kinds);
const verdicts = [];
if (isSample)
  // At the same time, for npm test waits for it.
  verdicts.push(...(await Promise.all(wanted.map(async (kind) => judge(await kinds[kind]())))));
else for (const kind of wanted) verdicts.push(await judge(await kinds[kind]()));
process.exitCode = verdicts.every((isRight) => isRight) ? 0 : 1;
