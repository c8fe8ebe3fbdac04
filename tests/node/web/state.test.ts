// The view as a value: history, validation, links, state files, pictures.
import { deflateRawSync } from 'node:zlib';
import { PNG } from 'pngjs';
import { describe, expect, it } from 'vitest';
import { viewFromFragment, viewFromJson, viewToFragment, viewToJson } from '../../../web/src/state/codec.ts';
import { embedText, extractText } from '../../../web/src/state/png.ts';
import { Store } from '../../../web/src/state/store.ts';
import { validState } from '../../../web/src/state/validate.ts';
import {
  defaultState,
  explodeOf,
  layerSetting,
  shrinkOf,
  type ViewState,
} from '../../../web/src/state/view-state.ts';

const rich: ViewState = {
  ...defaultState,
  model: { source: 'file', name: 'a part – ü.off', hash: '00ff' },
  reference: {
    edgeLength: 0.25,
    seed: 7,
    featureAngle: 22.5,
    objective: 'shape',
    mode: 'coarsest',
    extract: [4, 0],
    insert: [{ facet: 2, share: 0.2 }],
  },
  timeLimit: 90,
  step: 6,
  compare: 3,
  scrub: { hard: 12, soft: null, relaxation: 3 },
  camera: { position: [1.5, -2, 3], target: [0, 0.25, 0], up: [0, 0, 1], zoom: 1.25 },
  projection: 'orthographic',
  layers: { 6: { cells: { opacity: 0.35 }, edges: { visible: true } } },
  solo: { 3: 'hard' },
  slice: { axis: 'view', normal: [0, 0.6, 0.8], offset: -0.125, slab: 0.5, capped: true },
  peel: 2,
  quality: [0.25, 0.75],
  hidden: [
    { kind: 'block', id: 3 },
    { kind: 'cell', id: 0 },
  ],
  isolated: { kind: 'surface', id: 4 },
  selection: { kind: 'contribution', id: 9 },
  shrink: 0.8,
  explode: 0.5,
  occlusion: true,
  theme: 'dark',
  surfaces: 'soft',
  refine: 5,
  intervals: { 3: 8 },
  gradings: { 12: 1.25 },
};

describe('the store', () => {
  const make = () => {
    let time = 0;
    const store = new Store({ a: 0, b: '' }, () => time);
    return { store, wait: (ms: number) => (time += ms) };
  };

  it('undoes and redoes step by step, and forgets what was undone when something new is done', () => {
    const { store } = make();
    store.set({ a: 1 });
    store.set({ b: 'x' });
    store.set({ a: 2 });
    expect([store.undo(), store.state]).toEqual([true, { a: 1, b: 'x' }]);
    expect([store.undo(), store.state]).toEqual([true, { a: 1, b: '' }]);
    expect([store.redo(), store.state]).toEqual([true, { a: 1, b: 'x' }]);
    store.set({ a: 5 });
    expect(store.canRedo).toBe(false);
    while (store.undo());
    expect(store.state).toEqual({ a: 0, b: '' });
    expect(store.canUndo).toBe(false);
  });

  it('merges quick changes with one key, and no others', () => {
    const { store, wait } = make();
    for (const a of [1, 2, 3]) {
      store.set({ a }, { merge: 'drag' });
      wait(100);
    }
    store.set({ a: 4 }, { merge: 'other' });
    wait(2000);
    store.set({ a: 5 }, { merge: 'other' });
    store.undo();
    expect(store.state.a).toBe(4);
    store.undo();
    expect(store.state.a).toBe(3);
    store.undo();
    expect(store.state.a).toBe(0);
  });

  it('does not merge across an undo', () => {
    const { store } = make();
    store.set({ a: 1 }, { merge: 'drag' });
    store.undo();
    store.set({ a: 2 }, { merge: 'drag' });
    store.undo();
    expect(store.state.a).toBe(0);
  });

  it('tells listeners now and before, and nothing where nothing changes', () => {
    const { store } = make();
    const seen: [number, number][] = [];
    const end = store.subscribe((now, before) => seen.push([now.a, before.a]));
    store.set({ a: 0 });
    store.set({ a: 1 });
    store.undo();
    end();
    store.set({ a: 9 });
    expect(seen).toEqual([
      [1, 0],
      [0, 1],
    ]);
  });

  it('keeps silent changes out of the history', () => {
    const { store } = make();
    store.set({ a: 1 }, { silent: true });
    expect([store.state.a, store.undo()]).toEqual([1, false]);
  });
});

describe('validation', () => {
  it('keeps a valid state as it is', () => {
    expect(validState(rich)).toEqual(rich);
    expect(validState(defaultState)).toEqual(defaultState);
    expect(validState(JSON.parse(JSON.stringify(rich)))).toEqual(rich);
  });

  it.each([[null], [undefined], [3], ['x'], [[]], [{}], [{ step: 99, model: 4, camera: {}, hidden: 'all' }]])(
    'takes defaults for %j',
    (given) => expect(validState(given)).toEqual(defaultState),
  );

  it('refuses what no view can have, member by member', () => {
    const state = validState({
      ...rich,
      model: { source: 'example', name: '../../secret' },
      reference: {
        edgeLength: -1,
        seed: 2.5,
        featureAngle: 270,
        objective: 'cheap',
        mode: 'fine',
        extract: [1, 'x', -2],
        insert: [{}, { facet: 3, share: 2 }],
      },
      timeLimit: -3,
      camera: { ...rich.camera, position: [1e300, 0, 0] },
      slice: { ...rich.slice, normal: [0, 0, 0] },
      peel: -4,
      quality: [0.9, 0.1],
      hidden: [
        { kind: 'block', id: -1 },
        { kind: 'nonsense', id: 0 },
        { kind: 'block', id: 2.5 },
        { kind: 'block', id: 1 },
      ],
      shrink: 0,
      explode: 1e9,
      refine: 4000,
      intervals: { 1: 0, x: 3, 2: 2.4 },
      gradings: { 0: 99, '-1': 2 },
      theme: 'pink',
      layers: { 6: { cells: { opacity: -3, visible: 'yes' } }, 44: {} },
    });
    expect(state).toMatchObject({
      model: defaultState.model,
      reference: {
        edgeLength: 0,
        seed: 3,
        featureAngle: 180,
        objective: 'blocks',
        mode: 'layered',
        extract: [1, 0],
        insert: [{ facet: 3, share: 0.99 }],
      },
      timeLimit: 0,
      camera: null,
      slice: null,
      peel: 0,
      quality: null,
      hidden: [{ kind: 'block', id: 1 }],
      shrink: 0.2,
      explode: 2,
      refine: 100,
      intervals: { 1: 1, 2: 2 },
      gradings: { 0: 3 },
      theme: 'auto',
      layers: { 6: { cells: { opacity: 0.05 } } },
    });
  });

  it.each<[string, object, Partial<ViewState>]>([
    [
      'no angle and no limit, as in older links',
      { reference: { edgeLength: 1, seed: 2 } },
      {
        reference: {
          edgeLength: 1,
          seed: 2,
          featureAngle: 'auto',
          objective: 'blocks',
          mode: 'layered',
          extract: [],
          insert: [],
        },
        timeLimit: 0,
      },
    ],
    [
      'an angle of 0, which is not auto',
      { reference: { featureAngle: 0 } },
      {
        reference: {
          edgeLength: 0,
          seed: 0,
          featureAngle: 0,
          objective: 'blocks',
          mode: 'layered',
          extract: [],
          insert: [],
        },
      },
    ],
    [
      'an angle and a limit in words',
      { reference: { featureAngle: '20' }, timeLimit: 'long' },
      { reference: defaultState.reference, timeLimit: 0 },
    ],
    ['a limit without end', { timeLimit: Number.POSITIVE_INFINITY }, { timeLimit: 0 }],
    ['a limit of a moment', { timeLimit: 0.25 }, { timeLimit: 0.25 }],
  ])('settings of a run: %s', (_, given, expected) => {
    expect(validState(given)).toEqual({ ...defaultState, ...expected });
  });

  it('normalises the slice’s normal', () => {
    const state = validState({ ...rich, slice: { ...rich.slice, normal: [0, 3, 4] } });
    expect(state.slice?.normal).toEqual([0, 0.6, 0.8]);
  });
});

describe('links and files', () => {
  const file = { name: 'a part – ü.off', bytes: Uint8Array.from({ length: 300 }, (_, k) => (k * 7) % 256) };

  it('restore a view and its file exactly', async () => {
    for (const view of [{ state: rich }, { state: defaultState }, { state: rich, file }]) {
      expect(viewFromJson(viewToJson(view))).toEqual(view);
      const fragment = await viewToFragment(view);
      expect(fragment).toMatch(/^v1\.[\w-]+$/);
      expect(await viewFromFragment(`#${fragment}`)).toEqual(view);
    }
  });

  it('are short where little differs from the default', async () => {
    expect((await viewToFragment({ state: { ...defaultState, step: 3 } })).length).toBeLessThan(90);
  });

  it.each([
    ['nothing', ''],
    ['an anchor', '#top'],
    ['another version', '#v9.abc'],
    ['no base64', '#v1.§§'],
    ['no deflate', '#v1.AAAA'],
    [
      'a cut link',
      `#v1.${deflateRawSync(viewToJson({ state: rich }))
        .toString('base64url')
        .slice(0, 60)}`,
    ],
    ['other JSON', `#v1.${deflateRawSync('{"format":"x"}').toString('base64url')}`],
    ['no JSON', `#v1.${deflateRawSync('nothing').toString('base64url')}`],
  ])('hold no view: %s', async (_, fragment) => {
    expect(await viewFromFragment(fragment)).toBeNull();
  });

  it('do not unpack without end', async () => {
    const bomb = deflateRawSync(Buffer.alloc(100 * 2 ** 20)).toString('base64url');
    expect(await viewFromFragment(`#v1.${bomb}`)).toBeNull();
  });

  it.each(['', '[]', '{}', 'null', '{"format":"dualblock-domain/1"}'])('are no state file: %j', (text) => {
    expect(viewFromJson(text)).toBeNull();
  });
});

describe('pictures', () => {
  const png = PNG.sync.write(new PNG({ width: 3, height: 2 }));

  it('carry a text and stay pictures', () => {
    const text = viewToJson({ state: rich });
    const carrying = embedText(png, text);
    expect(extractText(carrying)).toBe(text);
    // Another reader, which checks every chunk's sum:
    const read = PNG.sync.read(Buffer.from(carrying), { checkCRC: true });
    expect([read.width, read.height]).toEqual([3, 2]);
  });

  it('hold no text where none was put in, or where they are broken', () => {
    expect(extractText(png)).toBeNull();
    expect(extractText(new Uint8Array([1, 2, 3]))).toBeNull();
    const carrying = embedText(png, 'text');
    expect(extractText(carrying.subarray(0, carrying.length - 20))).toBeNull();
    expect(() => embedText(new Uint8Array(20), 'x')).toThrow(RangeError);
  });
});

describe('the steps’ own views', () => {
  it('show red before blue, and only what the step is about', () => {
    expect(layerSetting(defaultState, 3, 'hard', 3)).toEqual({ visible: true, opacity: 1 });
    expect(layerSetting(defaultState, 3, 'soft', 3).visible).toBe(false);
    expect(layerSetting(defaultState, 4, 'soft', 3)).toEqual({ visible: true, opacity: 1 });
    expect(layerSetting(defaultState, 4, 'hard', 2).opacity).toBe(1);
    expect(layerSetting(defaultState, 4, 'hard', 3).opacity).toBeLessThan(0.5);
    expect(explodeOf(defaultState, 6)).toBeGreaterThan(0);
    expect(explodeOf(defaultState, 8)).toBe(0);
    expect(shrinkOf({ ...defaultState, shrink: 0.5 }, 8)).toBe(0.5);
  });

  it('let a change and a solo through', () => {
    expect(layerSetting(rich, 6, 'cells', 3)).toEqual({ visible: true, opacity: 0.35 });
    expect(layerSetting(rich, 6, 'edges', 3).visible).toBe(true);
    expect(layerSetting(rich, 3, 'hard', 3).visible).toBe(true);
    expect(layerSetting(rich, 3, 'wire', 3).visible).toBe(false);
  });
});
