// What topology knows of a domain or a mesh.

export interface Shape {
  /** Euler characteristic of the whole, with its inside. */
  euler: number;
  components: number;
  /** Closed pieces of the boundary. */
  shells: number;
}

export const describeShape = ({ euler, components, shells }: Shape): string =>
  `Euler characteristic ${euler}, ${components} component(s), ${shells} boundary shell(s)`;
