// Marks in magenta: what a failed check or a bad domain is to blame for; and the outline of a domain that has no mesh.
import { Box3, Group, Vector3 } from 'three';
import type { Marks } from '../model/culprits.ts';
import { PointLayer, SegmentLayer } from './instanced-layers.ts';
import type { Layer, Rgb } from './layer.ts';
import { magenta } from './palette.ts';

const grey: Rgb = [128, 138, 150];

export interface MarkLayers {
  object: Group;
  box: Box3;
  dispose(): void;
}

/** Lines and points in magenta; the outline, two points per segment, in grey. */
export function markLayers({ lines, points }: Marks, outline: number[]): MarkLayers {
  const object = new Group();
  const layers: Layer[] = [];
  const add = (layer: Layer, colour: Rgb): void => {
    layer.paint(() => ({ colour }));
    object.add(layer.object);
    layers.push(layer);
  };
  const segments = (values: number[]) => ({
    ends: Float32Array.from(values),
    entity: Int32Array.from({ length: values.length / 6 }, (_, k) => k),
  });
  if (outline.length > 0) add(new SegmentLayer(segments(outline), 1.6, { kind: 'facet', number: 250 }), grey);
  if (lines.length > 0)
    add(new SegmentLayer(segments(lines), 3.2, { kind: 'facet', number: 251, bias: 0.02 }), magenta);
  if (points.length > 0)
    add(new PointLayer(Float32Array.from(points), 15, { kind: 'vertex', number: 252, bias: 0.03 }), magenta);
  const box = new Box3();
  const all = [...outline, ...lines, ...points];
  for (let k = 0; k < all.length; k += 3) box.expandByPoint(new Vector3(all[k], all[k + 1], all[k + 2]));
  return {
    object,
    box,
    dispose: () => {
      for (const layer of layers) layer.dispose();
    },
  };
}
