// The command line's contract, word by word.
import { describe, expect, it } from 'vitest';
import { parseArguments } from '../../wasm/cli/arguments.ts';
import { helpText, options } from '../../wasm/cli/options.ts';
import { UsageError } from '../../wasm/cli/usage.ts';

const parse = (line: string): unknown => parseArguments(line.split(' ').filter((word) => word !== ''));
const plain = { kind: 'run', outputs: [], report: null, quiet: false, settings: {}, refinement: null };
const even = { intervals: 1, size: 0, ofSurface: [], gradings: [], straight: false };
const file = { kind: 'file', path: 'a.json' };
const check = { kind: 'check', mesh: 'a.vtk', domain: null, report: null, settings: {} };

describe('parseArguments', () => {
  it.each<[string, unknown]>([
    ['a.json', { ...plain, source: file }],
    ['--example square_2d', { ...plain, source: { kind: 'example', name: 'square_2d' } }],
    ['--list-examples', { kind: 'listExamples' }],
    ['--help', { kind: 'help' }],
    ['a.json --seed x --help', { kind: 'help' }],
    ['--version', { kind: 'version' }],
    ['--version --help', { kind: 'help' }],
    [
      'a.json -o b.vtk -o c.mesh --output=d.obj',
      { ...plain, source: file, outputs: ['b.vtk', 'c.mesh', 'd.obj'] },
    ],
    ['-ob.vtk a.json', { ...plain, source: file, outputs: ['b.vtk'] }],
    ['a.json --report -', { ...plain, source: file, report: '-' }],
    ['a.json --report=r.json --quiet', { ...plain, source: file, report: 'r.json', quiet: true }],
    ['a.json --quiet --quiet', { ...plain, source: file, quiet: true }],
    ['-- -odd.json', { ...plain, source: { kind: 'file', path: '-odd.json' } }],
    ['a.json --reference coarse', { ...plain, source: file, settings: { reference: 'coarse' } }],
    [
      'a.json --feature-angle 0 --time-limit 2.5',
      { ...plain, source: file, settings: { featureAngle: 0, timeLimit: 2.5 } },
    ],
    [
      'a.json --mode coarsest --extract 3 --extract 0 --no-relax',
      { ...plain, source: file, settings: { mode: 'coarsest', extract: [3, 0], relax: false } },
    ],
    ['a.json --objective shape', { ...plain, source: file, settings: { objective: 'shape' } }],
    ['a.json --objective=blocks', { ...plain, source: file, settings: { objective: 'blocks' } }],
    [
      'a.json --refine 4 --straight',
      { ...plain, source: file, refinement: { ...even, intervals: 4, straight: true } },
    ],
    ['a.json --refine 4', { ...plain, source: file, refinement: { ...even, intervals: 4 } }],
    [
      'a.json --refine 2 --refine 7=5 --refine 0=1',
      {
        ...plain,
        source: file,
        refinement: {
          ...even,
          intervals: 2,
          ofSurface: [
            { surface: 7, intervals: 5 },
            { surface: 0, intervals: 1 },
          ],
        },
      },
    ],
    [
      'a.json --size 0.25 --grade 3=1.2 --grade inlet=west=2',
      {
        ...plain,
        source: file,
        refinement: {
          ...even,
          size: 0.25,
          gradings: [
            { side: '3', growth: 1.2 },
            { side: 'inlet=west', growth: 2 },
          ],
        },
      },
    ],
    [
      'a.json --insert 3=0.25 --insert inlet=.1',
      {
        ...plain,
        source: file,
        settings: {
          insert: [
            { side: '3', share: 0.25 },
            { side: 'inlet', share: 0.1 },
          ],
        },
      },
    ],
    ['a.json --feature-angle auto', { ...plain, source: file, settings: { featureAngle: 'auto' } }],
    [
      'a.json --reference .5 --seed 4294967295 --tolerance 1e-8',
      {
        ...plain,
        source: file,
        settings: { reference: 0.5, seed: 4294967295, tolerance: 1e-8 },
      },
    ],
    ['--check a.vtk', check],
    ['a.vtk --check', check],
    ['--check a.vtk a.json --quiet', { ...check, domain: file }],
    [
      '--check a.vtk --example house --report -',
      { ...check, domain: { kind: 'example', name: 'house' }, report: '-' },
    ],
    [
      '--check a.vtk a.json --tolerance 1e-8 --feature-angle 20',
      { ...check, domain: file, settings: { tolerance: 1e-8, featureAngle: 20 } },
    ],
    ['--check a.vtk --feature-angle auto', { ...check, settings: { featureAngle: 'auto' } }],
    ['--check --help', { kind: 'help' }],
  ])('takes %j', (line, expected) => {
    expect(parse(line)).toEqual(expected);
  });

  it.each<[string, RegExp, RegExp]>([
    ['', /no input/, /name a file/],
    ['--quiet', /no input/, /--example/],
    ['a.json b.vtk', /2 inputs/, /-o/],
    ['a.json --example square_2d', /both/, /one of them/],
    ['-', /standard input/, /name a file/],
    ['a.json --refine 0', /--refine cannot be "0"/, /ID=N/],
    ['a.json --refine 2.5', /--refine cannot be "2.5"/, /ID=N/],
    ['a.json --refine 3=', /--refine cannot be "3="/, /ID=N/],
    ['a.json --refine 2 --refine 3', /--refine 2 and --refine 3/, /one N/],
    ['a.json --refine 2 --size 1', /both divide all edges/, /one of them/],
    ['a.json --size 0', /--size cannot be "0"/, /length over 0/],
    ['a.json --refine 2 --grade inlet', /--grade cannot be "inlet"/, /FACET=1.2/],
    ['a.json --refine 2 --grade 3=1', /--grade cannot be "3=1"/, /over 1/],
    ['a.json --refine 2 --grade 3=1001', /--grade cannot be "1001"/, /up to 1000/],
    ['a.json --straight', /is about elements/, /--refine N or --size H/],
    ['a.json --grade 3=1.2', /grades no element/, /--refine N, with N over 1, or --size H/],
    ['a.json --insert 3', /--insert cannot be "3"/, /FACET=0.25/],
    ['a.json --insert 3=1', /--insert cannot be "1"/, /0.000001 to 0.999999/],
    ['a.json --insert 3=1e-12', /--insert cannot be "1e-12"/, /0.000001 to 0.999999/],
    ['a.json --extract 2 --extract 2', /--extract 2 is given twice/, /once/],
    ['a.json --refine 2=3 --refine 2=4', /--refine 2=N is given twice/, /one N/],
    ['a.json --refine 2 --grade w=2 --grade w=3', /--grade w=G is given twice/, /one growth/],
    ['--check a.vtk --insert 3=.5', /--insert does not go with --check/, /leave it out/],
    ['--check a.vtk --refine 2', /--refine does not go with --check/, /leave it out/],
    ['a.json --toleranc 1', /no option --toleranc/, /--tolerance/],
    ['a.json --no-quiet', /no option --no-quiet/, /--help/],
    ['a.json -q', /no option -q/, /--help/],
    ['a.json --constructor', /no option --constructor/, /--help/],
    ['--help --nothing', /no option --nothing/, /--help/],
    ['a.json -o', /-o needs a value/, /--output=OUTPUT/],
    ['a.json -o --quiet', /-o needs a value.*looks like an option/, /--output=OUTPUT/],
    ['a.json --report=', /--report needs a value/, /--report=FILE/],
    ['a.json --quiet=yes', /takes no value/, /only --quiet/],
    ['a.json -o -', /standard output/, /name a file/],
    ['a.json -o b.vtk -o b.vtk', /written twice/, /name of its own/],
    ['a.json -o b.vtk -o ./b.vtk', /written twice/, /name of its own/],
    ['a.json -o c.vtk -o ./a.json', /".\/a.json" would replace the domain/, /name of its own/],
    ['x/../a.json --report a.json', /"a.json" would replace the domain/, /name of its own/],
    ['a.json -o b.json --report b.json', /written twice/, /name of its own/],
    ['a.json --seed 1 --seed 2', /--seed is given twice/, /once/],
    ['--list-examples a.json', /nothing else/, /only/],
    ['--list-examples --quiet', /nothing else/, /only/],
    ['a.json --seed 1.5', /--seed cannot be "1.5"/, /whole number/],
    ['a.json --seed=-1', /--seed cannot be "-1"/, /whole number/],
    ['a.json --seed 4294967296', /--seed cannot be/, /4294967295/],
    ['a.json --reference fine', /--reference cannot be "fine"/, /coarse/],
    ['a.json --reference 0', /--reference cannot be "0"/, /over 0/],
    ['a.json --reference 1e999', /--reference cannot be/, /over 0/],
    ['a.json --reference 0x10', /--reference cannot be/, /over 0/],
    ['a.json --tolerance 1', /--tolerance cannot be/, /under 1/],
    ['a.json --feature-angle 181', /--feature-angle cannot be/, /180/],
    ['a.json --feature-angle round', /--feature-angle cannot be/, /auto/],
    ['a.json --time-limit 0', /--time-limit cannot be/, /over 0/],
    ['a.json --mode fine', /--mode cannot be "fine"/, /layered or coarsest/],
    ['a.json --extract -1', /--extract/, /./],
    ['a.json --extract 1.5', /--extract cannot be "1.5"/, /from 0 on/],
    ['a.json --objective best', /--objective cannot be "best"/, /blocks or shape/],
    ['a.json --objective', /--objective needs a value/, /--objective=MODE/],
    ['a.json --objective shape --objective blocks', /given twice/, /once/],
    ['--check a.vtk --objective shape', /--objective does not go with --check/, /leave it out/],
    ['--check a.vtk --mode layered', /--mode does not go with --check/, /leave it out/],
    ['a.json --tolerance nan', /--tolerance cannot be/, /number/],
    ['--check', /no mesh/, /name a .vtk/],
    ['--check -', /standard input/, /name a file/],
    ['--check a.vtk b.json c.json', /2 domains.*"b.json", "c.json"/, /one mesh and one domain/],
    ['--check a.vtk b.json --example house', /both/, /one of them/],
    ['--check a.vtk -', /standard input/, /name a file/],
    ['--check a.vtk -o b.vtk', /--output does not go/, /leave it out/],
    ['--check a.vtk --seed 1', /--seed does not go/, /leave it out/],
    ['--check a.vtk --reference 1', /--reference does not go/, /leave it out/],
    ['--check a.vtk --tolerance 2', /--tolerance cannot be "2"/, /under 1/],
    ['--check a.vtk --feature-angle 181', /--feature-angle cannot be "181"/, /0 to 180/],
    ['--check ./a.vtk b.json --report a.vtk', /report would replace "a.vtk"/, /name of its own/],
    ['--check a.vtk b.json --report b.json', /report would replace "b.json"/, /name of its own/],
    ['--check=yes a.vtk', /takes no value/, /only --check/],
    ['--chek a.vtk', /no option --chek/, /--check/],
  ])('refuses %j', (line, message, remedy) => {
    let error: unknown;
    try {
      parse(line);
    } catch (caught) {
      error = caught;
    }
    expect(error).toBeInstanceOf(UsageError);
    const { message: text, remedy: advice, exitStatus } = error as UsageError;
    expect(text).toMatch(message);
    expect(advice).toMatch(remedy);
    expect(exitStatus).toBe(2);
  });
});

describe('helpText', () => {
  it('names every option on lines that fit a terminal', () => {
    for (const name of Object.keys(options)) expect(helpText()).toContain(`--${name}`);
    for (const line of helpText().split('\n')) expect(line.length).toBeLessThanOrEqual(110);
  });
});
