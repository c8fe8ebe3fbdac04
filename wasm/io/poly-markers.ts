// The boundary markers of TetGen's .poly and .smesh files. The core reads all else of them, and finds what is wrong.
import { splitLines, splitWords } from './text-lines.ts';

/**
 * The marker of each facet, 0 for none. A facet of several separate polygons counts once: what the core makes of its
 * further ones comes after all facets, and has no marker.
 */
export function polyMarkers(text: string, isSmesh: boolean): number[] {
  const lines = splitLines(text)
    .map((line) => splitWords(line.replace(/#.*/, '')).map(Number))
    .filter((words) => words.length > 0);
  let at = 0;
  const take = (): number[] => lines[at++] ?? [];
  /** A polygon's corners may go on over lines; returns what follows them on the last. */
  const afterPolygon = (): number[] => {
    let words = take();
    let missing = (words[0] ?? 0) + 1;
    while (words.length < missing && at < lines.length) {
      missing -= words.length;
      words = take();
    }
    return words.slice(missing);
  };

  const [nodes = 0] = take();
  at += nodes;
  const [facets = 0, hasMarkers = 0] = take();
  if (hasMarkers === 0) return [];
  return Array.from({ length: Math.min(facets, lines.length) }, () => {
    if (isSmesh) return afterPolygon()[0] ?? 0;
    const [polygons = 0, holes = 0, marker = 0] = take();
    // Nothing that a wrong file announces is taken at its word.
    for (let polygon = 0; polygon < polygons && at < lines.length; polygon++) afterPolygon();
    at += holes;
    return marker;
  });
}
