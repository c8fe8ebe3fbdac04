// Exact arithmetic: every double is a whole number times a power of two, so sums and products of coordinates are too.

/** `value` times 2^`exponent` / `divisor`, exactly. */
export interface Exact {
  value: bigint;
  exponent: number;
  divisor: number;
}

const word = new DataView(new ArrayBuffer(8));

/** A double as an odd number (or 0) times 2^exponent. */
function decompose(x: number): { odd: number; exponent: number } {
  if (x === 0) return { odd: 0, exponent: 0 };
  word.setFloat64(0, x);
  const high = word.getUint32(0);
  const low = word.getUint32(4);
  const biased = (high >>> 20) & 0x7ff;
  const fraction = (high & 0xfffff) + (biased === 0 ? 0 : 0x100000);
  const zeros = low !== 0 ? lowestBit(low) : 32 + lowestBit(fraction);
  const magnitude = (fraction * 2 ** 32 + low) / 2 ** zeros;
  return { odd: x < 0 ? -magnitude : magnitude, exponent: Math.max(biased, 1) - 1075 + zeros };
}

const lowestBit = (bits: number): number => 31 - Math.clz32(bits & -bits);

/** Numbers as whole multiples of one power of two: number i is values[i] times 2^exponent. */
export interface ScaledNumbers {
  values: bigint[];
  exponent: number;
}

/** Exact copies of finite doubles. */
export function scale(numbers: Iterable<number>): ScaledNumbers {
  const parts = Array.from(numbers, decompose);
  let exponent = Infinity;
  for (const part of parts) if (part.odd !== 0) exponent = Math.min(exponent, part.exponent);
  if (exponent === Infinity) exponent = 0;
  const values = parts.map((part) =>
    part.odd === 0 ? 0n : BigInt(part.odd) << BigInt(part.exponent - exponent),
  );
  return { values, exponent };
}

/** a - b, for equal divisors. */
export function difference(a: Exact, b: Exact): Exact {
  const exponent = Math.min(a.exponent, b.exponent);
  const shifted = (x: Exact): bigint => x.value << BigInt(x.exponent - exponent);
  return { value: shifted(a) - shifted(b), exponent, divisor: a.divisor };
}

/** The double next to an exact number, up to a unit in the last place. */
export function toNumber({ value, exponent, divisor }: Exact): number {
  const magnitude = value < 0n ? -value : value;
  if (magnitude === 0n) return 0;
  // Keep 64 bits of the quotient.
  const shift = 64 - (magnitude.toString(2).length - BigInt(divisor).toString(2).length);
  const quotient = (shift > 0 ? magnitude << BigInt(shift) : magnitude >> BigInt(-shift)) / BigInt(divisor);
  const power = exponent - shift;
  // In two steps, as 2^power alone may be too small or too large.
  const half = Math.trunc(power / 2);
  const result = Number(quotient) * 2 ** half * 2 ** (power - half);
  return value < 0n ? -result : result;
}
