// Drawing one view. Opaque layers go straight to the canvas; where some are transparent, they are summed up without an
// order (weighted blended transparency) and laid over the opaque ones; ambient occlusion is added on demand.
import {
  AddEquation,
  Color,
  CustomBlending,
  DepthTexture,
  GLSL3,
  HalfFloatType,
  Mesh,
  NearestFilter,
  NoBlending,
  NormalBlending,
  OneFactor,
  OrthographicCamera,
  type PerspectiveCamera,
  PlaneGeometry,
  RGBAFormat,
  Scene,
  ShaderMaterial,
  UnsignedIntType,
  Vector2,
  type WebGLRenderer,
  WebGLRenderTarget,
} from 'three';
import type { ModelScene } from './model-scene.ts';
import type { Occlusion } from './occlusion.ts';
import { drawMode, globals } from './shaders.ts';

interface Area {
  x: number;
  y: number;
  width: number;
  height: number;
}

interface Looks {
  occlusion: boolean;
  /** Of a ball around the domain. */
  radius: number;
  invalidate: () => void;
}

const fullScreen = /* glsl */ `
void main() { gl_Position = vec4(position.xy, 0., 1.); }
`;
const composing = /* glsl */ `
precision highp float;
uniform sampler2D base;
uniform sampler2D sum;
uniform sampler2D veil;
uniform vec2 corner;
layout(location = 0) out vec4 colour;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy - corner);
  vec4 under = texelFetch(base, at, 0);
  vec4 s = texelFetch(sum, at, 0);
  float through = exp(-texelFetch(veil, at, 0).r);
  vec3 over = s.a > 1e-5 ? s.rgb / s.a : vec3(0.);
  colour = vec4(mix(over, under.rgb, through), 1. - (1. - under.a) * through);
}
`;

export class Blender {
  private base: WebGLRenderTarget | null = null;
  private sums: WebGLRenderTarget | null = null;
  private occlusion: Occlusion | null = null;
  private loading = false;
  private readonly kept = new Color();
  private readonly screen = new Scene();
  private readonly screenCamera = new OrthographicCamera(-1, 1, 1, -1, 0, 1);
  private readonly compose = new ShaderMaterial({
    glslVersion: GLSL3,
    vertexShader: fullScreen,
    fragmentShader: composing,
    uniforms: {
      base: { value: null },
      sum: { value: null },
      veil: { value: null },
      corner: { value: new Vector2() },
    },
    depthTest: false,
    depthWrite: false,
    blending: NoBlending,
  });

  constructor() {
    const quad = new Mesh(new PlaneGeometry(2, 2), this.compose);
    quad.frustumCulled = false;
    this.screen.add(quad);
  }

  /** `area` in CSS pixels from the canvas's lower left corner. The canvas has been cleared. */
  draw(
    renderer: WebGLRenderer,
    scene: Scene,
    camera: PerspectiveCamera | OrthographicCamera,
    model: ModelScene,
    area: Area,
    looks: Looks,
  ): void {
    const ratio = renderer.getPixelRatio();
    const layers = model.visible();
    const glass = layers.filter((l) => l.opacity < 1);
    const solid = layers.filter((l) => l.opacity >= 1);
    globals.pixelRatio.value = ratio;
    globals.viewport.value.set(area.width * ratio, area.height * ratio);
    globals.drawMode.value = drawMode.opaque;
    globals.depth.value = null;
    const occlusion = looks.occlusion ? this.wantOcclusion(looks.invalidate) : null;
    renderer.setViewport(area.x, area.y, area.width, area.height);
    renderer.setScissor(area.x, area.y, area.width, area.height);
    renderer.setScissorTest(true);
    if (glass.length === 0 && !occlusion) {
      renderer.render(scene, camera);
      return;
    }
    const width = Math.round(area.width * ratio);
    const height = Math.round(area.height * ratio);
    const { base, sums } = this.targets(width, height, renderer);
    for (const { layer } of glass) layer.object.visible = false;
    renderer.setRenderTarget(base);
    renderer.clear();
    renderer.render(scene, camera);
    const lit = occlusion ? occlusion.apply(renderer, scene, camera, base, looks.radius) : base.texture;
    for (const { layer } of glass) layer.object.visible = true;
    for (const { layer } of solid) layer.object.visible = false;

    const clear = renderer.getClearAlpha();
    renderer.setRenderTarget(sums);
    const colour = renderer.getClearColor(this.kept);
    renderer.setClearColor(0, 0);
    renderer.clear();
    globals.drawMode.value = drawMode.blend;
    globals.depth.value = base.depthTexture;
    this.blending(model, true);
    if (glass.length > 0) renderer.render(scene, camera);
    this.blending(model, false);
    globals.drawMode.value = drawMode.opaque;
    globals.depth.value = null;
    for (const { layer } of solid) layer.object.visible = true;
    renderer.setClearColor(colour, clear);

    renderer.setRenderTarget(null);
    const { uniforms } = this.compose;
    uniforms['base']!.value = lit;
    uniforms['sum']!.value = sums.textures[0];
    uniforms['veil']!.value = sums.textures[1];
    (uniforms['corner']!.value as Vector2).set(Math.round(area.x * ratio), Math.round(area.y * ratio));
    renderer.render(this.screen, this.screenCamera);
  }

  private blending(model: ModelScene, on: boolean): void {
    model.object.traverse((object) => {
      const material = (object as Mesh).material as ShaderMaterial | undefined;
      if (!material) return;
      material.depthTest = !on;
      material.depthWrite = !on;
      material.transparent = on;
      material.blending = on ? CustomBlending : NormalBlending;
      material.blendEquation = AddEquation;
      material.blendSrc = OneFactor;
      material.blendDst = OneFactor;
      material.blendSrcAlpha = OneFactor;
      material.blendDstAlpha = OneFactor;
    });
  }

  private targets(width: number, height: number, renderer: WebGLRenderer) {
    if (this.base?.width !== width || this.base.height !== height) {
      this.base?.dispose();
      this.sums?.dispose();
      const depthTexture = new DepthTexture(width, height, UnsignedIntType);
      const samples = renderer.getContextAttributes().antialias ? 4 : 0;
      this.base = new WebGLRenderTarget(width, height, { depthTexture, samples, format: RGBAFormat });
      this.sums = new WebGLRenderTarget(width, height, {
        count: 2,
        type: HalfFloatType,
        minFilter: NearestFilter,
        magFilter: NearestFilter,
        depthBuffer: false,
      });
    }
    return { base: this.base, sums: this.sums! };
  }

  private wantOcclusion(invalidate: () => void): Occlusion | null {
    if (!this.occlusion && !this.loading) {
      this.loading = true;
      void import('./occlusion.ts').then(({ Occlusion: Made }) => {
        this.occlusion = new Made();
        invalidate();
      });
    }
    return this.occlusion;
  }
}
