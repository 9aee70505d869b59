// Outlines of lines and arcs: data of SVG paths, and points along them.

// On from the point before to point k, along an arc of at most half a turn if there is a radius: clockwise if it is below 0.
export const to_point = (xy: ArrayLike<number>, k: number, radius: number): string =>
  `${radius ? `A${Math.abs(radius)} ${Math.abs(radius)} 0 0 ${radius > 0 ? 1 : 0} ` : "L"}${xy[2 * k]} ${xy[2 * k + 1]}`;

// Rings as the data of a path. `bend` has the radius of the arc from each vertex to the next.
export function outline(
  xy: ArrayLike<number>,
  ring: ArrayLike<number>,
  first = 0,
  last = ring.length - 1,
  bend: ArrayLike<number> = [],
): string {
  let d = "";
  for (let r = first; r < last; ++r) {
    const begin = ring[r]!;
    const end = ring[r + 1]!;
    for (let k = begin; k < end; ++k)
      d += k === begin ? `M${xy[2 * k]} ${xy[2 * k + 1]}` : to_point(xy, k, bend[k - 1] ?? 0);
    if (bend[end - 1]) d += to_point(xy, begin, bend[end - 1]!);
    d += "Z";
  }
  return d;
}

const IN_ARC = -1e300; // in place of a radius: a point of a chord

// The rings of a slice without the points of chords.
export function corners_of(
  xy: ArrayLike<number>,
  start: ArrayLike<number>,
  bend: ArrayLike<number>,
): { xy: number[]; ring: number[]; bend: number[] } {
  const kept: { xy: number[]; ring: number[]; bend: number[] } = { xy: [], ring: [0], bend: [] };
  for (let r = 0; r + 1 < start.length; ++r) {
    for (let k = start[r]!; k < start[r + 1]!; ++k) {
      if (bend[k] === IN_ARC) continue;
      kept.xy.push(xy[2 * k]!, xy[2 * k + 1]!);
      kept.bend.push(bend[k] ?? 0);
    }
    kept.ring.push(kept.bend.length);
  }
  return kept;
}

const CHORD = 0.05; // radians

// Points of a segment, or along an arc of at most half a turn: counter-clockwise, or clockwise if the radius is below 0.
export function along_arc([x0, y0, x1, y1]: [number, number, number, number], radius: number): [number, number][] {
  const [dx, dy] = [x1 - x0, y1 - y0];
  const half = radius ? Math.asin(Math.min(1, Math.hypot(dx, dy) / (2 * Math.abs(radius)))) : 0;
  const chords = Math.max(1, Math.ceil((2 * half) / CHORD));
  const at = (k: number): [number, number] => {
    if (k === 0 || half === 0) return k ? [x1, y1] : [x0, y0];
    if (k === chords) return [x1, y1];
    // in the frame of the chord, to whose right the arc is, or to its left
    const angle = half * ((2 * k) / chords - 1);
    const along = 0.5 + Math.sin(angle) / (2 * Math.sin(half));
    const right = (Math.sign(radius) * (Math.cos(angle) - Math.cos(half))) / (2 * Math.sin(half));
    return [x0 + along * dx + right * dy, y0 + along * dy - right * dx];
  };
  return Array.from({ length: chords + 1 }, (_, k) => at(k));
}
