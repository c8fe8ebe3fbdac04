// The exit statuses that scripts depend on, and which of them an error means.
import { DualblockError } from '../io/errors.ts';

export const exitStatus = { certified: 0, badInput: 1, badUsage: 2, noValidMesh: 3 };
const notTheInputsFault = [
  'tetgenFailed',
  'outOfMemory',
  'timeLimit',
  'noValidMesh',
  'libraryMissing',
  'internal',
];

export const statusOf = ({ code }: DualblockError): number =>
  notTheInputsFault.includes(code) ? exitStatus.noValidMesh : exitStatus.badInput;

/** Whatever was thrown, such as a trap of the core, as an error of its own. */
export function asDualblockError(error: unknown): DualblockError {
  if (error instanceof DualblockError) return error;
  const text = error instanceof Error ? error.message : String(error);
  return new DualblockError('internal', `a defect in dualblock: ${text}. Please report it.`);
}
