// What is seen as binary glTF, with plain materials and colours per vertex; loaded when it is asked for.
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  type Object3D,
  Points,
} from 'three';
import { GLTFExporter } from 'three/addons/exporters/GLTFExporter.js';
import type { Plane } from '../display/cell-set.ts';
import { CellLayer } from './cell-layer.ts';
import { clip, type Pieces } from './clip.ts';
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

/** Where the points that an index names are, as shrunk and moved apart; of each the cell, one for `width` points. */
function placed(
  layer: CellLayer,
  points: Float32Array,
  cell: ArrayLike<number>,
  index: Uint32Array,
  width: number,
): Pieces {
  const { shrink, explode, origin } = layer.uniforms;
  const out = new Float32Array(3 * index.length);
  index.forEach((p, k) => {
    for (let d = 0; d < 3; d++) {
      const center = layer.centers[3 * cell[p]! + d]!;
      const from = center - origin.value.getComponent(d);
      out[3 * k + d] = center + shrink.value * (points[3 * p + d]! - center) + explode.value * from;
    }
  });
  return {
    points: out,
    of: Int32Array.from({ length: index.length / width }, (_, k) => cell[index[width * k]!]!),
  };
}

function cellObjects(layer: CellLayer, opacity: number, planes: readonly Plane[]): Object3D[] {
  const { points, cell, triangles, lines, caps } = layer.drawn();
  const out: Object3D[] = [];
  const add = (pieces: Pieces): void => {
    if (pieces.of.length === 0) return;
    const faces = geometry(pieces.points, (p) => layer.colourOf(pieces.of[Math.floor(p / 3)]!));
    faces.computeVertexNormals();
    const material = new MeshStandardMaterial({
      vertexColors: true,
      side: DoubleSide,
      roughness: 0.9,
      metalness: 0,
    });
    material.transparent = opacity < 1;
    material.opacity = opacity;
    out.push(new Mesh(faces, material));
  };
  add(clip(placed(layer, points, cell, triangles, 3), 3, planes));
  if (caps) add(placed(layer, caps.points, caps.cell, caps.index, 3));
  const edges = clip(placed(layer, points, cell, lines, 2), 2, planes);
  if (edges.of.length > 0)
    out.push(
      new LineSegments(
        geometry(edges.points, () => [30, 36, 44]),
        new MeshBasicMaterial({ vertexColors: true }),
      ),
    );
  return out;
}

function sceneObjects(scene: ModelScene, planes: readonly Plane[]): Group {
  const group = new Group();
  for (const { id, layer, opacity } of scene.visible()) {
    let objects: Object3D[] = [];
    if (layer instanceof CellLayer) objects = cellObjects(layer, opacity, planes);
    else if (layer instanceof SegmentLayer) {
      const { ends, entity } = layer.shown();
      const lines = clip({ points: ends, of: entity }, 2, planes);
      const made = geometry(lines.points, (p) => layer.colourOf(lines.of[Math.floor(p / 2)]!));
      objects = [new LineSegments(made, new MeshBasicMaterial({ vertexColors: true }))];
    } else if (layer instanceof PointLayer) {
      const { at, entity } = layer.shown();
      const points = clip({ points: at, of: entity }, 1, planes);
      const made = geometry(points.points, (p) => layer.colourOf(points.of[p]!));
      objects = [new Points(made, new MeshBasicMaterial({ vertexColors: true }))];
    }
    for (const object of objects) {
      object.name = id;
      group.add(object);
    }
  }
  group.rotation.x = -Math.PI / 2; // glTF's y points up
  return group;
}

/** `planes` cut off what is in front of them. Throws where the exporter fails. */
export async function sceneToGlb(scene: ModelScene, planes: readonly Plane[]): Promise<Blob> {
  const group = sceneObjects(scene, planes);
  group.updateMatrixWorld(true);
  const glb = await new GLTFExporter().parseAsync(group, { binary: true });
  group.traverse((object) => {
    if (object instanceof Mesh || object instanceof LineSegments || object instanceof Points)
      object.geometry.dispose();
  });
  return new Blob([glb as ArrayBuffer], { type: 'model/gltf-binary' });
}
