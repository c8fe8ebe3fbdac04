// Numbers as bytes, by the names of their types; the formats have names of their own for them.

export interface NumberType {
  /** Bytes. */
  size: number;
  /** The number at a byte. Whole numbers beyond 2^53 are rounded. */
  at: (view: DataView, at: number, little: boolean) => number;
}

export const numberTypes = {
  int8: { size: 1, at: (view, at) => view.getInt8(at) },
  uint8: { size: 1, at: (view, at) => view.getUint8(at) },
  int16: { size: 2, at: (view, at, little) => view.getInt16(at, little) },
  uint16: { size: 2, at: (view, at, little) => view.getUint16(at, little) },
  int32: { size: 4, at: (view, at, little) => view.getInt32(at, little) },
  uint32: { size: 4, at: (view, at, little) => view.getUint32(at, little) },
  int64: { size: 8, at: (view, at, little) => Number(view.getBigInt64(at, little)) },
  uint64: { size: 8, at: (view, at, little) => Number(view.getBigUint64(at, little)) },
  float32: { size: 4, at: (view, at, little) => view.getFloat32(at, little) },
  float64: { size: 8, at: (view, at, little) => view.getFloat64(at, little) },
} as const satisfies Record<string, NumberType>;

export type NumberTypeName = keyof typeof numberTypes;
