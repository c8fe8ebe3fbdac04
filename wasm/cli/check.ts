// `dualblock --check MESH [DOMAIN]`: the independent checker on files. The core is not even loaded.
import { checkMesh, defaultCheckSettings } from '../check/check.ts';
import { domainReader } from '../check/read-domain.ts';
import { meshReader } from '../check/read-mesh.ts';
import { describeCheck, makeCheckErrorReport, makeCheckReport } from '../check/report.ts';
import type { Command } from './arguments.ts';
import { asDualblockError, exitStatus, statusOf } from './exit-status.ts';
import { putReport, readInput, readSource } from './files.ts';
import { UsageError } from './usage.ts';

/** Checks the mesh and says what it found. Returns the exit status; throws UsageError. */
export async function check({ mesh, domain, report, settings: given }: Extract<Command, { kind: 'check' }>) {
  const settings = { ...defaultCheckSettings, ...given };
  const names = { mesh, domain: domain && (domain.kind === 'file' ? domain.path : domain.name) };
  let file = mesh; // the one that an error is about
  try {
    const readMesh = meshReader(mesh);
    const blocks = readMesh(await readInput(mesh));
    file = names.domain ?? mesh;
    const source = domain && (await readSource(domain));
    const result = checkMesh(blocks, source && domainReader(source.name)(source.bytes), settings);
    const made = makeCheckReport(result, blocks.dimension, names, settings);
    await putReport(report, made);
    if (report !== '-') process.stdout.write(`${describeCheck(made)}\n`);
    return made.valid ? exitStatus.certified : exitStatus.noValidMesh;
  } catch (thrown) {
    if (thrown instanceof UsageError) throw thrown;
    const error = asDualblockError(thrown);
    const { code, message, entities } = error;
    await putReport(report, makeCheckErrorReport(names, settings, { code, message, entities }));
    process.stderr.write(`dualblock: ${file}: ${message} [${code}]\n`);
    return statusOf(error);
  }
}
