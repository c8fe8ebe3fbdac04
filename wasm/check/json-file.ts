// JSON files: parsing with the line of a mistake, and members with the shape that is asked for.
import { DualblockError } from '../io/errors.ts';
import { decodeText, quote, syntaxError } from '../io/text-lines.ts';

export type JsonObject = Record<string, unknown>;

/** The object that a JSON file holds. Throws `fileEmpty`, and `syntax` with the line. */
export function parseJsonObject(bytes: Uint8Array): JsonObject {
  const text = decodeText(bytes, 'JSON');
  if (text.trim() === '') {
    throw new DualblockError('fileEmpty', 'the file holds nothing; write it again', [
      { kind: 'file', index: 0 },
    ]);
  }
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch (error) {
    const position = Number(/position (\d+)/.exec((error as Error).message)?.[1] ?? text.length);
    const line = text.slice(0, position).split('\n').length;
    throw syntaxError(line, 'the text is no JSON from here on', 'get or write the whole file');
  }
  if (typeof value === 'object' && value !== null && !Array.isArray(value)) return value as JsonObject;
  throw syntaxError(1, 'the file holds no JSON object', 'check the file');
}

/** The member of an object that must be an array. Throws `syntax`; `where` names the object. */
export function arrayMember(object: JsonObject, name: string, where = 'the file'): unknown[] {
  const value = object[name];
  if (Array.isArray(value)) return value;
  throw syntaxError(1, `${where} has no array ${quote(name)}`, 'add it, or check the format');
}

/** The member of an object that must be an object. Throws `syntax`. */
export function objectMember(object: JsonObject, name: string): JsonObject {
  const value = object[name];
  if (typeof value === 'object' && value !== null && !Array.isArray(value)) return value as JsonObject;
  throw syntaxError(1, `the file has no object ${quote(name)}`, 'add it, or check the format');
}

/** An array's value that must be a finite number. Throws `syntax`, and `notFinite` for one such as 1e999. */
export function finiteNumber(value: unknown, kind: string, index: number): number {
  if (typeof value === 'number' && Number.isFinite(value)) return value;
  throw new DualblockError(
    typeof value === 'number' ? 'notFinite' : 'syntax',
    `a coordinate of ${kind} ${index} (counted from 0) is ${quote(String(value))}; write a finite number`,
    [{ kind, index }],
  );
}

/** A value that must name one of `total` nodes or vertices. Throws `indexOutOfRange`. */
export function indexBelow(
  value: unknown,
  total: number,
  kind: string,
  owner: string,
  index: number,
): number {
  if (Number.isInteger(value) && (value as number) >= 0 && (value as number) < total) return value as number;
  throw new DualblockError(
    'indexOutOfRange',
    `${owner} ${index} (counted from 0) names ${kind} ${quote(String(value))} of ${total}; correct it`,
    [{ kind: owner, index }],
  );
}
