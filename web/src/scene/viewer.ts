// The canvas: renderer, one or two views of the scene, drawn when something changes.
import {
  ColorManagement,
  LinearSRGBColorSpace,
  type Object3D,
  Scene,
  Vector3,
  Vector4,
  WebGLRenderer,
} from 'three';
import type { Camera, Entity, Step, ViewState } from '../state/view-state.ts';
import { Blender } from './blend.ts';
import { CameraRig, type Insets, type Viewport } from './camera.ts';
import { CellLayer } from './cell-layer.ts';
import { eyeOf } from './facing.ts';
import { placeSlice } from './filters.ts';
import type { MarkLayers } from './marks.ts';
import { type ModelScene, planesOf } from './model-scene.ts';
import { Motion } from './motion.ts';
import type { Theme } from './palette.ts';
import { Picker } from './picking.ts';
import { type At, listenToPointer } from './pointer.ts';
import { globals } from './shaders.ts';

ColorManagement.enabled = false; // colours are sRGB from end to end

export interface ViewerEvents {
  /** The camera was moved by hand. */
  moved(camera: Camera): void;
  hovered(entity: Entity | null, at: At): void;
  clicked(entity: Entity | null): void;
}

export class Viewer {
  readonly renderer: WebGLRenderer;
  readonly scene = new Scene();
  readonly canvas: HTMLCanvasElement;
  readonly rig: CameraRig;
  /** Objects drawn on top of the views: the slice's handle, error marks. */
  private readonly overlay = new Scene();
  private readonly blender = new Blender();
  private readonly picker = new Picker();
  private model: ModelScene | null = null;
  private state: ViewState | null = null;
  private theme: Theme | null = null;
  private requested = false;
  /** The camera as it was last told to others: it need not be placed when it comes back. */
  private told: Camera | null = null;
  private marks: MarkLayers | null = null;
  private alone = false;
  private hovers = 0;
  /** Device pixels per CSS pixel when nothing moves. */
  private pixelRatio = 1;
  private readonly eye = new Vector4();
  private readonly motion = new Motion(() => this.invalidate());

  /** Throws where there is no WebGL 2. */
  constructor(canvas: HTMLCanvasElement, events: ViewerEvents) {
    this.canvas = canvas;
    // Smooth edges cost a software renderer more than all the rest.
    this.renderer = new WebGLRenderer({ canvas, antialias: !drawsInSoftware(), alpha: true });
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.renderer.autoClear = false;
    const hovered = (at: At | null): void => {
      const turn = ++this.hovers;
      if (!at) events.hovered(null, { x: 0, y: 0 });
      else
        void this.pick(at).then((entity) => {
          if (turn === this.hovers) events.hovered(entity, at);
        });
    };
    this.rig = new CameraRig(canvas, () => {
      this.rig.aimAtAll();
      this.motion.moved(Math.max(0, ...(this.model?.visible() ?? []).map(({ layer }) => layer.count)));
      this.invalidate();
      hovered(null); // what was under the pointer is elsewhere now
      if (this.alone) return;
      this.told = this.rig.state();
      events.moved(this.told);
    });
    listenToPointer(canvas, {
      clicked: (at, event) => {
        if (!this.rig.clickGizmo(event)) void this.pick(at).then((entity) => events.clicked(entity));
      },
      hovered,
    });
  }

  /** Shows a model (null: nothing) in a state. */
  show(model: ModelScene | null, state: ViewState, theme: Theme): void {
    const before = this.state;
    const moved =
      (state.camera !== before?.camera && (state.camera === null || state.camera !== this.told)) ||
      state.projection !== before?.projection ||
      (state.compare === null) !== (before?.compare === null);
    const other = model !== this.model;
    if (other) {
      if (this.model) this.scene.remove(this.model.object);
      this.model = model;
      if (model) this.scene.add(model.object);
    }
    this.state = state;
    this.rig.views = state.compare ? 2 : 1;
    this.rig.explode = state.explode ?? 0.4;
    if (theme !== this.theme) {
      this.theme = theme;
      globals.ink.value.fromArray(theme.ink.map((c) => c / 255));
      globals.paper.value.fromArray(theme.paper.map((c) => c / 255));
      globals.accent.value.fromArray(theme.accent.map((c) => c / 255));
    }
    if (moved || other) this.place();
    this.invalidate();
  }

  setInsets(insets: Insets): void {
    this.rig.insets = insets;
    this.replace();
  }

  resize(width: number, height: number, pixelRatio: number): void {
    this.rig.size = { width, height };
    this.pixelRatio = pixelRatio;
    this.setPixels(pixelRatio);
    this.replace();
  }

  /** Draws at the next frame. */
  invalidate(): void {
    if (this.requested) return;
    this.requested = true;
    requestAnimationFrame((now) => {
      this.requested = false;
      this.motion.frame(now);
      const ratio = this.pixelRatio * this.motion.share;
      if (ratio !== this.renderer.getPixelRatio()) this.setPixels(ratio);
      this.draw();
    });
  }

  /** The entity at a point of the canvas. */
  async pick({ x, y }: At): Promise<Entity | null> {
    const { model, state, rig } = this;
    if (!model || !state) return null;
    const view = this.views(state).find(
      ({ viewport: v }) => x >= v.x && x < v.x + v.width && y >= v.y && y < v.y + v.height,
    );
    if (!view) return null;
    const { viewport } = view;
    model.apply(view.state, view.step);
    rig.aim(viewport);
    this.lookAt(model);
    this.setClips(state);
    const place = { x: x - viewport.x, y: y - viewport.y, width: viewport.width, height: viewport.height };
    const found = this.picker.pick(this.renderer, this.scene, rig.camera, model, place);
    rig.aimAtAll();
    return found;
  }

  /** A picture of what is seen, `scale` times as large; with the page's background or none. */
  async picture(scale: number, transparent: boolean): Promise<Blob> {
    const { renderer } = this;
    const { width, height } = this.rig.size;
    const most = renderer.capabilities.maxTextureSize / Math.max(width, height);
    this.setPixels(Math.min(scale * this.pixelRatio, most));
    this.draw(transparent, true);
    const blob = await new Promise<Blob | null>((resolve) => this.canvas.toBlob(resolve, 'image/png'));
    this.setPixels(this.pixelRatio);
    this.draw();
    if (!blob) throw new Error('The browser could not make a picture of this size: choose a smaller one.');
    return blob;
  }

  /** Sets or removes what marks the hovered entity. */
  highlight(entity: Entity | null): void {
    let changed = false;
    for (const { id, layer } of this.model?.visible() ?? []) {
      const hover =
        entity && layer.kind === entity.kind && id !== 'crossings' ? layer.numberOf(entity.id) : -1;
      changed ||= layer.uniforms.hover.value !== hover;
      layer.uniforms.hover.value = hover;
    }
    if (changed) this.invalidate();
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

  /** Adds an object that is drawn over the views. */
  addOverlay(object: Object3D): void {
    this.overlay.add(object);
    this.invalidate();
  }

  private views(state: ViewState): { step: Step; state: ViewState; viewport: Viewport }[] {
    const { width, height } = this.rig.size;
    if (!state.compare) return [{ step: state.step, state, viewport: { x: 0, y: 0, width, height } }];
    // The blocks beside themselves: as they were placed, and relaxed.
    const placed = { ...state, scrub: { ...state.scrub, relaxation: 0 } };
    const isTwice = state.compare === 8 && state.step === 8;
    const { left, right } = this.rig.insets;
    const half = Math.round(left + (width - left - right) / 2);
    return [
      { step: state.compare, state: isTwice ? placed : state, viewport: { x: 0, y: 0, width: half, height } },
      { step: state.step, state, viewport: { x: half, y: 0, width: width - half, height } },
    ];
  }

  private draw(transparent = false, plain = false): void {
    const { renderer, state, theme, model, rig } = this;
    if (!state || !theme) return;
    const { width, height } = rig.size;
    const [r, g, b] = theme.paper;
    renderer.setClearColor((r << 16) | (g << 8) | b, transparent ? 0 : 1);
    renderer.setScissorTest(false);
    renderer.setViewport(0, 0, width, height);
    renderer.clear();
    this.setClips(state);
    if (!model) {
      globals.pixelRatio.value = renderer.getPixelRatio();
      globals.viewport.value.set(width, height).multiplyScalar(renderer.getPixelRatio());
      rig.aimAtAll();
      renderer.render(this.overlay, rig.camera);
      return;
    }
    for (const { step, state: own, viewport } of this.views(state)) {
      model.apply(own, step);
      rig.aim(viewport);
      this.lookAt(model);
      const area = { ...viewport, y: height - viewport.y - viewport.height };
      this.blender.draw(renderer, this.scene, rig.camera, model, area, {
        occlusion: state.occlusion,
        radius: model.radius,
        invalidate: () => this.invalidate(),
      });
      if (!plain) renderer.render(this.overlay, rig.camera);
    }
    rig.aimAtAll();
    if (!plain) rig.drawGizmo(renderer);
    renderer.setViewport(0, 0, width, height);
    renderer.setScissorTest(false);
  }

  private lookAt(model: ModelScene): void {
    const eye = eyeOf(this.rig.camera, this.eye);
    for (const { layer } of model.visible()) if (layer instanceof CellLayer) layer.lookFrom(eye);
  }

  private setPixels(ratio: number): void {
    const { width, height } = this.rig.size;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
  }

  /** After the free part of the canvas changed. */
  private replace(): void {
    if (this.state && !this.state.camera) this.place();
    this.rig.aimAtAll();
    this.invalidate();
  }

  /** Brings the camera to where the state wants it. */
  private place(): void {
    const { state, model, marks, rig } = this;
    if (!state || !(model || this.alone)) return;
    if (this.alone && marks) {
      const { box } = marks;
      const radius = box.getSize(new Vector3()).length() / 2 || 1;
      rig.subject = { center: box.getCenter(new Vector3()), radius, flat: box.max.z === box.min.z };
      rig.place(null, state.projection);
    } else if (model) {
      rig.subject = { center: model.center, radius: model.radius, flat: model.model.display.dimension === 2 };
      rig.place(state.camera, state.projection);
    }
  }

  private setClips({ slice }: ViewState): void {
    const { value } = globals.clips;
    for (const clip of value) clip.set(0, 0, 0, 1);
    if (!slice?.capped || !this.model) return;
    planesOf(placeSlice(slice, this.model.model.display.box)).forEach(({ normal, offset }, k) => {
      value[k]!.set(...normal, offset);
    });
  }
}

/** Whether the GPU is emulated. Throws where there is no WebGL 2. */
function drawsInSoftware(): boolean {
  const probe = document.createElement('canvas').getContext('webgl2');
  if (!probe) throw new Error('This page needs WebGL 2, which the browser does not offer here.');
  const info = probe.getExtension('WEBGL_debug_renderer_info');
  const name = String(info ? probe.getParameter(info.UNMASKED_RENDERER_WEBGL) : '');
  probe.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}
