// Runs the checker's tests against every mutant of wasm/check (see mutate-ts.mjs), or a sample of them: one Vitest for
// all, whose files are transformed once. Each mutant has a worker of its own, for all of its test files: starting one for
// each file takes longer than the tests.
import { fileURLToPath } from 'node:url';
import { createVitest } from 'vitest/node';
import { mutated, mutation } from './mutate-ts.mjs';

const root = fileURLToPath(new URL('../..', import.meta.url));

/** Tests that need no core, those that find most in least time first: the next ones are run if these find nothing. */
const kGroups = [
  ['refused', 'mesh', 'regions', 'solid', 'bounds'],
  ['curved', 'overlap', 'fidelity'],
  ['exact', 'kept'],
].map((group) => group.map((name) => `tests/node/check-${name}.test.ts`));

/** With a sample only the first tests are run without a mutant, for npm test has run them all just now. */
export async function check(isSample) {
  const vitest = await createVitest(
    'test',
    {
      root,
      config: false,
      include: kGroups.flat(),
      watch: false,
      reporters: [{}],
      testTimeout: 20_000,
      isolate: false,
      maxWorkers: 1,
      bail: 1,
    },
    { plugins: [mutation()] },
  );
  const all = await vitest.globTestSpecifications();
  const groups = kGroups.map((files) =>
    all.filter(({ moduleId }) => files.some((file) => moduleId.endsWith(file))),
  );
  const runGroup = async (specifications) => {
    const { testModules, unhandledErrors } = await vitest.runTestSpecifications(specifications);
    const own = testModules.filter(({ moduleId }) => specifications.some((s) => s.moduleId === moduleId)); // of all runs
    const failed = own.filter((module) => module.state() === 'failed');
    const test = failed.flatMap((module) => [...module.children.allTests('failed')])[0]?.fullName;
    return test ?? failed[0]?.moduleId ?? (unhandledErrors.length > 0 ? String(unhandledErrors[0]) : null);
  };
  const runWith = async (id, tried) => {
    const begin = Date.now();
    process.env.DUALBLOCK_MUTANT = String(id);
    let by = null;
    for (const group of tried) by ??= await runGroup(group);
    return { passed: by === null, by, seconds: (Date.now() - begin) / 1000 };
  };
  /** Tests that bear the name of the mutant's file come before all others. */
  const ownFirst = (file) => {
    const own = all.filter(({ moduleId }) => moduleId.endsWith(`check-${/^[a-z]+/.exec(file)}.test.ts`));
    return [own, ...groups.map((group) => group.filter((one) => !own.includes(one)))].filter(
      (group) => group.length > 0,
    );
  };
  const whole = await runWith(0, isSample ? groups.slice(0, 1) : groups);
  if (!whole.passed) throw new Error(`without a mutant the tests fail: ${whole.by}`);
  return {
    name: 'wasm/check',
    mutants: mutated().mutants,
    run: ({ id, file }) => runWith(id, ownFirst(file)),
    workers: 1, // it has workers of its own
    close: () => vitest.close(),
  };
}
