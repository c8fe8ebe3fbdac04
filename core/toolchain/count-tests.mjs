// Adds up what GoogleTest and Vitest report about the last `npm test`: the last line is 'N passed, N failed'.
// Fails if a report is missing or a test failed.
import { readFileSync, rmSync } from 'node:fs';

const kFolder = 'build/sanitize';

/** How many processes share the native tests, as CMake has laid them out. */
function shards() {
  try {
    return readFileSync(`${kFolder}/CTestTestfile.cmake`, 'utf8').match(/^add_test\(/gm)?.length ?? 1;
  } catch {
    return 1; // not built: that one's report is missing
  }
}

const reports = [
  ...Array.from({ length: shards() }, (_, shard) => ({
    file: `${kFolder}/reports/${shard}.xml`,
    count(text) {
      const suites = /<testsuites\b[^>]*>/.exec(text)[0];
      const number = (name) => Number(new RegExp(`\\b${name}="(\\d+)"`).exec(suites)[1]);
      const failed = number('failures') + number('errors');
      const skipped = text.match(/<skipped\b/g)?.length ?? 0;
      return { passed: number('tests') - failed - skipped - number('disabled'), failed };
    },
  })),
  {
    file: 'build/vitest.json',
    count(text) {
      const report = JSON.parse(text);
      // A test file that cannot be loaded has no tests in it, and counts as one failure.
      const broken = report.testResults.filter(
        (f) => f.status === 'failed' && f.assertionResults.length === 0,
      );
      return { passed: report.numPassedTests, failed: report.numFailedTests + broken.length };
    },
  },
];

if (process.argv.includes('--clear')) {
  for (const { file } of reports) rmSync(file, { force: true });
} else {
  let passed = 0;
  let failed = 0;
  for (const { file, count } of reports) {
    try {
      const counts = count(readFileSync(file, 'utf8'));
      passed += counts.passed;
      failed += counts.failed;
    } catch (error) {
      console.error(`no usable report in ${file}: ${error.message}`);
      process.exitCode = 1;
    }
  }
  if (failed > 0) process.exitCode = 1;
  console.log(`${passed} passed, ${failed} failed`);
}
