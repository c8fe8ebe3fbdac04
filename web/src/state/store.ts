// One value, who listens to it, and its history.

export interface Change {
  /** Changes with the same key that follow each other quickly are undone together: a slider being dragged. */
  merge?: string;
  /** Not undone: replaces the value in place. */
  silent?: boolean;
}

const mergeWithin = 800; // ms
const historyLength = 300;

export class Store<S> {
  private value: S;
  private past: S[] = [];
  private future: S[] = [];
  private lastMerge = '';
  private lastTime = Number.NEGATIVE_INFINITY;
  private readonly listeners = new Set<(now: S, before: S) => void>();
  private readonly clock: () => number;

  constructor(initial: S, clock: () => number = () => performance.now()) {
    this.value = initial;
    this.clock = clock;
  }

  get state(): S {
    return this.value;
  }
  get canUndo(): boolean {
    return this.past.length > 0;
  }
  get canRedo(): boolean {
    return this.future.length > 0;
  }

  /** Changes some members; nothing happens where they have their new values already. */
  set(patch: Partial<S>, { merge = '', silent = false }: Change = {}): void {
    const before = this.value;
    const keys = Object.keys(patch) as (keyof S)[];
    if (keys.every((key) => Object.is(before[key], patch[key]))) return;
    const now = { ...before, ...patch };
    if (!silent) {
      const time = this.clock();
      const merges = merge !== '' && merge === this.lastMerge && time - this.lastTime < mergeWithin;
      if (!merges) {
        this.past.push(before);
        if (this.past.length > historyLength) this.past.shift();
      }
      this.future = [];
      this.lastMerge = merge;
      this.lastTime = time;
    }
    this.show(now);
  }

  undo(): boolean {
    return this.travel(this.past, this.future);
  }

  redo(): boolean {
    return this.travel(this.future, this.past);
  }

  /** Returns the function that ends the subscription. */
  subscribe(listener: (now: S, before: S) => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  private travel(from: S[], to: S[]): boolean {
    const next = from.pop();
    if (next === undefined) return false;
    to.push(this.value);
    this.lastMerge = '';
    this.show(next);
    return true;
  }

  private show(now: S): void {
    const before = this.value;
    this.value = now;
    for (const listener of [...this.listeners]) listener(now, before);
  }
}
