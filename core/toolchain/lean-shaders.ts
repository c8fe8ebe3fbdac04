// Shaders without the spaces and remarks that are for readers: 2 kB less to load (gzip).
import type { Plugin } from 'vite';

/** Marked template literals of ours, and the strings of three.js that hold shaders. */
export const leanShaders: Plugin = {
  name: 'lean-shaders',
  enforce: 'pre', // the marks are gone later
  apply: 'build',
  transform: {
    filter: { code: /glsl|gl_FragColor/ },
    handler(code, id) {
      const marked = /three\.\w+\.js$/.test(id)
        ? /(?<=^(?:var|const) \w+(?:\$\w+)? = )".*\\n.*"(?=;$)/gm
        : /(?<=\/\* glsl \*\/ )`[^`]*`/g;
      const lean = code.replace(marked, leanText);
      return { code: lean, map: null };
    },
  },
};

/** Newlines may be escaped. Spaces that directives need stay: before a bracket, and around < and >. */
function leanText(shader: string): string {
  return shader
    .replace(/\/\*.*?\*\/|\/\/(?:(?!\\n)[^"`\n])*/g, '')
    .replace(/(?:[ \t]|\\t)*(\n|\\n)(?:\s|\\n|\\t)*/g, '$1')
    .replace(/ ?([=*?:,;{}]) ?/g, '$1')
    .replace(/\( | (?=\))/g, (space) => space.trim());
}
