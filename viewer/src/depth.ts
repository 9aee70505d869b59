// Triangles from far to near, by a counting sort; or only the largest of them, while something moves.
import { BufferAttribute, DynamicDrawUsage, type Vector3 } from "three";

const LEVELS = 4096;
const FEW = 22_000; // as many cover nearly all of a surface

export class DepthOrder {
  readonly attribute: BufferAttribute;
  private readonly centres: Float32Array;
  private readonly largest: Uint32Array;

  constructor(
    readonly triangles: Uint32Array,
    position: Float32Array,
    rise: number,
  ) {
    this.attribute = new BufferAttribute(new Uint32Array(triangles), 1).setUsage(DynamicDrawUsage);
    this.centres = new Float32Array(triangles.length);
    const count = triangles.length / 3;
    const area = new Float32Array(count);
    const at = (t: number, corner: number, c: number) =>
      position[3 * triangles[3 * t + corner]! + c]! * (c === 2 ? rise : 1);
    for (let t = 0; t < count; ++t) {
      for (let c = 0; c < 3; ++c) this.centres[3 * t + c] = (at(t, 0, c) + at(t, 1, c) + at(t, 2, c)) / 3;
      const [u, v] = [1, 2].map((corner) => [0, 1, 2].map((c) => at(t, corner, c) - at(t, 0, c))) as [
        number[],
        number[],
      ];
      area[t] = Math.hypot(u[1]! * v[2]! - u[2]! * v[1]!, u[2]! * v[0]! - u[0]! * v[2]!, u[0]! * v[1]! - u[1]! * v[0]!);
    }
    const all = Uint32Array.from({ length: count }, (_, t) => t);
    this.largest = count <= FEW ? all : all.sort((s, t) => area[t]! - area[s]!).slice(0, FEW);
  }

  // Set the order for a direction of view. Return the number of triangles to draw.
  sort(towards: Vector3, is_coarse: boolean): number {
    const { triangles, centres, attribute } = this;
    const chosen = is_coarse ? this.largest : undefined;
    const count = chosen?.length ?? triangles.length / 3;
    const depth = new Float32Array(count);
    const slot = new Uint16Array(count);
    let low = Infinity;
    let high = -Infinity;
    for (let k = 0; k < count; ++k) {
      const t = 3 * (chosen ? chosen[k]! : k);
      const d = centres[t]! * towards.x + centres[t + 1]! * towards.y + centres[t + 2]! * towards.z;
      depth[k] = d;
      low = Math.min(low, d);
      high = Math.max(high, d);
    }
    const first = new Uint32Array(LEVELS + 1);
    const scale = (LEVELS - 1) / Math.max(high - low, 1e-30);
    for (let k = 0; k < count; ++k) {
      slot[k] = LEVELS - 1 - Math.floor((depth[k]! - low) * scale);
      first[slot[k]! + 1]!++;
    }
    for (let k = 0; k < LEVELS; ++k) first[k + 1]! += first[k]!;
    const into = attribute.array as Uint32Array;
    for (let k = 0; k < count; ++k) {
      const t = 3 * (chosen ? chosen[k]! : k);
      const at = 3 * first[slot[k]!]!++;
      into[at] = triangles[t]!;
      into[at + 1] = triangles[t + 1]!;
      into[at + 2] = triangles[t + 2]!;
    }
    attribute.clearUpdateRanges();
    attribute.addUpdateRange(0, 3 * count);
    attribute.needsUpdate = true;
    return count;
  }
}
