// Union-find over 0 .. n - 1.
export class DisjointSets {
  private readonly parent: Int32Array;

  constructor(count: number) {
    this.parent = Int32Array.from({ length: count }, (_, i) => i);
  }

  /** The lowest member of the set of `i`. */
  find(i: number): number {
    let root = i;
    while (this.parent[root] !== root) root = this.parent[root] ?? root;
    for (let k = i; k !== root; ) {
      const next = this.parent[k] ?? root;
      this.parent[k] = root;
      k = next;
    }
    return root;
  }

  unite(i: number, j: number): void {
    const [a, b] = [this.find(i), this.find(j)];
    this.parent[Math.max(a, b)] = Math.min(a, b);
  }

  /** The members of each set, in ascending order. */
  groups(): number[][] {
    const groups = new Map<number, number[]>();
    for (let i = 0; i < this.parent.length; i++) {
      const root = this.find(i);
      const group = groups.get(root);
      if (group) group.push(i);
      else groups.set(root, [i]);
    }
    return [...groups.values()];
  }

  /** How many sets there are among the members. */
  count(members: Iterable<number>): number {
    const roots = new Set<number>();
    for (const i of members) roots.add(this.find(i));
    return roots.size;
  }
}
