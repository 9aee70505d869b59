// A scene's text as polygons that can be edited: every number stays the decimal it is written as.
import { LosslessNumber, parse } from "lossless-json";

export type Kind = "robot" | "obstacle" | "workspace";
export interface Which {
  kind: Kind;
  k: number;
}
export type Point = [string, string];
export type Ring = Point[];
export type Rings = Ring[]; // the outer one, then holes

type Json = unknown;
type Fields = Record<string, Json>;

const text_of = (c: Json): string => (c instanceof LosslessNumber ? c.value : String(c));
export const json_of = (c: string): Json => (/^-?\d+(\.\d+)?([eE][-+]?\d+)?$/.test(c) ? new LosslessNumber(c) : c);
const rings_of = (polygon: Fields): Rings =>
  [polygon.outer, ...((polygon.holes as Json[] | undefined) ?? [])].map((ring) =>
    (ring as Json[][]).map(([x, y]) => [text_of(x), text_of(y)]),
  );

// Keys of a round shape under which there are points.
const POINTS = ["outer", "holes", "path", "circle", "arc", "to", "through", "center"];
const is_number = (value: Json) => typeof value === "string" || value instanceof LosslessNumber;
const is_point = (value: Json): value is Json[] => Array.isArray(value) && value.length === 2 && value.every(is_number);
function with_points(value: Json, to: (point: Point) => Point): Json {
  if (is_point(value)) return to([text_of(value[0]), text_of(value[1])]).map(json_of);
  if (Array.isArray(value)) return value.map((item) => with_points(item, to));
  if (!value || typeof value !== "object" || value instanceof LosslessNumber) return value;
  return Object.fromEntries(
    Object.entries(value).map(([key, item]) => [key, POINTS.includes(key) ? with_points(item, to) : item]),
  );
}

export const is_round = (of: object): boolean => ["circle", "ellipse", "path", "grown"].some((key) => key in of);

export function same(a: Which | undefined, b: Which | undefined): boolean {
  return a?.kind === b?.kind && a?.k === b?.k;
}

// One value a line down to the polygons, as `cfree.save` writes scenes.
function written(value: Json, depth = 0): string {
  if (value instanceof LosslessNumber) return value.value;
  if (Array.isArray(value)) {
    const items = value.map((item) => written(item, depth + 1));
    const is_list_of_polygons =
      depth === 1 && value.some((item) => item && typeof item === "object" && ("outer" in item || is_round(item)));
    return is_list_of_polygons ? `[\n    ${items.join(",\n    ")}\n  ]` : `[${items.join(", ")}]`;
  }
  if (value && typeof value === "object") {
    const items = Object.entries(value)
      .filter(([, item]) => item !== undefined)
      .map(([key, item]) => `${JSON.stringify(key)}: ${written(item, depth + 1)}`);
    return depth === 0 ? `{\n  ${items.join(",\n  ")}\n}\n` : `{${items.join(", ")}}`;
  }
  return JSON.stringify(value);
}

export class Shapes {
  private constructor(private readonly fields: Fields) {}

  static of(source: string): Shapes {
    const fields = parse(source) as Fields;
    return new Shapes({
      ...fields,
      robot: Array.isArray(fields.robot) ? fields.robot : [fields.robot],
      obstacles: fields.obstacles ?? [],
    });
  }

  private list(kind: Kind): Fields[] {
    return kind === "workspace"
      ? this.fields.workspace
        ? [this.fields.workspace as Fields]
        : []
      : (this.fields[kind === "robot" ? "robot" : "obstacles"] as Fields[]);
  }
  all(): Which[] {
    return (["workspace", "obstacle", "robot"] as const).flatMap((kind) =>
      this.list(kind).map((_, k) => ({ kind, k })),
    );
  }
  has({ kind, k }: Which): boolean {
    return k < this.list(kind).length;
  }
  // None of a round shape.
  rings({ kind, k }: Which): Rings {
    const shape = this.list(kind)[k]!;
    return is_round(shape) ? [] : rings_of(shape);
  }
  // True if a shape has arcs: it is moved as a whole only.
  is_round({ kind, k }: Which): boolean {
    return is_round(this.list(kind)[k]!);
  }
  // Move a round shape: all its points, so that arcs stay exact.
  moved_by({ kind, k }: Which, dx: string, dy: string): Shapes {
    const { check: _, ...fields } = this.fields;
    const by = ([x, y]: Point): Point => [moved_exactly(x, dx), moved_exactly(y, dy)];
    const to = (shape: Fields) => with_points(shape, by) as Fields;
    if (kind === "workspace") return new Shapes({ ...fields, workspace: to(fields.workspace as Fields) });
    const shapes = this.list(kind).map((shape, j) => (j === k ? to(shape) : shape));
    return new Shapes({ ...fields, [kind === "robot" ? "robot" : "obstacles"]: shapes });
  }

  // Replace the rings of a polygon, or remove it; a number after the last adds an obstacle.
  with({ kind, k }: Which, rings: Rings | undefined): Shapes {
    const plain = (ring: Ring) => ring.map((point) => point.map(json_of));
    const made = (old: Fields | undefined): Fields => {
      const { outer: _, holes: __, ...rest } = old ?? {};
      return { ...rest, outer: plain(rings![0]!), ...(rings!.length > 1 && { holes: rings!.slice(1).map(plain) }) };
    };
    const { check: _, ...fields } = this.fields; // known facts of the scene before the edit
    if (kind === "workspace") return new Shapes({ ...fields, workspace: rings && made(fields.workspace as Fields) });
    const polygons = [...this.list(kind)];
    if (rings) polygons[k] = made(polygons[k]);
    else polygons.splice(k, 1);
    return new Shapes({ ...fields, [kind === "robot" ? "robot" : "obstacles"]: polygons });
  }

  // Start and goal in place of those in the file, and the vehicle; undefined is none.
  ending(ends: { start?: Json; goal?: Json; vehicle?: Json }): Shapes {
    const { goals: _, ...fields } = this.fields;
    return new Shapes({ ...fields, ...ends });
  }

  text(): string {
    const robot = this.fields.robot as Fields[];
    return written({ ...this.fields, robot: robot.length === 1 ? robot[0] : robot });
  }
}

// A pose as in files, with its numbers unchanged.
export const pose_json = ({ x, y, tau }: { x: string; y: string; tau: string }): Json => [
  json_of(x),
  json_of(y),
  { tau },
];

export const digits = (step: number) => Math.min(20, Math.max(0, -Math.round(Math.log10(step))));
// A coordinate on the grid, as short as it can be written.
export function snapped(c: number, step: number): string {
  const text = (Math.round(c / step) * step).toFixed(digits(step));
  return text.includes(".") ? text.replace(/\.?0+$/, "").replace(/^-0$/, "0") : text.replace(/^-0$/, "0");
}
export function number(text: string): number {
  const [p, q] = text.split("/");
  return Number(p) / Number(q ?? 1);
}
// A coordinate moved by a step of the grid; decimals keep all their digits.
export function moved(text: string, by: string): string {
  const parts = [text, by].map((of) => /^(-?)(\d+)(?:\.(\d+))?$/.exec(of));
  if (!parts[0] || !parts[1]) return snapped(number(text) + number(by), 1e-9);
  const places = Math.max(...parts.map((of) => of![3]?.length ?? 0));
  const whole = (of: RegExpExecArray) => BigInt(`${of[1]}${of[2]}${(of[3] ?? "").padEnd(places, "0")}`);
  const sum = whole(parts[0]) + whole(parts[1]);
  const size = (sum < 0n ? -sum : sum).toString().padStart(places + 1, "0");
  const cut = size.length - places;
  const rest = size.slice(cut).replace(/0+$/, "");
  return `${sum < 0n ? "-" : ""}${size.slice(0, cut)}${rest && `.${rest}`}`;
}
// The same for points of arcs, whose fractions stay exact.
export function moved_exactly(text: string, by: string): string {
  const fraction = /^(-?\d+)\/(\d+)$/.exec(text);
  const step = /^(-?\d+)(?:\.(\d+))?$/.exec(by);
  if (!fraction || !step) return moved(text, by);
  const unit = 10n ** BigInt(step[2]?.length ?? 0);
  const q = BigInt(fraction[2]!);
  const sum = BigInt(fraction[1]!) * unit + BigInt(step[1]! + (step[2] ?? "")) * q;
  let [divisor, rest] = [q * unit, sum < 0n ? -sum : sum];
  while (rest) [divisor, rest] = [rest, divisor % rest];
  const [n, d] = [sum / divisor, (q * unit) / divisor];
  return d === 1n ? String(n) : `${n}/${d}`;
}
