// The slice plane's handle: an arrow to drag along the normal, and the plane's outline in the domain's box.
import {
  BufferGeometry,
  Float32BufferAttribute,
  Group,
  LineBasicMaterial,
  LineLoop,
  Object3D,
  Quaternion,
  Vector3,
} from 'three';
import { TransformControls } from 'three/addons/controls/TransformControls.js';
import type { Slice } from '../state/view-state.ts';
import { placeSlice } from './filters.ts';
import type { ModelScene } from './model-scene.ts';
import type { Viewer } from './viewer.ts';

export class SliceHandle {
  private readonly viewer: Viewer;
  private readonly controls: TransformControls;
  private readonly anchor = new Object3D();
  private readonly outline: LineLoop<BufferGeometry, LineBasicMaterial>;
  private readonly group = new Group();
  private dragging = false;
  private frame = { center: new Vector3(), normal: new Vector3(0, 0, 1), reach: 1 };

  constructor(viewer: Viewer, moved: (offset: number) => void) {
    this.viewer = viewer;
    this.controls = new TransformControls(viewer.rig.camera, viewer.canvas);
    this.controls.setSpace('local');
    this.controls.showX = false;
    this.controls.showY = false;
    this.controls.setSize(0.7);
    this.controls.attach(this.anchor);
    const square = new BufferGeometry();
    square.setAttribute('position', new Float32BufferAttribute([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0], 3));
    this.outline = new LineLoop(square, new LineBasicMaterial({ color: 0xff9f1a }));
    this.group.add(this.anchor, this.outline);
    viewer.addOverlay(this.group);
    viewer.addOverlay(this.controls.getHelper());
    this.controls.addEventListener('change', () => viewer.invalidate());
    this.controls.addEventListener('dragging-changed', ({ value }) => {
      this.dragging = value === true;
      viewer.rig.enable(!this.dragging);
    });
    this.controls.addEventListener('objectChange', () => {
      const { center, normal, reach } = this.frame;
      const offset = this.anchor.position.clone().sub(center).dot(normal) / reach;
      moved(Math.min(1, Math.max(-1, offset)));
    });
  }

  /** Moves the handle to where the slice is; hides it where there is none. */
  place(slice: Slice | null, { center, radius, model }: ModelScene): void {
    const on = slice !== null;
    this.group.visible = on;
    this.controls.enabled = on;
    this.controls.getHelper().visible = on;
    this.controls.camera = this.viewer.rig.camera;
    if (slice) {
      const plane = placeSlice({ ...slice, slab: null }, model.display.box);
      const normal = new Vector3(...plane.normal);
      const { box } = model.display;
      const reach = [0, 1, 2].reduce(
        (sum, k) => sum + Math.abs(plane.normal[k]!) * 0.5 * (box[3 + k]! - box[k]!),
        0,
      );
      this.frame = { center, normal, reach: reach || 1 };
      const at = center.clone().addScaledVector(normal, plane.high - normal.dot(center));
      const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), normal);
      if (!this.dragging) {
        this.anchor.position.copy(at);
        this.anchor.quaternion.copy(turn);
      }
      this.outline.position.copy(at);
      this.outline.quaternion.copy(turn);
      this.outline.scale.setScalar(radius * 0.78);
    }
    this.viewer.invalidate();
  }

  /** Whether a pointer is on the handle: then nothing else is picked. */
  get active(): boolean {
    return this.dragging || this.controls.axis !== null;
  }
}
