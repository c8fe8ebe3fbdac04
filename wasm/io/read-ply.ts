// PLY, text and binary of either byte order. three.js's loader is not used: it drops polygons with more than four
// corners, cuts those with four, keeps no double precision for text declared as float, and takes what is missing
// or out of range without a word.
import { DualblockError } from './errors.ts';
import { type PlyBody, plyBinaryBody, plyTextBody } from './ply-body.ts';
import { isFloat, type PlyElement, type PlyHeader, readPlyHeader } from './ply-header.ts';
import type { RawSurface } from './polygon-soup.ts';
import { syntaxError } from './text-lines.ts';

/**
 * Reads PLY: element "vertex" with x, y, z of any numeric type, and element "face" with the list vertex_indices or
 * vertex_index; all else is skipped. Throws `syntax`, `versionUnknown`, `fileTruncated` or `notFinite` with the line
 * (text) or the element's index (binary).
 */
export function readPly(bytes: Uint8Array): RawSurface {
  const header = readPlyHeader(bytes);
  checkElements(header);
  const body = header.encoding === 'ascii' ? plyTextBody(bytes, header) : plyBinaryBody(bytes, header);

  const coordinates: number[] = [];
  const ends: number[] = [];
  const corners: number[] = [];
  const facetLines: number[] = [];
  for (const element of header.elements) {
    if (element.name === 'vertex') {
      readVertices(element, body, coordinates);
    } else if (element.name === 'face') {
      const list = element.properties.findIndex(isCornerList);
      for (let i = 0; i < element.count; i++) {
        const values = body.read(element, i)[list] ?? [];
        for (const corner of values) corners.push(corner);
        ends.push(corners.length);
        facetLines.push(body.line());
      }
    } else {
      for (let i = 0; i < element.count; i++) body.read(element, i);
    }
  }
  body.finish();
  const raw: RawSurface = { coordinates: Float64Array.from(coordinates), ends, corners };
  return header.encoding === 'ascii' ? { ...raw, lines: facetLines } : raw;
}

const isCornerList = ({ name, listLength }: PlyElement['properties'][number]): boolean =>
  listLength !== null && (name === 'vertex_indices' || name === 'vertex_index');

function readVertices(element: PlyElement, body: PlyBody, coordinates: number[]): void {
  const columns = ['x', 'y', 'z'].map((axis) => element.properties.findIndex(({ name }) => name === axis));
  for (let i = 0; i < element.count; i++) {
    const row = body.read(element, i);
    for (const column of columns) {
      const value = row[column]?.[0] ?? Number.NaN;
      if (!Number.isFinite(value)) {
        const line = body.line();
        throw new DualblockError(
          'notFinite',
          `${line > 0 ? `line ${line}: ` : ''}vertex ${i} (counted from 0) has the coordinate ${value}; correct or remove it`,
          [...(line > 0 ? [{ kind: 'line', index: line }] : []), { kind: 'vertex', index: i }],
        );
      }
      coordinates.push(value);
    }
  }
}

/** The elements hold what a surface needs, in types that can hold it. */
function checkElements(header: PlyHeader): void {
  const vertex = header.elements.find(({ name }) => name === 'vertex');
  for (const axis of ['x', 'y', 'z']) {
    if (!vertex?.properties.some(({ name, listLength }) => name === axis && !listLength)) {
      throw syntaxError(
        header.lines,
        `the header declares no property ${axis} of an element vertex`,
        'declare it',
      );
    }
  }
  if (header.elements.some(({ name, count }) => name === 'tristrips' && count > 0)) {
    throw syntaxError(header.lines, 'the facets are triangle strips', 'save them as an element "face"');
  }
  const face = header.elements.find(({ name, count }) => name === 'face' && count > 0);
  const lists = face?.properties.filter(isCornerList) ?? [];
  if (face && (lists.length !== 1 || lists.some(({ type }) => isFloat(type)))) {
    throw syntaxError(
      header.lines,
      'the header declares no single list of whole numbers vertex_indices of the faces',
      'declare "property list uchar int vertex_indices"',
    );
  }
}
