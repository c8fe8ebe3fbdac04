// What is wrong with a command line.

/** A command line that breaks the contract: the program prints message and remedy and exits with 2. */
export class UsageError extends Error {
  readonly remedy: string;
  readonly exitStatus = 2;

  /** `message` says what is wrong, `remedy` what to write instead. */
  constructor(message: string, remedy: string) {
    super(message);
    this.name = 'UsageError';
    this.remedy = remedy;
  }
}

/** The decimal number that a value spells, over 0 and under `limit`. */
export function between(name: string, value: string, limit: number, wanted: string): number {
  const number = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(value) ? Number(value) : Number.NaN;
  if (number > 0 && number < limit) return number;
  throw badValue(name, value, wanted);
}

export const badValue = (name: string, value: string, wanted: string): UsageError =>
  new UsageError(`--${name} cannot be ${quote(value)}`, `give ${wanted}`);

export const quote = (text: string): string => JSON.stringify(text);
