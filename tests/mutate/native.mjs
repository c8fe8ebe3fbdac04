// Runs the native tests against every mutant of core/certificate (see mutate-cpp.mjs), or a sample of them.
import { spawn } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { isDeepStrictEqual } from 'node:util';
import { mutated } from './mutate-cpp.mjs';

const root = fileURLToPath(new URL('../..', import.meta.url));

/** Tests of the certificate itself, which take seconds. */
const kFilter = [
  'Certificate*',
  'Embedding*',
  'Fidelity*',
  'Elements*',
  'Jacobian*',
  'GivenMatching*',
  'PaperTiling*',
  'Assembly*',
]
  .flatMap((name) => [name, `*/${name}`])
  .join(':');

/** Fails, crashes or does not end: the mutant is noticed. */
function runTests(program, mutant, limit) {
  return new Promise((resolve) => {
    const begin = Date.now();
    const child = spawn(program, [`--gtest_filter=${kFilter}`, '--gtest_fail_fast', '--gtest_brief=1'], {
      cwd: root,
      env: { ...process.env, DUALBLOCK_MUTANT: String(mutant), LSAN_OPTIONS: 'detect_leaks=0' },
      stdio: ['ignore', 'pipe', 'ignore'],
    });
    let output = '';
    child.stdout.on('data', (data) => {
      if (output.length < 100_000) output += data;
    });
    const timer = setTimeout(() => child.kill('SIGKILL'), limit);
    child.on('close', (code) => {
      clearTimeout(timer);
      const seconds = (Date.now() - begin) / 1000;
      const failed = /\[ {2}FAILED {2}\] ([\w/.]+)/.exec(output)?.[1];
      resolve({
        passed: code === 0,
        by: failed ?? (code === null ? 'takes too long' : `ends with ${code}`),
        seconds,
      });
    });
  });
}

/** The list, a first run without a mutant, and a function that runs one. */
export async function native(preset) {
  const program = `${root}/build/${preset}/dualblock-mutants`;
  const list = `${root}/build/${preset}/mutated/certificate/mutants.json`;
  if (!existsSync(program)) throw new Error(`${program} is missing: build its target`);
  const { mutants } = mutated();
  if (!isDeepStrictEqual(mutants, JSON.parse(readFileSync(list, 'utf8'))))
    throw new Error(`${program} has other mutants than the source: build its target anew`);
  const whole = await runTests(program, 0, 600_000);
  if (!whole.passed) throw new Error(`without a mutant the tests fail: ${whole.by}`);
  const limit = 20_000 + 5000 * whole.seconds;
  return {
    name: 'core/certificate',
    mutants,
    run: (mutant) => runTests(program, mutant.id, limit),
  };
}
