// The data behind the cells of a legacy VTK file: skipped, but for the regions of cells.
import type { NumberTypeName } from './number-types.ts';
import { regionArrays } from './vtk-cells.ts';
import type { WordSource } from './word-source.ts';

/** VTK's types by their names in files. `vtkIdType` is written as int, long as on 64-bit Unix. */
const kTypes: Record<string, NumberTypeName> = {
  char: 'int8',
  signed_char: 'int8',
  unsigned_char: 'uint8',
  short: 'int16',
  unsigned_short: 'uint16',
  int: 'int32',
  unsigned_int: 'uint32',
  long: 'int64',
  unsigned_long: 'uint64',
  float: 'float32',
  double: 'float64',
  vtkidtype: 'int32',
  vtktypeint8: 'int8',
  vtktypeuint8: 'uint8',
  vtktypeint16: 'int16',
  vtktypeuint16: 'uint16',
  vtktypeint32: 'int32',
  vtktypeuint32: 'uint32',
  vtktypeint64: 'int64',
  vtktypeuint64: 'uint64',
};

/** Numbers per point or cell of the data that has none of its own to say. */
const kComponents: Record<string, number> = {
  VECTORS: 3,
  NORMALS: 3,
  TENSORS: 9,
  TENSORS6: 6,
  GLOBAL_IDS: 1,
  PEDIGREE_IDS: 1,
  EDGE_FLAGS: 1,
};

/** The type of the bytes for a name; undefined for what is none, such as a string. */
export function vtkType(name: string): NumberTypeName | undefined {
  const key = name.toLowerCase();
  return Object.hasOwn(kTypes, key) ? kTypes[key] : undefined;
}

/** Skips the lines behind METADATA, which end with an empty one. */
export function skipMetadata(words: WordSource): void {
  while (words.restOfLine().trim() !== '');
}

/**
 * Reads up to the end of the file, and keeps the cell data that may tell regions. Stops where it does not understand, which
 * it notes. Throws `fileTruncated` for data that ends too soon, and `syntax` for counts that are none.
 */
export function readVtkData(words: WordSource, notes: string[]): Map<string, Float64Array> {
  const kept = new Map<string, Float64Array>();
  let count = 0;
  let ofCells = false;
  for (let word = words.next(); word !== undefined; word = words.next()) {
    const keyword = word.toUpperCase();
    const keep = ofCells ? kept : null;
    if (keyword === 'CELL_DATA' || keyword === 'POINT_DATA') {
      ofCells = keyword === 'CELL_DATA';
      count = words.count(`the number of ${ofCells ? 'cells' : 'points'} with data`);
    } else if (keyword === 'METADATA') skipMetadata(words);
    else if (!readAttribute(words, keyword, count, keep)) {
      notes.push(`the data from ${words.place().text} on was not understood, and left out`);
      break;
    }
  }
  return kept;
}

/** False for what is not understood. */
function readAttribute(
  words: WordSource,
  keyword: string,
  count: number,
  kept: Map<string, Float64Array> | null,
): boolean {
  if (keyword === 'FIELD') return readField(words, kept);
  if (keyword === 'LOOKUP_TABLE') {
    words.need('the name of a table');
    return readValues(words, { components: 4, count: words.count('the size of a table'), type: 'uint8' });
  }
  if (keyword === 'COLOR_SCALARS') {
    words.need('the name of data');
    return readValues(words, { components: words.count('the number of colours'), count, type: 'uint8' });
  }
  if (keyword === 'SCALARS' || keyword === 'TEXTURE_COORDINATES') {
    const name = words.need('the name of data');
    if (keyword === 'SCALARS') {
      const type = vtkType(words.need('the type of data'));
      const components = words.atLineEnd() ? 1 : words.count('the number of components');
      if (words.peek()?.toUpperCase() === 'LOOKUP_TABLE') {
        words.next();
        words.need('the name of a table');
      }
      return readValues(words, { components, count, type }, name, kept);
    }
    const components = words.count('the number of components');
    return readValues(words, { components, count, type: vtkType(words.need('the type of data')) });
  }
  if (!Object.hasOwn(kComponents, keyword)) return false;
  words.need('the name of data');
  return readValues(words, {
    components: kComponents[keyword]!,
    count,
    type: vtkType(words.need('the type of data')),
  });
}

/** The arrays of a field. False where one has no numbers, which could be anything. */
export function readField(words: WordSource, kept: Map<string, Float64Array> | null = null): boolean {
  words.need('the name of a field');
  const arrays = words.count('the number of arrays of a field');
  for (let array = 0; array < arrays; array++) {
    let name = words.need('the name of an array');
    while (name.toUpperCase() === 'METADATA') {
      skipMetadata(words);
      name = words.need('the name of an array');
    }
    const components = words.count('the number of components');
    const count = words.count('the number of tuples');
    const type = vtkType(words.need('the type of an array'));
    if (!readValues(words, { components, count, type }, name, kept)) return false;
  }
  return true;
}

function readValues(
  words: WordSource,
  { components, count, type }: { components: number; count: number; type: NumberTypeName | undefined },
  name = '',
  kept: Map<string, Float64Array> | null = null,
): boolean {
  if (type === undefined) return false;
  words.beginNumbers();
  if (!kept || components !== 1 || !regionArrays.includes(name)) {
    words.skip(components * count, 'a value of an array', type);
    return true;
  }
  const values: number[] = [];
  for (let i = 0; i < count; i++) values.push(words.value('a region', type));
  kept.set(name, Float64Array.from(values));
  return true;
}
