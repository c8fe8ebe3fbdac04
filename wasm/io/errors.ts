import type { ErrorCode } from '../error-codes.ts';
import type { Polygons } from '../result.ts';

/** Something at fault: its kind ("line", "vertex", "facet", ...) and its number, from 1 for lines, else from 0. */
export interface EntityReference {
  kind: string;
  index: number;
}

/** An error with a code from the one list, a message that names the remedy, and the entities at fault. */
export class DualblockError extends Error {
  readonly code: ErrorCode;
  readonly entities: EntityReference[];
  /** The domain as it was given, where it could be read: what vertex, facet and edge entities refer to. */
  readonly given: Polygons | undefined;

  /** `message` says what is wrong, where, and what to do about it; `entities` may be empty. */
  constructor(code: ErrorCode, message: string, entities: EntityReference[] = [], given?: Polygons) {
    super(message);
    this.name = 'DualblockError';
    this.code = code;
    this.entities = entities;
    this.given = given;
  }
}
