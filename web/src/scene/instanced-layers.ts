// Segments and points: one small quad, drawn once per instance, a fixed number of pixels wide.
import {
  BufferAttribute,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  Mesh,
  type ShaderMaterial,
} from 'three';
import type { SegmentSet } from '../display/cell-set.ts';
import type { EntityKind } from '../state/view-state.ts';
import { Layer } from './layer.ts';
import { type LayerUniforms, pointMaterial, segmentMaterial } from './shaders.ts';

interface InstancedOptions {
  kind: EntityKind;
  /** Number for picking, over 0. */
  number: number;
  /** Of the entities, where it is more than the instances name. */
  count?: number;
  bias?: number;
}

abstract class InstancedLayer extends Layer {
  readonly object: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  private readonly entity: Int32Array;
  private readonly places: { name: string; data: Float32Array; width: number }[];

  constructor(
    options: InstancedOptions,
    corners: number[],
    places: { name: string; data: Float32Array; width: number }[],
    entity: Int32Array,
    centers: Float32Array,
    material: (uniforms: LayerUniforms) => ShaderMaterial,
  ) {
    super(options.kind, options.number, centers);
    this.entity = entity;
    this.places = places;
    const geometry = new InstancedBufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(Float32Array.from(corners), 3));
    geometry.setIndex([0, 1, 2, 2, 1, 3]);
    for (const { name, data, width } of places)
      geometry.setAttribute(name, new InstancedBufferAttribute(data.slice(), width));
    geometry.setAttribute('entity', new InstancedBufferAttribute(Float32Array.from(entity), 1));
    geometry.instanceCount = entity.length;
    this.object = new Mesh(geometry, material(this.uniforms));
    this.object.frustumCulled = false;
  }

  /** Visible instances move to the front. */
  show(mask: Uint8Array | null): void {
    const { geometry } = this.object;
    const ids = geometry.getAttribute('entity') as InstancedBufferAttribute;
    let n = 0;
    for (let k = 0; k < this.entity.length; k++) {
      const id = this.entity[k]!;
      if (mask && !mask[id]) continue;
      ids.array[n] = id;
      for (const { name, data, width } of this.places)
        geometry.getAttribute(name).array.set(data.subarray(width * k, width * (k + 1)), width * n);
      n++;
    }
    geometry.instanceCount = n;
    for (const name of ['entity', ...this.places.map((p) => p.name)])
      geometry.getAttribute(name).needsUpdate = true;
  }

  /** An attribute of the visible instances. */
  protected drawn(name: string, width: number): Float32Array {
    const { geometry } = this.object;
    return Float32Array.from(geometry.getAttribute(name).array).slice(0, width * geometry.instanceCount);
  }

  override dispose(): void {
    this.object.geometry.dispose();
    this.object.material.dispose();
    super.dispose();
  }
}

/** Straight lines, `width` CSS pixels wide. */
export class SegmentLayer extends InstancedLayer {
  readonly set: SegmentSet;

  constructor(set: SegmentSet, width: number, options: InstancedOptions) {
    const { ends, entity } = set;
    const count = entity.length;
    const from = new Float32Array(3 * count);
    const to = new Float32Array(3 * count);
    for (let k = 0; k < count; k++) {
      from.set(ends.subarray(6 * k, 6 * k + 3), 3 * k);
      to.set(ends.subarray(6 * k + 3, 6 * k + 6), 3 * k);
    }
    super(
      options,
      [0, -1, 0, 1, -1, 0, 0, 1, 0, 1, 1, 0],
      [
        { name: 'from', data: from, width: 3 },
        { name: 'to', data: to, width: 3 },
      ],
      entity,
      segmentCenters(set, options.count ?? 0),
      (uniforms) => segmentMaterial(uniforms, width, options.bias ?? 0.006),
    );
    this.set = set;
  }

  /** What is drawn now, for export. */
  shown(): { ends: Float32Array; entity: Int32Array } {
    const from = this.drawn('from', 3);
    const to = this.drawn('to', 3);
    const ends = new Float32Array(2 * from.length);
    for (let k = 0; k < from.length / 3; k++) {
      ends.set(from.subarray(3 * k, 3 * k + 3), 6 * k);
      ends.set(to.subarray(3 * k, 3 * k + 3), 6 * k + 3);
    }
    return { ends, entity: Int32Array.from(this.drawn('entity', 1)) };
  }
}

/** Round points, `size` CSS pixels across. */
export class PointLayer extends InstancedLayer {
  readonly points: Float32Array;

  constructor(points: Float32Array, size: number, options: InstancedOptions) {
    super(
      options,
      [-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0],
      [{ name: 'at', data: points, width: 3 }],
      Int32Array.from({ length: points.length / 3 }, (_, k) => k),
      points,
      (uniforms) => pointMaterial(uniforms, size, options.bias ?? 0.012),
    );
    this.points = points;
  }

  /** What is drawn now, for export. */
  shown(): { at: Float32Array; entity: Int32Array } {
    return { at: this.drawn('at', 3), entity: Int32Array.from(this.drawn('entity', 1)) };
  }
}

/** The mean of each entity's ends. */
function segmentCenters({ ends, entity }: SegmentSet, least: number): Float32Array {
  const count = entity.reduce((most, id) => Math.max(most, id + 1), least);
  const centers = new Float32Array(3 * count);
  const weight = new Int32Array(count);
  entity.forEach((id, k) => {
    weight[id]! += 2;
    for (let d = 0; d < 3; d++) centers[3 * id + d]! += ends[6 * k + d]! + ends[6 * k + 3 + d]!;
  });
  for (let c = 0; c < count; c++) for (let d = 0; d < 3; d++) centers[3 * c + d]! /= Math.max(1, weight[c]!);
  return centers;
}
