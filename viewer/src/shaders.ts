// Surfaces lit from the eye's upper left, denser at their rims like glass; the side of the forbidden space is darker.
export const VERTEX = `
uniform float rise, length;
varying vec3 at_normal, to_eye, paint;
varying float height;
void main() {
  vec4 seen = modelViewMatrix * vec4(position.xy, position.z * rise, 1.0);
  at_normal = normalMatrix * vec3(normal.xy, normal.z * length / rise);
  to_eye = -seen.xyz;
  paint = color;
  height = position.z * rise;
  gl_Position = projectionMatrix * seen;
}`;
export const FRAGMENT = `
uniform float opacity, cut, dim, faded;
varying vec3 at_normal, to_eye, paint;
varying float height;
void main() {
  if (height > cut) discard;
  vec3 n = normalize(at_normal), v = normalize(to_eye);
  float facing = dot(n, v);
  bool is_free_side = facing > 0.0;
  n = is_free_side ? n : -n;
  float rim = 1.0 - abs(facing);
  float key = max(dot(n, normalize(vec3(-0.45, 0.65, 0.62))), 0.0), fill = max(dot(n, normalize(vec3(0.7, -0.2, 0.4))), 0.0);
  float shine = pow(max(dot(n, normalize(v + normalize(vec3(-0.45, 0.65, 0.62)))), 0.0), 40.0);
  vec3 base = is_free_side ? paint : mix(paint * 0.62, vec3(0.25), 0.18);
  vec3 lit = base * (0.42 + 0.62 * key + 0.16 * fill) + vec3(0.10 * shine);
  float alpha = opacity >= 1.0 ? 1.0 : mix(is_free_side ? opacity : 0.6 * opacity, 0.97, pow(rim, 2.2));
  gl_FragColor = vec4(mix(lit, vec3(dot(lit, vec3(0.3, 0.6, 0.1))), faded), alpha * (1.0 - dim) * (1.0 - faded));
  #include <colorspace_fragment>
}`;
