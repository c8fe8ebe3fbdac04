// The material of cells: faces, lines and caps.
import type { ShaderMaterial } from 'three';
import { type ShapeName, shapes } from '../display/cell-set.ts';
import { common, emission, fetching, type LayerUniforms, material, placing } from './shaders.ts';

/**
 * Outlines within faces. Every corner of a cell has coordinates that are 0 or 1: of a simplex barycentric ones, else those
 * of the unit cube, to which the opposite ones belong too. On a face one of them is constant, and an edge is where another
 * is 0.
 */
const wiring = {
  triangle: 'vec3(k == 0, k == 1, k == 2)',
  tetrahedron: 'vec4(k == 0, k == 1, k == 2, k == 3)',
  quad: 'vec3(((k + 1) & 2) >> 1, k >> 1, 0)',
  hexahedron: 'vec3(((k + 1) & 2) >> 1, (k >> 1) & 1, k >> 2)',
} satisfies Record<ShapeName, string>;
const wireDefines = (shape: ShapeName | null): string => {
  if (!shape) return '';
  const cube = shape === 'quad' || shape === 'hexahedron' ? '\n#define CUBE' : '';
  const coordinates = wiring[shape];
  return `#define WIRED${cube}
#define CORNERS ${shapes[shape].vertices}
#define CORNER ${coordinates.slice(0, 4)}
#define COORDINATES(k) ${coordinates}
`;
};

const cellVertex = /* glsl */ `${common}${fetching}${placing}
uniform float lineTint;
in float cell;
#ifdef WIRED
out CORNER corner;
#endif
out vec3 viewPoint;
#ifdef CLIPPED
out vec3 worldPoint;
#endif
flat out int id;
flat out vec4 first;
#ifndef WIRED
flat out vec4 second;
#endif
void main() {
  id = int(cell + .5);
  first = firstColour(id);
#ifndef WIRED
  second = lineTint == 0. ? secondColour(id) : vec4(0.);
#endif
  vec3 world = placed(position, id);
#ifdef CLIPPED
  worldPoint = world;
#endif
  vec4 v = modelViewMatrix * vec4(world, 1.);
  viewPoint = v.xyz;
  gl_Position = projectionMatrix * v;
#ifdef WIRED
  int k = gl_VertexID % CORNERS;
  corner = COORDINATES(k);
#endif
}
`;

const cellFragment = /* glsl */ `${common}
uniform float lineTint;
uniform float lit;
uniform bool cap; // lies on a clipping plane, and stays
in vec3 viewPoint;
#ifdef CLIPPED
in vec3 worldPoint;
#endif
flat in int id;
flat in vec4 first;
#ifndef WIRED
flat in vec4 second;
#endif
${emission}
#ifdef WIRED
uniform float wireTint;
in CORNER corner;
float least(vec3 v) { return min(min(v.x, v.y), v.z); }
float least(vec4 v) { return min(least(v.xyz), v.w); }
/** How much of the pixel is outline: nothing away from edges, and less where cells are but a few pixels large. */
float outline() {
  CORNER dx = dFdx(corner);
  CORNER dy = dFdy(corner);
  CORNER square = dx * dx + dy * dy;
  CORNER pixels = inversesqrt(max(square, 1e-12)); // per unit
#ifdef CUBE
  CORNER rest = min(corner, 1. - corner);
#else
  CORNER rest = corner;
#endif
  CORNER away = mix(rest * pixels, CORNER(1e9), lessThan(square, CORNER(1e-12)));
  return clamp(.5 + .6 * pixelRatio - least(away), 0., 1.) * min(.25 * least(pixels), 1.);
}
#endif
void main() {
#ifdef WIRED
  float line = outline() * wireTint; // before anything is discarded: its derivatives need all neighbours
#endif
#ifdef CLIPPED
  if (!cap) cutAway(worldPoint);
#endif
  vec3 rgb = first.rgb;
#ifndef WIRED
  if (second.a > .5 && lineTint == 0.) { // hatched: stripes across the screen
    float stripe = mod(gl_FragCoord.x + gl_FragCoord.y, 10. * pixelRatio) / (10. * pixelRatio);
    if (stripe < .42) rgb = second.rgb;
  }
#endif
  rgb = emphasised(rgb, floor(first.a * 255. + .5), id);
  if (lineTint > 0.) rgb = mix(rgb, ink, lineTint);
  else if (lit > 0.) {
    vec3 n = normalize(cross(dFdx(viewPoint), dFdy(viewPoint)));
    float towards = abs(n.z);
    float side = .5 + .5 * dot(n.z < 0. ? -n : n, normalize(vec3(.45, .8, .4)));
    rgb *= mix(1., .62 + .26 * towards + .2 * side, lit);
  }
#ifdef WIRED
  rgb = mix(rgb, ink, line);
#endif
  emit(min(rgb, vec3(1.)), id);
}
`;

interface CellLook {
  /** Over 0: lines, that much darker than their cell. */
  lineTint?: number;
  /** 0: colours as they are; 1: lit. */
  lit?: number;
  /** Closes what a plane cuts. */
  cap?: boolean;
  /** The shape of cells whose outlines are drawn within their faces, `wireTint` darker. */
  wired?: ShapeName | null;
  wireTint?: number;
}

export function cellMaterial(
  uniforms: LayerUniforms,
  { lineTint = 0, lit = 1, cap = false, wired = null, wireTint = 0 }: CellLook = {},
): ShaderMaterial {
  const defines = wireDefines(wired);
  const made = material(defines + cellVertex, defines + cellFragment, {
    ...uniforms,
    lineTint: { value: lineTint },
    lit: { value: lit },
    cap: { value: cap },
    wireTint: { value: wireTint },
  });
  if (lineTint === 0) {
    made.polygonOffset = true;
    // Behind lines; sections before faces in the same plane.
    made.polygonOffsetFactor = made.polygonOffsetUnits = cap ? 0.5 : 1;
  }
  return made;
}
