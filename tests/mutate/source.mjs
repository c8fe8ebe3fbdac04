// What the mutators of C++ and TypeScript share: code without comments and texts, and changes of it by insertion.

/** The code with every comment, text and regular expression blanked, each character in its place. */
export function codeOnly(text) {
  const token =
    /\/\/[^\n]*|\/\*[\s\S]*?\*\/|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])+'|`(?:\\.|[^`\\])*`|^[ \t]*#[^\n]*/gm;
  return text.replace(token, (match) => match.replace(/[^\n]/g, ' '));
}

/** Where the bracket that opens at `from` closes. */
export function closing(code, from) {
  let depth = 0;
  for (let k = from; k < code.length; k++) {
    if ('([{'.includes(code[k])) depth++;
    if (')]}'.includes(code[k]) && --depth === 0) return k;
  }
  throw new Error('a bracket is never closed');
}

/** A text that others are inserted into, each at a place of the original. */
export class Changes {
  constructor(text) {
    this.text = text;
    this.insertions = [];
  }

  insert(place, text) {
    this.insertions.push({ place, text, order: this.insertions.length });
  }

  /** Puts `before` and `after` around a piece. Pieces may hold one another: what was put first is outside. */
  wrap(begin, end, before, after) {
    this.insert(begin, before);
    this.insertions.push({ place: end, text: after, order: -this.insertions.length });
  }

  /** Leaves a piece out, in which nothing else is changed. */
  cut(begin, end) {
    this.insertions.push({ place: begin, text: '', skipTo: end, order: this.insertions.length });
  }

  result() {
    const sorted = [...this.insertions].sort((a, b) => a.place - b.place || a.order - b.order);
    let made = '';
    let from = 0;
    for (const { place, text, skipTo } of sorted) {
      made += this.text.slice(from, place) + text;
      from = skipTo ?? Math.max(from, place);
    }
    return made + this.text.slice(from);
  }
}

/** The line that a place is in: its number, from 1, and its text, with the next one where it ends within a call. */
export function lineAt(text, place) {
  const begin = text.lastIndexOf('\n', place - 1) + 1;
  const end = text.indexOf('\n', place);
  const number = text.slice(0, begin).split('\n').length;
  const line = text.slice(begin, end < 0 ? undefined : end).trim();
  if (!/[(,]$/.test(line)) return { number, line };
  return { number, line: `${line} ${text.slice(end + 1, text.indexOf('\n', end + 1)).trim()}` }; // a call's arguments
}

/**
 * The names by which reasons refer to mutants: file, kind, and the line's text, which stay when lines are moved; those
 * that are alike are counted.
 */
export function named(mutants) {
  const seen = new Map();
  return mutants.map((mutant) => {
    const name = `${mutant.file}: ${mutant.kind}: ${mutant.line}`;
    const count = (seen.get(name) ?? 0) + 1;
    seen.set(name, count);
    return { ...mutant, name: count === 1 ? name : `${name} (${count})` };
  });
}
