// What the checks find: verdicts, failures and remarks.
import type { EntityReference } from '../io/errors.ts';

/** In the order in which they are made. */
export const checkNames = [
  'nodes',
  'topology',
  'geometry',
  'overlap',
  'shape',
  'measure',
  'vertices',
  'facets',
  'fidelity',
  'regions',
] as const;
export type CheckName = (typeof checkNames)[number];

export interface Failure {
  check: CheckName;
  message: string;
  entities: EntityReference[];
}

/** Failures that are kept of each check; the others are only counted. */
const kMostFailures = 8;

export class Findings {
  /** Passed or not; null for what was not asked for, or could not be looked at. */
  readonly verdicts: Record<CheckName, boolean | null>;
  readonly failures: Failure[] = [];
  readonly notes: string[] = [];
  private readonly counts = new Map<CheckName, number>();

  constructor() {
    this.verdicts = Object.fromEntries(checkNames.map((name) => [name, null])) as Record<CheckName, null>;
  }

  /** Says that a check is made: it passes unless it fails later. */
  begin(check: CheckName): void {
    this.verdicts[check] ??= true;
  }

  fail(check: CheckName, message: string, entities: EntityReference[] = []): void {
    this.verdicts[check] = false;
    const count = (this.counts.get(check) ?? 0) + 1;
    this.counts.set(check, count);
    if (count <= kMostFailures) this.failures.push({ check, message, entities });
  }

  /** How many failures of a check were found, kept or not. */
  count(check: CheckName): number {
    return this.counts.get(check) ?? 0;
  }

  get valid(): boolean {
    return this.failures.length === 0;
  }
}

/** A block, node, or face by its nodes, for a failure. */
export const entity = (kind: string, ...indices: number[]): EntityReference[] =>
  indices.map((index) => ({ kind, index }));
