// The README's table of what each check refuses names tests: they are there.
import { readdirSync, readFileSync } from 'node:fs';
import { expect, it } from 'vitest';

const root = new URL('../../', import.meta.url);

it('every test that the README names for a guarantee exists', () => {
  const folder = new URL('tests/native/', root);
  const known = new Set(
    readdirSync(folder).flatMap((file) => {
      const text = readFileSync(new URL(file, folder), 'utf8');
      return [...text.matchAll(/^(?:TYPED_)?TEST(?:_F|_P)?\((\w+), (\w+)\)/gm)].map(
        ([, suite, name]) => `${suite}.${name}`,
      );
    }),
  );
  const readme = readFileSync(new URL('README.md', root), 'utf8');
  const table = readme.slice(readme.indexOf('| Check | refuses | shown by |'), readme.indexOf('### Limits'));
  const named = [...table.matchAll(/`(\w+\.\w+)`/g)].map(([, name = '']) => name);
  expect(named.length).toBeGreaterThan(40);
  expect(named.filter((name) => !known.has(name))).toEqual([]);
});
