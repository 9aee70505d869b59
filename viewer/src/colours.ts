// Colours of patches and paths. Ordered values share one scale (cividis, the same to colour-blind readers).
import { Color } from "three";
import { type Columns, bytes, doubles, integers } from "./engine";

export interface Palette {
  vertex_edge: string;
  edge_vertex: string;
  arc_arc: string;
  helix: string;
  segment: string;
  ink: string;
  faint: string;
  path: string;
  ahead: string;
  back: string;
  in_place: string;
  good: string;
  bad: string;
  accent: string;
  barrier: string;
}
export type ColourBy = "contact" | "cell" | "obstacle" | "gaussian" | "mean";
const MANY = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#8a7bd1", "#b2a13c"];
const SCALE = [
  "#00224e",
  "#123570",
  "#3b496c",
  "#575d6d",
  "#707173",
  "#8a8678",
  "#a59c74",
  "#c3b369",
  "#e1cc55",
  "#fee838",
].map((of) => new Color(of));

// The scale as a background.
export const gradient = () => `linear-gradient(to right, ${SCALE.map((of) => `#${of.getHexString()}`).join(", ")})`;
// Colours of numbers, which come again.
export const of_number = (k: number) => MANY[(k + 8 * MANY.length) % MANY.length]!;

// The colour at a share of the scale: at 0 its first, at 1 its last.
export function on_scale(share: number): Color {
  const at = Math.max(0, Math.min(1, share)) * (SCALE.length - 1);
  const k = Math.min(Math.floor(at), SCALE.length - 2);
  return SCALE[k]!.clone().lerp(SCALE[k + 1]!, at - k);
}

// Round shapes have patches of an arc on an arc, which are bent to either side.
export const LEGENDS = (is_round: boolean): Record<ColourBy, string> => ({
  contact: "",
  cell: "a colour for each cell",
  obstacle: "a colour for each obstacle",
  gaussian: is_round
    ? "K r², the robot's radius r for a radian: -1 or less (dark), 0, 1 or more (bright)"
    : "K r², the robot's radius r for a radian: -1 (dark) to 0, flat (bright)",
  mean: "H: bulging (dark), 0, hollow (bright)",
});

// The values at the ends of the scale; nothing if colours are not those of values.
export function range_of(mesh: Columns, by: ColourBy): [number, number] | undefined {
  if (by === "gaussian") return [-1, bytes(mesh, "kind").includes(2) ? 1 : 0];
  if (by !== "mean") return undefined;
  const most = doubles(mesh, "mean").reduce((a, b) => Math.max(a, Math.abs(b)), 1e-30);
  return [-most, most];
}

// Three numbers for each vertex of a mesh.
export function vertex_colours(mesh: Columns, by: ColourBy, palette: Palette): Float32Array {
  const kind = bytes(mesh, "kind");
  const colours = new Float32Array(3 * kind.length);
  const of_kind = [palette.vertex_edge, palette.edge_vertex, palette.arc_arc].map((of) => new Color(of));
  const many = new Map(MANY.map((of) => [of, new Color(of)]));
  const of_column = (numbers: Int32Array) => (k: number) => many.get(of_number(numbers[k]!))!;
  const [low, high] = range_of(mesh, by) ?? [0, 1];
  const of_value = (values: Float64Array) => (k: number) => on_scale((values[k]! - low) / (high - low));
  const colour = {
    contact: (k: number) => of_kind[kind[k]!]!,
    cell: of_column(integers(mesh, "cell")),
    obstacle: of_column(integers(mesh, "owner")),
    gaussian: of_value(doubles(mesh, "gaussian")),
    mean: of_value(doubles(mesh, "mean")),
  }[by];
  for (let k = 0; k < kind.length; ++k) colour(k).toArray(colours, 3 * k);
  return colours;
}
