// What the scene's materials have in common, and those of segments and points (cells: cell-material.ts). One fragment
// ending serves them all: opaque, blended (order-independent: weighted sums, McGuire and Bavoil 2013) or as an id for picking.
import {
  DoubleSide,
  GLSL3,
  type IUniform,
  type Mesh,
  type Object3D,
  ShaderMaterial,
  type Texture,
  Vector2,
  Vector3,
  Vector4,
} from 'three';

export const drawMode = { opaque: 0, blend: 1, pick: 2 } as const;

/** Texels per row of the textures that hold a value per entity. */
export const rowWidth = 1024;

/** Uniforms that all materials share: set once per pass. */
export const globals = {
  drawMode: { value: 0 } as IUniform<number>,
  viewport: { value: new Vector2(1, 1) },
  pixelRatio: { value: 1 },
  depth: { value: null as Texture | null },
  /** Fragments with dot(clip.xyz, p) > clip.w are cut away; two planes make a slab. */
  clips: { value: [new Vector4(0, 0, 0, 1), new Vector4(0, 0, 0, 1)] },
  ink: { value: new Vector3(0.1, 0.12, 0.15) },
  paper: { value: new Vector3(1, 1, 1) },
  accent: { value: new Vector3(1, 0.6, 0) },
  /** Radius of what is shown: biases in depth are shares of it. */
  reach: { value: 1 },
};

/** Uniforms of one layer. */
export interface LayerUniforms {
  colours: IUniform<Texture | null>;
  centers: IUniform<Texture | null>;
  opacity: IUniform<number>;
  layer: IUniform<number>;
  hover: IUniform<number>;
  shrink: IUniform<number>;
  explode: IUniform<number>;
  origin: IUniform<Vector3>;
  dimmed: IUniform<number>;
  /** 1: lines are drawn in ink, whatever their colour: on filled cells. */
  inked: IUniform<number>;
  [name: string]: IUniform;
}

export const layerUniforms = (layer: number): LayerUniforms => ({
  colours: { value: null },
  centers: { value: null },
  opacity: { value: 1 },
  layer: { value: layer },
  hover: { value: -1 },
  shrink: { value: 1 },
  explode: { value: 0 },
  origin: { value: new Vector3() },
  dimmed: { value: 0 },
  inked: { value: 0 },
});

export const common = /* glsl */ `
precision highp float;
precision highp int;
uniform int drawMode;
uniform vec2 viewport;
uniform float pixelRatio;
uniform vec3 ink;
uniform vec3 paper;
uniform vec3 accent;
uniform float reach;
uniform float opacity;
uniform int layer;
uniform int hover;
uniform float dimmed;
`;

export const fetching = /* glsl */ `
uniform highp sampler2D colours;
ivec2 texelOf(int k) { return ivec2(k % ${rowWidth}, k / ${rowWidth}); }
vec4 firstColour(int id) { return texelFetch(colours, texelOf(2 * id), 0); }
vec4 secondColour(int id) { return texelFetch(colours, texelOf(2 * id + 1), 0); }
`;

export const emission = /* glsl */ `
uniform highp sampler2D depth;
uniform vec4 clips[2];
layout(location = 0) out vec4 target0;
layout(location = 1) out vec4 target1;
void cutAway(vec3 p) {
#ifdef CLIPPED
  if (dot(clips[0].xyz, p) > clips[0].w || dot(clips[1].xyz, p) > clips[1].w) discard;
#endif
}
/** flag: 0 as it is, 1 counterpart of the selection, 2 selected. */
vec3 emphasised(vec3 rgb, float flag, int id) {
  if (flag > 1.5) rgb = mix(rgb, accent, .95);
  else if (flag > .5) rgb = mix(rgb, accent, .62);
  else rgb = mix(rgb, paper, .55 * dimmed);
  return id == hover ? mix(rgb, accent, .5) : rgb;
}
void emit(vec3 rgb, int id) {
  if (drawMode == ${drawMode.pick}) {
    int code = id + 1;
    target0 = vec4(float(layer) / 255., float(code / 65536) / 255., float((code / 256) % 256) / 255., float(code % 256) / 255.);
  }
#ifdef BLENDED
  else if (drawMode == ${drawMode.blend}) {
    if (gl_FragCoord.z > texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r) discard;
    float w = opacity * clamp(8. * pow(1. - gl_FragCoord.z * .9, 3.), .02, 20.);
    target0 = vec4(rgb * w, w);
    target1 = vec4(-log(max(1. - opacity, 1e-3)), 0., 0., 1.);
  }
#endif
  else {
    target0 = vec4(rgb, 1.);
  }
}
`;

export const placing = /* glsl */ `
uniform highp sampler2D centers;
uniform float shrink;
uniform float explode;
uniform vec3 origin;
vec3 placed(vec3 p, int id) {
  if (shrink == 1. && explode == 0.) return p;
  vec3 c = texelFetch(centers, texelOf(id), 0).xyz;
  return mix(c, p, shrink) + (c - origin) * explode;
}
`;

/** Depth of a point moved a little towards the eye; where it is on the screen does not change. */
const biasing = /* glsl */ `
uniform float bias;
float biasedDepth(vec3 p, float w) {
  vec4 v = modelViewMatrix * vec4(p, 1.);
  v.z += bias * reach;
  vec4 c = projectionMatrix * v;
  return c.z / max(c.w, 1e-6) * w;
}
`;

const segmentVertex = /* glsl */ `${common}${fetching}
${biasing}
in vec3 from;
in vec3 to;
in float entity;
uniform float width;
out vec2 along; // pixels from the first end, and across
flat out float span;
flat out int id;
flat out vec4 first;
flat out vec4 second;
out vec3 worldPoint;
void main() {
  id = int(entity + .5);
  first = firstColour(id);
  second = secondColour(id);
  vec4 a = projectionMatrix * modelViewMatrix * vec4(from, 1.);
  vec4 b = projectionMatrix * modelViewMatrix * vec4(to, 1.);
  if (a.w < 1e-4 && b.w < 1e-4) { gl_Position = vec4(2., 2., 2., 1.); return; }
  if (a.w < 1e-4) a = mix(b, a, (b.w - 1e-4) / (b.w - a.w));
  if (b.w < 1e-4) b = mix(a, b, (a.w - 1e-4) / (a.w - b.w));
  vec2 pa = a.xy / a.w * viewport * .5;
  vec2 pb = b.xy / b.w * viewport * .5;
  vec2 d = pb - pa;
  span = length(d);
  d = span > 1e-6 ? d / span : vec2(1., 0.);
  float emphasis = floor(first.a * 255. + .5) > 0. || id == hover ? 1.5 : 1.;
  float half_ = .5 * width * pixelRatio * emphasis;
  vec4 p = position.x < .5 ? a : b;
  vec2 offset = d * (position.x < .5 ? -half_ : half_) + vec2(-d.y, d.x) * position.y * half_;
  along = vec2(position.x < .5 ? -half_ : span + half_, position.y * half_);
  gl_Position = p;
  gl_Position.xy += offset / (viewport * .5) * p.w;
  worldPoint = position.x < .5 ? from : to;
  if (a.w > 1e-4 && b.w > 1e-4) gl_Position.z = biasedDepth(worldPoint, p.w);
}
`;

const segmentFragment = /* glsl */ `${common}
in vec2 along;
flat in float span;
flat in int id;
flat in vec4 first;
flat in vec4 second;
in vec3 worldPoint;
uniform float width;
uniform float inked;
${emission}
void main() {
  cutAway(worldPoint);
  float emphasis = floor(first.a * 255. + .5) > 0. || id == hover ? 1.5 : 1.;
  float half_ = .5 * width * pixelRatio * emphasis;
  float past = max(max(-along.x, along.x - span), 0.);
  if (past * past + along.y * along.y > half_ * half_ + .5) discard;
  if (second.a > .5) { // dashed
    float period = (4. * width) * pixelRatio;
    if (mod(along.x, period) > .62 * period) discard;
  }
  emit(emphasised(mix(first.rgb, ink, inked), floor(first.a * 255. + .5), id), id);
}
`;

const pointVertex = /* glsl */ `${common}${fetching}
${biasing}
in vec3 at;
in float entity;
uniform float size;
out vec2 corner;
flat out int id;
flat out vec4 first;
out vec3 worldPoint;
void main() {
  id = int(entity + .5);
  first = firstColour(id);
  float emphasis = floor(first.a * 255. + .5) > 0. || id == hover ? 1.35 : 1.;
  vec4 p = projectionMatrix * modelViewMatrix * vec4(at, 1.);
  corner = position.xy;
  gl_Position = p;
  gl_Position.xy += corner * .5 * size * pixelRatio * emphasis / (viewport * .5) * p.w;
  gl_Position.z = biasedDepth(at, p.w);
  worldPoint = at;
}
`;

const pointFragment = /* glsl */ `${common}
in vec2 corner;
flat in int id;
flat in vec4 first;
in vec3 worldPoint;
${emission}
void main() {
  cutAway(worldPoint);
  float r = dot(corner, corner);
  if (r > 1.) discard;
  vec3 rgb = emphasised(first.rgb, floor(first.a * 255. + .5), id);
  float z = sqrt(1. - r);
  rgb *= .72 + .34 * max(0., dot(vec3(corner, z), normalize(vec3(-.35, .6, .75))));
  if (r > .7) rgb = mix(rgb, ink, .85);
  emit(min(rgb, vec3(1.)), id);
}
`;

/**
 * Fragments are only discarded where that can happen: a shader that never does lets the depth test come first.
 * `blended`: the layer is transparent; `clipped`: planes cut it.
 */
export function setVariant(object: Object3D, blended: boolean, clipped: boolean): void {
  object.traverse((child) => {
    const { material: made } = child as Mesh;
    if (!(made instanceof ShaderMaterial)) return;
    const now = 'BLENDED' in made.defines;
    const cut = 'CLIPPED' in made.defines;
    if (now === blended && cut === clipped) return;
    made.defines = { ...(blended ? { BLENDED: '' } : {}), ...(clipped ? { CLIPPED: '' } : {}) };
    made.needsUpdate = true;
  });
}

export function material(
  vertexShader: string,
  fragmentShader: string,
  uniforms: Record<string, IUniform>,
): ShaderMaterial {
  return new ShaderMaterial({
    glslVersion: GLSL3,
    vertexShader,
    fragmentShader,
    uniforms: { ...globals, ...uniforms },
    side: DoubleSide,
  });
}

/** `width` in CSS pixels; `bias` pulls the lines in front of what they lie on. */
export const segmentMaterial = (uniforms: LayerUniforms, width: number, bias: number): ShaderMaterial =>
  material(segmentVertex, segmentFragment, { ...uniforms, width: { value: width }, bias: { value: bias } });

/** `size`: diameter in CSS pixels. */
export const pointMaterial = (uniforms: LayerUniforms, size: number, bias: number): ShaderMaterial =>
  material(pointVertex, pointFragment, { ...uniforms, size: { value: size }, bias: { value: bias } });
