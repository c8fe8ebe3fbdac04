// Ambient occlusion of the opaque layers, by three.js's pass; loaded when it is first asked for.
import {
  DepthTexture,
  type OrthographicCamera,
  type PerspectiveCamera,
  type Scene,
  type Texture,
  type WebGLRenderer,
  WebGLRenderTarget,
} from 'three';
import { GTAOPass } from 'three/addons/postprocessing/GTAOPass.js';

export class Occlusion {
  private pass: GTAOPass | null = null;
  private target: WebGLRenderTarget | null = null;

  /** The picture in `base`, darkened where surfaces face each other. `radius` of a ball around the domain. */
  apply(
    renderer: WebGLRenderer,
    scene: Scene,
    camera: PerspectiveCamera | OrthographicCamera,
    base: WebGLRenderTarget,
    radius: number,
  ): Texture {
    const { width, height, depthTexture } = base;
    if (!(depthTexture instanceof DepthTexture)) return base.texture;
    if (!this.pass || this.target?.width !== width || this.target.height !== height) {
      this.pass?.dispose();
      this.target?.dispose();
      this.target = new WebGLRenderTarget(width, height, { depthBuffer: false });
      this.pass = new GTAOPass(scene, camera, width, height, { depthTexture });
      this.pass.blendIntensity = 0.9;
    }
    const { pass, target } = this;
    pass.camera = camera;
    pass.gtaoMaterial.defines['PERSPECTIVE_CAMERA'] = 'isPerspectiveCamera' in camera ? 1 : 0;
    pass.gtaoMaterial.needsUpdate = true;
    pass.setGBuffer(depthTexture, undefined as never);
    pass.updateGtaoMaterial({
      radius: 0.3 * radius,
      distanceExponent: 1,
      thickness: radius,
      scale: 1.2,
      samples: 16,
    });
    pass.updatePdMaterial({ lumaPhi: 10, depthPhi: 2, normalPhi: 3, radius: 4, rings: 2, samples: 16 });
    pass.render(renderer, target, base, 0, false);
    return target.texture;
  }
}
