// Errors that code throws, for tests that need no core too.
import { DualblockError } from '../../../wasm/io/errors.ts';

/** The DualblockError that `work` throws; fails for anything else. */
export function errorOf(work: () => unknown): DualblockError {
  try {
    work();
  } catch (error) {
    if (error instanceof DualblockError) return error;
    throw error;
  }
  throw new Error('there was no error');
}

/** Entities in short: "facet 3,vertex 0". */
export const entitiesOf = (error: DualblockError): string =>
  error.entities.map(({ kind, index }) => `${kind} ${index}`).join();
