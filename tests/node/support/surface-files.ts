// Helpers for the tests of the surface readers: files made of pieces, and what reading them gave.
import { expect, it } from 'vitest';
import { DualblockError } from '../../../wasm/io/errors.ts';
import { readSurface, type Surface, type SurfaceFormat } from '../../../wasm/io/surface-readers.ts';

/** A file: text, or its bytes. */
export type Input = string | Uint8Array;

/** A file's bytes, text in UTF-8. */
export const bytesOf = (input: Input): Uint8Array =>
  typeof input === 'string' ? new TextEncoder().encode(input) : input;

/** Reads a file that is expected to be right. */
export const read = (format: SurfaceFormat, input: Input): Surface => readSurface(format, bytesOf(input));

/** The polygons as lists of corners. */
export const polygons = ({ polygons: { offsets, corners } }: Surface): number[][] =>
  Array.from(offsets.subarray(1), (end, i) => Array.from(corners.subarray(offsets[i], end)));

/** The error of a file, as code, entities and message; throws when the file is read. */
export function failure(format: SurfaceFormat, input: Input): { code: string; at: string; message: string } {
  try {
    read(format, input);
  } catch (error) {
    if (!(error instanceof DualblockError)) throw error;
    return {
      code: error.code,
      at: error.entities.map(({ kind, index }) => `${kind} ${index}`).join(),
      message: error.message,
    };
  }
  throw new Error('the file was read without an error');
}

/** A case of a wrong file: what is wrong, the file, the code, the entities. */
export type Wrong = [what: string, input: Input, code: string, at: string];

/** One test per wrong file: code and entities agree, the message has a remedy and is one line. */
export function refuses(format: SurfaceFormat, cases: Wrong[]): void {
  it.each(cases)('refuses %s', (_, input, code, at) => {
    const error = failure(format, input);
    expect({ code: error.code, at: error.at }).toEqual({ code, at });
    expect(error.message).toMatch(/[;:,] \S/); // a cause and a remedy
    expect(error.message).not.toContain('\n');
  });
}

/** The pieces of a file, one after another. */
export function concat(...pieces: Input[]): Uint8Array {
  return Uint8Array.from(pieces.flatMap((piece) => Array.from(bytesOf(piece))));
}

/** Floating point numbers of 4 or 8 bytes in the byte order wanted. */
export function numbers(bytes: number, little: boolean, values: number[]): Uint8Array {
  const view = new DataView(new ArrayBuffer(bytes * values.length));
  values.forEach((value, i) => {
    if (bytes === 8) view.setFloat64(8 * i, value, little);
    else view.setFloat32(4 * i, value, little);
  });
  return new Uint8Array(view.buffer);
}

/** 500 bytes that are no file of any format. */
export const garbage = Uint8Array.from({ length: 500 }, (_, i) => (i * 167 + 13) % 251);
