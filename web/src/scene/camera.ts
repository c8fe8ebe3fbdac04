// The cameras and their controls: where they stand, what they fit, and how they aim past the panels.
import { OrthographicCamera, PerspectiveCamera, Vector3, type WebGLRenderer } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { ViewHelper } from 'three/addons/helpers/ViewHelper.js';
import type { Camera, ViewState } from '../state/view-state.ts';
import { globals } from './shaders.ts';

const fieldOfView = 32; // degrees
const halfField = Math.tan((fieldOfView * Math.PI) / 360);
const defaultDirection = new Vector3(0.62, -1, 0.55).normalize();

/** A part of the canvas in CSS pixels from its upper left corner. */
export interface Viewport {
  x: number;
  y: number;
  width: number;
  height: number;
}

/** Space at the canvas's edges that panels cover, in CSS pixels. */
export interface Insets {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

/** What there is to look at: a ball around it, and whether it is flat. */
export interface Subject {
  center: Vector3;
  radius: number;
  flat: boolean;
}

export class CameraRig {
  insets: Insets = { left: 0, right: 0, top: 0, bottom: 0 };
  size = { width: 1, height: 1 };
  /** How many views share the canvas's width. */
  views = 1;
  /** How far cells are moved apart, as a share of their distance from the centre. */
  explode = 0.4;
  subject: Subject = { center: new Vector3(), radius: 1, flat: false };
  private readonly canvas: HTMLCanvasElement;
  private readonly moved: () => void;
  private readonly perspective = new PerspectiveCamera(fieldOfView, 1, 0.01, 100);
  private readonly orthographic = new OrthographicCamera(-1, 1, 1, -1, 0.01, 100);
  private controls: OrbitControls;
  private gizmo: ViewHelper;
  private placing = false;

  /** `moved` is called when the camera was moved by hand. */
  constructor(canvas: HTMLCanvasElement, moved: () => void) {
    this.canvas = canvas;
    this.moved = moved;
    for (const camera of [this.perspective, this.orthographic]) camera.up.set(0, 0, 1);
    this.controls = this.control(this.perspective);
    this.gizmo = this.makeGizmo();
  }

  get camera(): PerspectiveCamera | OrthographicCamera {
    return this.controls.object as PerspectiveCamera | OrthographicCamera;
  }

  /** As it stands. */
  state(): Camera {
    const { camera } = this;
    return {
      position: camera.position.toArray(),
      target: this.controls.target.toArray(),
      up: camera.up.toArray(),
      zoom: camera.zoom,
    };
  }

  /** From what is looked at towards the camera, of length 1. */
  direction(): Vector3 {
    return this.camera.position.clone().sub(this.controls.target).normalize();
  }

  /** The camera that shows the whole subject, from where it is now or from the default direction. */
  fitted(keepDirection: boolean): Camera {
    const { center, radius, flat } = this.subject;
    const { left, right, top, bottom } = this.insets;
    const direction = flat ? new Vector3(0, 0, 1) : keepDirection ? this.direction() : defaultDirection;
    const width = Math.max(80, this.size.width - left - right) / this.views;
    const height = Math.max(80, this.size.height - top - bottom);
    // The field of view spans the canvas's height; the subject has to fit into the part of it that is free.
    const share = Math.min(width, height) / this.size.height;
    const margin = flat ? 1.1 : 1.08 / Math.cos(Math.atan(halfField));
    const distance = (radius * margin) / (halfField * share);
    return {
      position: center.clone().addScaledVector(direction, distance).toArray(),
      target: center.toArray(),
      up: flat ? [0, 1, 0] : [0, 0, 1],
      zoom: 1,
    };
  }

  /** Goes where a state wants it; null: where the whole subject is seen. */
  place(state: Camera | null, projection: ViewState['projection']): void {
    const { flat, radius } = this.subject;
    const wanted = flat || projection === 'orthographic' ? this.orthographic : this.perspective;
    const { position, target, up, zoom } = state ?? this.fitted(false);
    this.placing = true;
    if (wanted !== this.camera || !wanted.up.equals(new Vector3(...up))) {
      wanted.up.fromArray(up);
      this.controls.dispose();
      this.controls = this.control(wanted);
      this.gizmo.dispose();
      this.gizmo = this.makeGizmo();
    }
    this.controls.enableRotate = !flat;
    this.controls.mouseButtons.LEFT = flat ? 2 : 0; // pan or rotate
    this.controls.touches.ONE = flat ? 1 : 0;
    wanted.position.fromArray(position);
    wanted.zoom = zoom;
    this.controls.target.fromArray(target);
    this.controls.minDistance = radius / 50;
    this.controls.maxDistance = 40 * radius;
    this.controls.update();
    this.placing = false;
    this.aimAtAll();
  }

  /** By keyboard: turns about what is looked at by angles in radians; in 2D it moves along instead. */
  turn(left: number, up: number): void {
    const { camera, subject } = this;
    const { target } = this.controls;
    const offset = camera.position.clone().sub(target);
    if (subject.flat) {
      const step = new Vector3(-left, up, 0).multiplyScalar(0.5 * offset.length());
      camera.position.add(step);
      target.add(step);
    } else {
      const axis = camera.up;
      const polar = offset.angleTo(axis);
      const wanted = Math.min(Math.PI - 0.01, Math.max(0.01, polar - up));
      const right = new Vector3().crossVectors(axis, offset).normalize();
      offset.applyAxisAngle(right, wanted - polar).applyAxisAngle(axis, -left);
      camera.position.copy(target).add(offset);
    }
    this.controls.update();
  }

  /** By keyboard: goes nearer (over 1) or away (under 1). */
  zoom(factor: number): void {
    const { camera, controls } = this;
    camera.position.sub(controls.target).divideScalar(factor).add(controls.target);
    controls.update();
  }

  /** Points the camera at the middle of the free part of a viewport. */
  aim({ x, width, height }: Viewport): void {
    const { camera, subject } = this;
    const { left, right, top, bottom } = this.insets;
    const innerLeft = x === 0 ? left : 0;
    const innerRight = x + width >= this.size.width ? right : 0;
    const distance = camera.position.distanceTo(this.controls.target);
    // As much depth as exploded cells need, no more: the nearer the planes, the finer the depth.
    const middle = camera.position.distanceTo(subject.center);
    const room = subject.radius * (2.2 + 2 * this.explode);
    camera.far = middle + room;
    if (camera instanceof PerspectiveCamera) {
      camera.aspect = width / height;
      camera.near = Math.max(subject.radius / 200, middle - room);
    } else {
      const half = distance * halfField;
      camera.top = half;
      camera.bottom = -half;
      camera.right = (half * width) / height;
      camera.left = -camera.right;
      camera.near = middle - room;
    }
    globals.reach.value = subject.radius;
    camera.setViewOffset(width, height, (innerRight - innerLeft) / 2, (bottom - top) / 2, width, height);
  }

  /** The same for the whole canvas: what the controls and the slice's handle go by. */
  aimAtAll(): void {
    this.aim({ x: 0, y: 0, ...this.size });
  }

  /** Whether it follows the pointer; the slice's handle takes it over meanwhile. */
  enable(on: boolean): void {
    this.controls.enabled = on;
  }

  drawGizmo(renderer: WebGLRenderer): void {
    if (this.subject.flat) return;
    this.gizmo.location.right = this.insets.right + 2;
    this.gizmo.location.top = this.insets.top + 2;
    this.gizmo.render(renderer);
  }

  /** Turns to the axis that was clicked in the gizmo; false where none was. */
  clickGizmo(event: PointerEvent): boolean {
    if (this.subject.flat || !this.gizmo.handleClick(event)) return false;
    this.gizmo.update(100); // at once: its animation knows nothing of a vertical z axis
    this.controls.update();
    this.moved();
    return true;
  }

  dispose(): void {
    this.controls.dispose();
    this.gizmo.dispose();
  }

  private control(camera: PerspectiveCamera | OrthographicCamera): OrbitControls {
    const controls = new OrbitControls(camera, this.canvas);
    controls.addEventListener('change', () => {
      if (!this.placing) this.moved();
    });
    return controls;
  }

  private makeGizmo(): ViewHelper {
    const gizmo = new ViewHelper(this.camera, this.canvas);
    gizmo.setLabels('x', 'y', 'z');
    gizmo.center = this.controls.target;
    return gizmo;
  }
}
