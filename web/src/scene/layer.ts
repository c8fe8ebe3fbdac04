// What all layers of the scene have in common: entities with colours, flags and visibility.
import { DataTexture, FloatType, NearestFilter, type Object3D, RGBAFormat, UnsignedByteType } from 'three';
import type { EntityKind } from '../state/view-state.ts';
import { type LayerUniforms, layerUniforms, rowWidth } from './shaders.ts';

/** An RGB colour, 0 to 255. */
export type Rgb = readonly [number, number, number];

/** How an entity is drawn: its colour, and a second one to hatch (cells) or dash (segments) it with. */
export interface Paint {
  colour: Rgb;
  second?: Rgb;
}

export const flag = { none: 0, related: 1, selected: 2 } as const;

/** Entities of one kind: each has a colour, a flag, and is visible or not. */
export abstract class Layer {
  abstract readonly object: Object3D;
  readonly kind: EntityKind;
  readonly count: number;
  readonly uniforms: LayerUniforms;
  /** xyz per entity, for filters. */
  readonly centers: Float32Array;
  /** What the model calls each of them, where that differs. */
  names: Int32Array | null = null;
  private readonly colours: Colours;

  /** `number`: for picking, over 0. */
  constructor(kind: EntityKind, number: number, centers: Float32Array) {
    this.kind = kind;
    this.count = centers.length / 3;
    this.centers = centers;
    this.uniforms = layerUniforms(number);
    this.colours = new Colours(this.count);
    this.uniforms.colours.value = this.colours.texture;
  }

  /** Shows the entities whose byte is not 0; null for all. `gaps`: cells do not touch. */
  abstract show(mask: Uint8Array | null, gaps: boolean): void;

  paint(of: (id: number) => Paint): void {
    this.colours.paint(of);
  }

  /** A flag per entity; null for none. */
  mark(of: ((id: number) => number) | null): void {
    this.colours.mark(of);
  }

  /** The colour of an entity as it was painted. */
  colourOf(id: number): Rgb {
    return this.colours.of(id);
  }

  /** From the layer's number of an entity to the model's. */
  nameOf(id: number): number {
    return this.names?.[id] ?? id;
  }

  /** The other way round; -1 for one that is not in the layer. */
  numberOf(name: number): number {
    return this.names?.indexOf(name) ?? name;
  }

  dispose(): void {
    this.colours.texture.dispose();
  }
}

/** Two texels per entity: colour and flag, second colour and whether there is one. */
class Colours {
  readonly texture: DataTexture;
  private readonly data: Uint8Array;
  private readonly count: number;

  constructor(count: number) {
    this.count = count;
    const rows = Math.max(1, Math.ceil((2 * count) / rowWidth));
    this.data = new Uint8Array(4 * rowWidth * rows);
    this.texture = new DataTexture(this.data, rowWidth, rows, RGBAFormat, UnsignedByteType);
    this.texture.minFilter = NearestFilter;
    this.texture.magFilter = NearestFilter;
    this.texture.needsUpdate = true;
  }

  paint(of: (id: number) => Paint): void {
    for (let id = 0; id < this.count; id++) {
      const { colour, second } = of(id);
      for (let k = 0; k < 3; k++) {
        this.data[8 * id + k] = colour[k]!;
        this.data[8 * id + 4 + k] = second?.[k] ?? 0;
      }
      this.data[8 * id + 7] = second ? 255 : 0;
    }
    this.texture.needsUpdate = true;
  }

  mark(of: ((id: number) => number) | null): void {
    for (let id = 0; id < this.count; id++) this.data[8 * id + 3] = of ? of(id) : 0;
    this.texture.needsUpdate = true;
  }

  /** The colour of an entity as it was painted. */
  of(id: number): Rgb {
    return [this.data[8 * id]!, this.data[8 * id + 1]!, this.data[8 * id + 2]!];
  }
}

/** Points of xyz into texels of four. */
export function putPoints(points: Float32Array, data: Float32Array): void {
  for (let k = 0; k < points.length / 3; k++) data.set(points.subarray(3 * k, 3 * k + 3), 4 * k);
}

/** xyz per entity as a texture for shaders. */
export function pointTexture(points: Float32Array): DataTexture {
  const rows = Math.max(1, Math.ceil(points.length / 3 / rowWidth));
  const data = new Float32Array(4 * rowWidth * rows);
  putPoints(points, data);
  const texture = new DataTexture(data, rowWidth, rows, RGBAFormat, FloatType);
  texture.minFilter = NearestFilter;
  texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}
