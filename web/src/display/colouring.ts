// Colours for cells so that neighbours differ.

/** Colours to choose from; see the palette of the scene. */
const cellColours = 12;

/**
 * Greedy colouring in order: of the colours that no neighbour has, the one used least so far. `pairs` holds each cell's
 * neighbours. Where a cell has too many neighbours, the colour least used among them.
 */
export function colourNeighbors(count: number, pairs: Map<number, Set<number>>): Uint8Array {
  const colour = new Uint8Array(count).fill(255);
  const used = new Array<number>(cellColours).fill(0);
  for (let cell = 0; cell < count; cell++) {
    const near = new Array<number>(cellColours).fill(0);
    for (const other of pairs.get(cell) ?? []) if (colour[other]! < cellColours) near[colour[other]!]!++;
    let best = 0;
    for (let c = 1; c < cellColours; c++)
      if (near[c]! < near[best]! || (near[c] === near[best] && used[c]! < used[best]!)) best = c;
    colour[cell] = best;
    used[best]!++;
  }
  return colour;
}
