// The canvas: renderer, cameras and controls, one or two views of the scene, drawn when something changes.
import {
  ColorManagement,
  LinearSRGBColorSpace,
  type Object3D,
  OrthographicCamera,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { ViewHelper } from 'three/addons/helpers/ViewHelper.js';
import type { Camera, Entity, Step, ViewState } from '../state/view-state.ts';
import { Blender } from './blend.ts';
import { placeSlice } from './filters.ts';
import type { MarkLayers } from './marks.ts';
import { type ModelScene, planesOf } from './model-scene.ts';
import type { Theme } from './palette.ts';
import { Picker } from './picking.ts';
import { globals } from './shaders.ts';

ColorManagement.enabled = false; // colours are sRGB from end to end

const fieldOfView = 32; // degrees
const defaultDirection = new Vector3(0.62, -1, 0.55).normalize();

interface Viewport {
  x: number;
  y: number;
  width: number;
  height: number;
}

export interface ViewerEvents {
  /** The camera was moved by hand. */
  moved(camera: Camera): void;
  hovered(entity: Entity | null, at: { x: number; y: number }): void;
  clicked(entity: Entity | null, event: PointerEvent): void;
  /** After each frame: how long it took in ms. */
  drawn?(time: number): void;
}

/** Space at the canvas's edges that panels cover, in CSS pixels. */
export interface Insets {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

export class Viewer {
  readonly renderer: WebGLRenderer;
  readonly scene = new Scene();
  /** Objects drawn on top of the views: the slice's handle, error marks. */
  readonly overlay = new Scene();
  readonly canvas: HTMLCanvasElement;
  /** Whether the GPU is emulated: then looks give way to speed. */
  readonly software: boolean;
  private controls: OrbitControls;
  private readonly perspective = new PerspectiveCamera(fieldOfView, 1, 0.01, 100);
  private readonly orthographic = new OrthographicCamera(-1, 1, 1, -1, 0.01, 100);
  private helper: ViewHelper;
  private readonly blender = new Blender();
  private readonly picker = new Picker();
  private readonly events: ViewerEvents;
  private insets: Insets = { left: 0, right: 0, top: 0, bottom: 0 };
  private model: ModelScene | null = null;
  private state: ViewState | null = null;
  private theme: Theme | null = null;
  private requested = false;
  private size = { width: 1, height: 1 };
  private following = false;
  private own: Camera | null = null;
  private marks: MarkLayers | null = null;
  private alone = false;

  constructor(canvas: HTMLCanvasElement, events: ViewerEvents) {
    this.canvas = canvas;
    this.events = events;
    const probe = document.createElement('canvas').getContext('webgl2');
    if (!probe) throw new Error('This page needs WebGL 2, which the browser does not offer here.');
    const info = probe.getExtension('WEBGL_debug_renderer_info');
    const name = String(info ? probe.getParameter(info.UNMASKED_RENDERER_WEBGL) : '');
    probe.getExtension('WEBGL_lose_context')?.loseContext();
    this.software = /swiftshader|llvmpipe|software/i.test(name);
    this.renderer = new WebGLRenderer({ canvas, antialias: !this.software, alpha: true });
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.renderer.autoClear = false;
    for (const camera of [this.perspective, this.orthographic]) camera.up.set(0, 0, 1);
    this.controls = this.makeControls(this.perspective);
    this.helper = this.makeHelper();
    this.listen();
  }

  get camera(): PerspectiveCamera | OrthographicCamera {
    return this.controls.object as PerspectiveCamera | OrthographicCamera;
  }

  /** Shows a model (null: nothing) in a state. */
  show(model: ModelScene | null, state: ViewState, theme: Theme): void {
    const moved =
      (state.camera !== this.state?.camera && (state.camera === null || state.camera !== this.own)) ||
      state.projection !== this.state?.projection ||
      (state.compare === null) !== (this.state?.compare === null);
    const first = model !== this.model;
    if (first) {
      if (this.model) this.scene.remove(this.model.object);
      this.model = model;
      if (model) this.scene.add(model.object);
    }
    this.state = state;
    if (theme !== this.theme) {
      this.theme = theme;
      globals.ink.value.fromArray(theme.ink.map((c) => c / 255));
      globals.paper.value.fromArray(theme.paper.map((c) => c / 255));
      globals.accent.value.fromArray(theme.accent.map((c) => c / 255));
    }
    if (moved || first) this.place();
    this.invalidate();
  }

  setInsets(insets: Insets): void {
    this.insets = insets;
    if (this.state && !this.state.camera) this.place();
    this.updateProjection();
    this.invalidate();
  }

  resize(width: number, height: number, pixelRatio: number): void {
    this.size = { width, height };
    this.renderer.setPixelRatio(pixelRatio);
    this.renderer.setSize(width, height, false);
    if (this.state && !this.state.camera) this.place();
    this.updateProjection();
    this.invalidate();
  }

  /** Draws at the next frame. */
  invalidate(): void {
    if (this.requested) return;
    this.requested = true;
    requestAnimationFrame(() => {
      this.requested = false;
      const start = performance.now();
      this.draw();
      this.events.drawn?.(performance.now() - start);
    });
  }

  /** The camera as it stands. */
  cameraState(): Camera {
    const { camera } = this;
    return {
      position: camera.position.toArray(),
      target: this.controls.target.toArray(),
      up: camera.up.toArray(),
      zoom: camera.zoom,
    };
  }

  /** The camera as it is told to others; it need not be placed when it comes back. */
  private emitted(): Camera {
    this.own = this.cameraState();
    return this.own;
  }

  /** From what is looked at towards the camera, of length 1. */
  direction(): [number, number, number] {
    return this.camera.position.clone().sub(this.controls.target).normalize().toArray();
  }

  /** The camera that shows the whole model, from where it is now or from the default direction. */
  fitted(keepDirection: boolean): Camera {
    const flat = this.flat;
    const { center, radius: ball } = this.bounds();
    const radius = ball * (flat ? 1 : 1.08);
    const direction = flat
      ? new Vector3(0, 0, 1)
      : keepDirection
        ? this.camera.position.clone().sub(this.controls.target).normalize()
        : defaultDirection.clone();
    const { width, height } = this.free();
    const aspect = width / height;
    const half = Math.tan((fieldOfView * Math.PI) / 360);
    // The field of view spans the canvas's height; the model has to fit into the part of it that is free.
    const share = Math.min(height, height * aspect) / this.viewHeight();
    const distance = radius / (half * share) / (flat ? 1 : Math.cos(Math.atan(half)));
    return {
      position: center.clone().addScaledVector(direction, distance).toArray(),
      target: center.toArray(),
      up: flat ? [0, 1, 0] : [0, 0, 1],
      zoom: 1,
    };
  }

  /** The entity at a point of the canvas, in CSS pixels from its upper left corner. */
  async pick(x: number, y: number): Promise<Entity | null> {
    const { model, state } = this;
    if (!model || !state) return null;
    const view = this.views(state).find(
      ({ viewport: v }) => x >= v.x && x < v.x + v.width && y >= v.y && y < v.y + v.height,
    );
    if (!view) return null;
    model.apply(state, view.step);
    this.aim(view.viewport);
    this.setClips(state);
    const found = this.picker.pick(this.renderer, this.scene, this.camera, model, {
      x: x - view.viewport.x,
      y: y - view.viewport.y,
      width: view.viewport.width,
      height: view.viewport.height,
    });
    this.camera.clearViewOffset();
    this.updateProjection();
    return found;
  }

  /** A picture of what is seen, `scale` times as large; with the page's background or none. */
  async picture(scale: number, transparent: boolean): Promise<Blob> {
    const ratio = this.renderer.getPixelRatio();
    const largest = this.renderer.capabilities.maxTextureSize;
    const fits = Math.min(scale, largest / (Math.max(this.size.width, this.size.height) * ratio));
    this.renderer.setPixelRatio(ratio * fits);
    this.renderer.setSize(this.size.width, this.size.height, false);
    this.draw(transparent, true);
    const blob = await new Promise<Blob | null>((resolve) => this.canvas.toBlob(resolve, 'image/png'));
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(this.size.width, this.size.height, false);
    this.draw();
    if (!blob) throw new Error('The browser could not make a picture of this size: choose a smaller one.');
    return blob;
  }

  /** Sets or removes what marks the hovered entity. */
  highlight(entity: Entity | null): void {
    if (!this.model) return;
    let changed = false;
    for (const { id, layer } of this.model.visible()) {
      const hover = entity && layer.kind === entity.kind && id !== 'crossings' ? entity.id : -1;
      changed ||= layer.uniforms.hover.value !== hover;
      layer.uniforms.hover.value = hover;
    }
    if (changed) this.invalidate();
  }

  dispose(): void {
    this.controls.dispose();
    this.renderer.dispose();
  }

  private get flat(): boolean {
    if (this.alone && this.marks) return this.marks.box.max.z === this.marks.box.min.z;
    return this.model?.model.display.dimension === 2;
  }

  /** A ball around what is to be seen. */
  private bounds(): { center: Vector3; radius: number } {
    const { box } = (this.alone && this.marks) || {};
    if (box) {
      const radius = box.getSize(new Vector3()).length() / 2 || 1;
      return { center: box.getCenter(new Vector3()), radius };
    }
    return { center: this.model?.center.clone() ?? new Vector3(), radius: this.model?.radius ?? 1 };
  }

  /** The part of the canvas that no panel covers. */
  private free(): { width: number; height: number } {
    const { left, right, top, bottom } = this.insets;
    const compare = this.state?.compare ? 2 : 1;
    return {
      width: Math.max(80, this.size.width - left - right) / compare,
      height: Math.max(80, this.size.height - top - bottom),
    };
  }

  private viewHeight(): number {
    return this.size.height;
  }

  private views(state: ViewState): { step: Step; viewport: Viewport }[] {
    const { width, height } = this.size;
    if (!state.compare) return [{ step: state.step, viewport: { x: 0, y: 0, width, height } }];
    const { left, right } = this.insets;
    const half = Math.round(left + (width - left - right) / 2);
    return [
      { step: state.compare, viewport: { x: 0, y: 0, width: half, height } },
      { step: state.step, viewport: { x: half, y: 0, width: width - half, height } },
    ];
  }

  private draw(transparent = false, plain = false): void {
    const { renderer, state, theme, model } = this;
    if (!state || !theme) return;
    const [r, g, b] = theme.paper;
    renderer.setClearColor((r << 16) | (g << 8) | b, transparent ? 0 : 1);
    renderer.setScissorTest(false);
    renderer.setViewport(0, 0, this.size.width, this.size.height);
    renderer.clear();
    this.setClips(state);
    if (!model) {
      this.aim({ x: 0, y: 0, width: this.size.width, height: this.size.height });
      globals.viewport.value.set(this.size.width, this.size.height).multiplyScalar(renderer.getPixelRatio());
      globals.pixelRatio.value = renderer.getPixelRatio();
      renderer.render(this.overlay, this.camera);
      return;
    }
    const views = this.views(state);
    for (const { step, viewport } of views) {
      model.apply(state, step);
      this.aim(viewport);
      const y = this.size.height - viewport.y - viewport.height;
      const area = { x: viewport.x, y, width: viewport.width, height: viewport.height };
      this.blender.draw(renderer, this.scene, this.camera, model, area, {
        occlusion: state.occlusion,
        radius: model.radius,
        invalidate: () => this.invalidate(),
      });
      if (!plain) renderer.render(this.overlay, this.camera);
    }
    this.camera.clearViewOffset();
    this.updateProjection();
    if (!plain && !this.flat) this.drawHelper();
    renderer.setViewport(0, 0, this.size.width, this.size.height);
    renderer.setScissorTest(false);
  }

  /** Points the camera at the middle of the free part of a viewport. */
  private aim(viewport: Viewport): void {
    const { camera } = this;
    const { left, right, top, bottom } = this.insets;
    const { width, height } = viewport;
    const innerLeft = viewport.x === 0 ? left : 0;
    const innerRight = viewport.x + width >= this.size.width ? right : 0;
    if (camera instanceof PerspectiveCamera) camera.aspect = width / height;
    else {
      const half = this.orthographicHalf();
      camera.top = half;
      camera.bottom = -half;
      camera.right = (half * width) / height;
      camera.left = -camera.right;
    }
    // As much depth as exploded cells need, no more: the nearer the planes, the finer the depth.
    const { radius } = this.bounds();
    const distance = camera.position.distanceTo(this.controls.target);
    const room =
      radius * (2.2 + 2 * (this.state?.explode ?? 0.4)) +
      camera.position.distanceTo(this.bounds().center) -
      distance;
    camera.far = distance + room;
    camera.near =
      camera instanceof PerspectiveCamera ? Math.max(radius / 200, distance - room) : distance - room;
    globals.reach.value = radius;
    camera.setViewOffset(width, height, (innerRight - innerLeft) / 2, (bottom - top) / 2, width, height);
  }

  private updateProjection(): void {
    this.aim({ x: 0, y: 0, width: this.size.width, height: this.size.height });
  }

  private orthographicHalf(): number {
    const { camera } = this;
    return camera.position.distanceTo(this.controls.target) * Math.tan((fieldOfView * Math.PI) / 360);
  }

  /** Brings the camera to where the state wants it. */
  private place(): void {
    const { state } = this;
    if (!state || !(this.model || this.alone)) return;
    const flat = this.flat;
    const { radius } = this.bounds();
    const wanted = flat || state.projection === 'orthographic' ? this.orthographic : this.perspective;
    const { position, target, up, zoom } = (this.alone ? null : state.camera) ?? this.fitted(false);
    this.following = true;
    if (wanted !== this.camera || !wanted.up.equals(new Vector3(...up))) {
      wanted.up.fromArray(up);
      this.controls.dispose();
      this.controls = this.makeControls(wanted);
      this.helper.dispose();
      this.helper = this.makeHelper();
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
    this.following = false;
    this.updateProjection();
  }

  private makeControls(camera: PerspectiveCamera | OrthographicCamera): OrbitControls {
    const controls = new OrbitControls(camera, this.canvas);
    controls.addEventListener('change', () => {
      if (this.following || this.alone) {
        this.invalidate();
        return;
      }
      this.updateProjection();
      this.invalidate();
      this.events.moved(this.emitted());
    });
    return controls;
  }

  private makeHelper(): ViewHelper {
    const helper = new ViewHelper(this.camera, this.canvas);
    helper.setLabels('x', 'y', 'z');
    helper.center = this.controls.target;
    return helper;
  }

  private drawHelper(): void {
    const { helper, insets } = this;
    helper.location.right = insets.right + 2;
    helper.location.top = insets.top + 2;
    helper.render(this.renderer);
  }

  private setClips({ slice }: ViewState): void {
    const [a, b] = globals.clips.value;
    a!.set(0, 0, 0, 1);
    b!.set(0, 0, 0, 1);
    if (!slice?.capped || !this.model) return;
    planesOf(placeSlice(slice, this.model.model.display.box)).forEach(({ normal, offset }, k) => {
      globals.clips.value[k]!.set(...normal, offset);
    });
  }

  private listen(): void {
    const { canvas } = this;
    let down: { x: number; y: number; id: number } | null = null;
    let pending: PointerEvent | null = null;
    const place = (event: PointerEvent): { x: number; y: number } => {
      const box = canvas.getBoundingClientRect();
      return { x: event.clientX - box.left, y: event.clientY - box.top };
    };
    canvas.addEventListener('pointerdown', (event) => {
      down = { x: event.clientX, y: event.clientY, id: event.pointerId };
    });
    canvas.addEventListener('pointerup', (event) => {
      const still =
        down?.id === event.pointerId && Math.hypot(event.clientX - down.x, event.clientY - down.y) < 5;
      down = null;
      if (!still || event.button !== 0) return;
      const { x, y } = place(event);
      if (!this.flat && this.helper.handleClick(event)) {
        this.turn();
        return;
      }
      void this.pick(x, y).then((entity) => this.events.clicked(entity, event));
    });
    canvas.addEventListener('pointermove', (event) => {
      if (event.pointerType === 'touch' || down || event.buttons) return;
      if (!pending)
        requestAnimationFrame(() => {
          const last = pending;
          pending = null;
          if (!last) return;
          const at = place(last);
          void this.pick(at.x, at.y).then((entity) => {
            if (!pending) this.events.hovered(entity, at);
          });
        });
      pending = event;
    });
    canvas.addEventListener('pointerleave', () => {
      pending = null;
      this.events.hovered(null, { x: 0, y: 0 });
    });
  }

  /** After a click on the gizmo: at once, as its animation knows nothing of a vertical z axis. */
  private turn(): void {
    this.helper.update(100);
    this.controls.update();
    this.invalidate();
    this.events.moved(this.emitted());
  }

  /** Marks that are drawn over the views; `alone`: they are all there is, and the camera turns to them. */
  showMarks(marks: MarkLayers | null, alone: boolean, step: Step): void {
    if (this.marks !== marks) {
      if (this.marks) this.overlay.remove(this.marks.object);
      this.marks = marks;
      if (marks) this.overlay.add(marks.object);
    }
    if (marks) marks.object.visible = alone || (step >= 2 && step <= 5);
    if (alone !== this.alone) {
      this.alone = alone;
      this.place();
    }
    this.invalidate();
  }

  enableControls(on: boolean): void {
    this.controls.enabled = on;
  }

  /** Adds an object that is drawn over the views. */
  addOverlay(object: Object3D): void {
    this.overlay.add(object);
    this.invalidate();
  }
}
