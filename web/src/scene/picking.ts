// Which entity is under the pointer: a few pixels around it are drawn with numbers for colours.
import {
  type OrthographicCamera,
  type PerspectiveCamera,
  RGBAFormat,
  type Scene,
  UnsignedByteType,
  type WebGLRenderer,
  WebGLRenderTarget,
} from 'three';
import type { Entity } from '../state/view-state.ts';
import type { ModelScene } from './model-scene.ts';
import { drawMode, globals } from './shaders.ts';

const reach = 3; // pixels around the pointer
const side = 2 * reach + 1;

export class Picker {
  private readonly target = new WebGLRenderTarget(side, side, { format: RGBAFormat, type: UnsignedByteType });

  /** `camera` has the view's offset set already; x, y in CSS pixels from the view's upper left corner. */
  async pick(
    renderer: WebGLRenderer,
    scene: Scene,
    camera: PerspectiveCamera | OrthographicCamera,
    model: ModelScene,
    { x, y, width, height }: { x: number; y: number; width: number; height: number },
  ): Promise<Entity | null> {
    const { offsetX, offsetY } = camera.view ?? { offsetX: 0, offsetY: 0 };
    camera.setViewOffset(width, height, offsetX + x - side / 2, offsetY + y - side / 2, side, side);
    const pickable = new Set<object>();
    for (const { id, layer, opacity } of model.visible())
      if (id !== 'wire' && id !== 'crossings' && opacity > 0.2) pickable.add(layer.object);
    const hidden = model.object.children.filter((o) => o.visible && !pickable.has(o));
    for (const object of hidden) object.visible = false;
    globals.drawMode.value = drawMode.pick;
    globals.viewport.value.set(side, side);
    globals.pixelRatio.value = 1;
    globals.depth.value = null;
    renderer.setRenderTarget(this.target);
    renderer.setClearColor(0, 0);
    renderer.clear();
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    globals.drawMode.value = drawMode.opaque;
    for (const object of hidden) object.visible = true;
    const pixels = new Uint8Array(4 * side * side);
    await renderer.readRenderTargetPixelsAsync(this.target, 0, 0, side, side, pixels);
    return nearest(model, pixels);
  }
}

function nearest(model: ModelScene, pixels: Uint8Array): Entity | null {
  let best: Entity | null = null;
  let least = Number.POSITIVE_INFINITY;
  for (let k = 0; k < side * side; k++) {
    const [number, a, b, c] = pixels.subarray(4 * k, 4 * k + 4);
    const layer = number ? model.layerOf(number) : undefined;
    if (!layer) continue;
    const distance = Math.hypot((k % side) - reach, Math.floor(k / side) - reach);
    if (distance >= least) continue;
    least = distance;
    best = { kind: layer.kind, id: layer.nameOf(a! * 65536 + b! * 256 + c! - 1) };
  }
  return best;
}
