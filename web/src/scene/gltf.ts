// What is seen as binary glTF, with plain materials and colours per vertex; loaded when it is asked for.
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshStandardMaterial,
  type Object3D,
  Points,
  PointsMaterial,
} from 'three';
import { GLTFExporter } from 'three/addons/exporters/GLTFExporter.js';
import { CellLayer } from './cell-layer.ts';
import { PointLayer, SegmentLayer } from './instanced-layers.ts';
import type { Rgb } from './layer.ts';
import type { ModelScene } from './model-scene.ts';

/** glTF's colours are linear; ours are sRGB. */
const linear = (c: number): number => ((c / 255 + 0.055) / 1.055) ** 2.4;

function geometry(points: Float32Array, colourOf: (point: number) => Rgb): BufferGeometry {
  const made = new BufferGeometry();
  made.setAttribute('position', new BufferAttribute(points, 3));
  const colours = new Float32Array(points.length);
  for (let p = 0; p < points.length / 3; p++) colours.set(colourOf(p).map(linear), 3 * p);
  made.setAttribute('color', new BufferAttribute(colours, 3));
  return made;
}

/** The points that an index uses, renumbered: nothing that is hidden goes out. */
function compact(
  points: Float32Array,
  index: Uint32Array,
): { points: Float32Array; index: Uint32Array; from: number[] } {
  const number = new Map<number, number>();
  const from: number[] = [];
  const out = index.map((p) => {
    let k = number.get(p);
    if (k === undefined) {
      k = from.push(p) - 1;
      number.set(p, k);
    }
    return k;
  });
  const kept = new Float32Array(3 * from.length);
  from.forEach((p, k) => {
    kept.set(points.subarray(3 * p, 3 * p + 3), 3 * k);
  });
  return { points: kept, index: out, from };
}

function cellObjects(layer: CellLayer, opacity: number): Object3D[] {
  const { points, cell, triangles, lines } = layer.drawn();
  const { shrink, explode, origin } = layer.uniforms;
  const placed = points.map((x, i) => {
    const center = layer.centers[3 * cell[Math.floor(i / 3)]! + (i % 3)]!;
    const from = origin.value.getComponent(i % 3);
    return center + shrink.value * (x - center) + explode.value * (center - from);
  });
  const out: Object3D[] = [];
  if (triangles.length > 0) {
    const used = compact(placed, triangles);
    const faces = geometry(used.points, (p) => layer.colourOf(cell[used.from[p]!]!));
    faces.setIndex(new BufferAttribute(used.index, 1));
    const flat = faces.toNonIndexed();
    flat.computeVertexNormals();
    const material = new MeshStandardMaterial({
      vertexColors: true,
      side: DoubleSide,
      roughness: 0.9,
      metalness: 0,
    });
    material.transparent = opacity < 1;
    material.opacity = opacity;
    out.push(new Mesh(flat, material));
  }
  if (lines.length > 0) {
    const used = compact(placed, lines);
    const edges = geometry(used.points, () => [30, 36, 44]);
    edges.setIndex(new BufferAttribute(used.index, 1));
    out.push(new LineSegments(edges, new LineBasicMaterial({ vertexColors: true })));
  }
  return out;
}

function sceneObjects(scene: ModelScene): Group {
  const group = new Group();
  for (const { id, layer, opacity } of scene.visible()) {
    let objects: Object3D[] = [];
    if (layer instanceof CellLayer) objects = cellObjects(layer, opacity);
    else if (layer instanceof SegmentLayer) {
      const { ends, entity } = layer.shown();
      const lines = geometry(ends, (p) => layer.colourOf(entity[Math.floor(p / 2)]!));
      objects = [new LineSegments(lines, new LineBasicMaterial({ vertexColors: true }))];
    } else if (layer instanceof PointLayer) {
      const { at, entity } = layer.shown();
      objects = [
        new Points(
          geometry(at, (p) => layer.colourOf(entity[p]!)),
          new PointsMaterial({ vertexColors: true }),
        ),
      ];
    }
    for (const object of objects) {
      object.name = id;
      group.add(object);
    }
  }
  group.rotation.x = -Math.PI / 2; // glTF's y points up
  return group;
}

/** Throws where the exporter fails. */
export async function sceneToGlb(scene: ModelScene): Promise<Blob> {
  const group = sceneObjects(scene);
  group.updateMatrixWorld(true);
  const glb = await new GLTFExporter().parseAsync(group, { binary: true });
  group.traverse((object) => {
    if (object instanceof Mesh || object instanceof LineSegments || object instanceof Points)
      object.geometry.dispose();
  });
  return new Blob([glb as ArrayBuffer], { type: 'model/gltf-binary' });
}
