// What check "fidelity" measures, and how much it allows.
import type { EntityReference } from '../io/errors.ts';
import type { Findings } from './findings.ts';
import type { Vector } from './vector.ts';

export interface Fidelity {
  /** Between a face or edge of the mesh and what it stands for, over the face's diameter or the edge's length. */
  largestDistance: number;
  /** Degrees by which what one face or edge stands for turns. */
  largestTurning: number;
  /** Of the volumes, over the domain's. */
  volumeDifference: number;
}

/**
 * What the coarsest meshes of round things need, and folded or gutted ones exceed. An edge across a third of a turn is
 * 0.29 of its length off the arc, one across a half 0.5, and a face across a rounded right angle up to 0.39 of its
 * diameter. A face that stands for a sixth of a ball spans 110 degrees; facets that reach over its sides may add to that.
 * A ball of 32 blocks lacks a fifth of its volume, a prism of four sides in a cylinder 0.36, a torus of such sides 0.406,
 * a prism of three sides 0.59.
 */
export const bounds = { distance: 0.4, turning: 130, volume: 0.41 } as const;

/** A face or edge of the mesh, for people and for programs. */
export interface Named {
  name: string;
  entities: EntityReference[];
}

export class Measures implements Fidelity {
  largestDistance = 0;
  largestTurning = 0;
  readonly volumeDifference: number;
  private readonly findings: Findings;

  constructor(volumeDifference: number, findings: Findings) {
    this.volumeDifference = volumeDifference;
    this.findings = findings;
    if (volumeDifference <= bounds.volume) return;
    const share = (100 * volumeDifference).toPrecision(3);
    this.fail(`the volumes differ by ${share} % of the domain's; ${100 * bounds.volume} % are allowed`);
  }

  /** Takes down how far something is from what it stands for, over its size. */
  distance(relative: number, { name, entities }: Named, place: Vector): void {
    this.largestDistance = Math.max(this.largestDistance, relative);
    if (relative <= bounds.distance) return;
    const at = place.map((x) => Number(x.toPrecision(6))).join(', ');
    this.fail(
      `${name} and what it stands for are ${relative.toPrecision(3)} of its size apart at (${at}); ${bounds.distance} are allowed`,
      entities,
    );
  }

  /** Takes down by how many degrees that turns. */
  turning(degrees: number, { name, entities }: Named): void {
    this.largestTurning = Math.max(this.largestTurning, degrees);
    if (degrees <= bounds.turning) return;
    this.fail(
      `${name} stands for what turns by ${degrees.toFixed(0)} degrees; ${bounds.turning} are allowed`,
      entities,
    );
  }

  fail(message: string, entities: EntityReference[] = []): void {
    this.findings.fail('fidelity', message, entities);
  }

  get values(): Fidelity {
    const { largestDistance, largestTurning, volumeDifference } = this;
    return { largestDistance, largestTurning, volumeDifference };
  }
}
