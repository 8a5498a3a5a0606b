// The checker of both views: a material whose squares are squares of the disk, moved with the disk while it is dragged.
import { Color, DoubleSide, ShaderMaterial, Vector2 } from "three";

const common = `
uniform vec2 moved;
varying vec2 disk;
varying float own;
attribute float part;
vec2 moebius(vec2 z) {
  vec2 above = z - moved, below = vec2(1.0 - dot(moved, z), moved.y * z.x - moved.x * z.y);
  return vec2(dot(above, below), above.y * below.x - above.x * below.y) / dot(below, below);
}`;

const fragment = `
uniform float squares, lit, mapped;
uniform vec3 light, dark, bare;
varying vec2 disk;
varying float own;
varying vec3 facing;
float stripes(float x) {  // of -1 and 1, smooth over a pixel
  float width = max(fwidth(x), 1e-4);
  return clamp((abs(fract(x) - 0.5) - 0.25) * 4.0 / (8.0 * width), -1.0, 1.0) * smoothstep(1.0, 0.4, width);
}
void main() {
  float checker = stripes(disk.x * squares) * stripes(disk.y * squares);
  vec3 colour = mix(bare, mix(dark, light, 0.5 + 0.5 * checker), mapped);
  if (lit >= 0.0 && abs(own - lit) < 0.5) colour = mix(colour, vec3(0.95, 0.72, 0.29), 0.6);
  float shade = 0.45 + 0.55 * abs(dot(normalize(facing), normalize(vec3(0.35, 0.45, 0.85))));
  gl_FragColor = vec4(colour * shade, 1.0);
  #include <colorspace_fragment>
}`;

/** Uniforms that both views share. */
export const shared = {
  moved: { value: new Vector2() }, lit: { value: -1 }, mapped: { value: 0 }, squares: { value: 8 },
  light: { value: new Color("#f4efe6") }, dark: { value: new Color("#3d5a9e") }, bare: { value: new Color("#b9b5aa") },
};

/** @param vertex text of main(): sets gl_Position and facing, from uv, position and normal */
const material = (vertex) =>
  new ShaderMaterial({
    uniforms: shared, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1, fragmentShader: fragment,
    vertexShader: `${common} varying vec3 facing; void main() { own = part; disk = moebius(uv); ${vertex} }`,
  });

export const onSurface = () =>
  material("facing = normalMatrix * normal; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);");
export const inDomain = () =>
  material("facing = vec3(0.35, 0.45, 0.85); gl_Position = projectionMatrix * modelViewMatrix * vec4(disk, 0.0, 1.0);");
