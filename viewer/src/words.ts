// Scene files as words for the core: every number stays the text that it is in the file.
import { LosslessNumber, parse } from "lossless-json";
import { is_round } from "./shapes";
import { is_number, is_radius, type Vehicle } from "./vehicle";

export const MOST_BYTES = 16 << 20;
export const MOST_DEPTH = 64;
export const MOST_VERTICES = 100_000;

// x, y and an optional angle: radians or degrees as a number, or a half-angle tangent as text.
export interface FilePose {
  x: string;
  y: string;
  tau?: string;
  theta?: number;
}
export interface SceneText {
  name: string;
  note: string;
  units: string;
  names: string[];
  words: string;
  start?: FilePose;
  goal?: FilePose;
  vehicle?: FileVehicle;
}
// A differential drive has no radii.
export type FileVehicle = Omit<Vehicle, "left" | "right"> & Partial<Vehicle>;

type Json = unknown;
const fail = (place: string, wanted: string, got: Json): never => {
  throw new Error(`${place}: expected ${wanted}, got ${shown(got)}`);
};
const shown = (value: Json): string =>
  value instanceof LosslessNumber
    ? value.value.slice(0, 40)
    : value === undefined
      ? "nothing"
      : Array.isArray(value)
        ? "a list"
        : typeof value === "object" && value
          ? "an object"
          : (JSON.stringify(value)?.slice(0, 60) ?? "nothing");

export function plain(text: string, most = 80): string {
  const bare = text.replace(/[\u0000-\u001f\u200e\u200f\u202a-\u202e\u2066-\u2069]/g, "");
  return bare.length > most ? `${bare.slice(0, most - 1)}…` : bare;
}

function number(value: Json, place: string): string {
  const text =
    value instanceof LosslessNumber
      ? value.value
      : typeof value === "string"
        ? value
        : fail(place, 'a number or "p/q"', value);
  return /^[-+.\d/eE]{1,4100}$/.test(text) ? text : fail(place, 'a number or "p/q"', value);
}
const list = (value: Json, place: string): Json[] => (Array.isArray(value) ? value : fail(place, "a list", value));
const fields = (value: Json, place: string): Record<string, Json> =>
  value && typeof value === "object" && !Array.isArray(value) && !(value instanceof LosslessNumber)
    ? (value as Record<string, Json>)
    : fail(place, "an object", value);
const text = (value: Json, place: string): string =>
  value === undefined ? "" : typeof value === "string" ? value : fail(place, "a text", value);

function ring(value: Json, place: string): string {
  const points = list(value, place).map((point, k) => {
    const pair = list(point, `${place}[${k}]`);
    if (pair.length !== 2) fail(`${place}[${k}]`, "two numbers", value);
    return pair.map((c, i) => number(c, `${place}[${k}][${i}]`)).join(" ");
  });
  return `ring ${points.join(" ")}`;
}
// A list that begins with a point: a polygon without holes may be written as its ring alone.
const is_ring = (value: Json): boolean =>
  Array.isArray(value) && Array.isArray(value[0]) && value[0].length > 0 && !Array.isArray(value[0][0]);
const pair = (value: Json, place: string): string => {
  const parts = list(value, place);
  if (parts.length !== 2) fail(place, "two numbers", value);
  return parts.map((c, i) => number(c, `${place}[${i}]`)).join(" ");
};
const OTHER_CURVES =
  "the page takes lines and circular arcs; `cfree convert` with --outer writes polygons around others";

// Refuse curves that have no exact form here.
function only(of: Record<string, Json>, keys: string, place: string): void {
  for (const key of Object.keys(of)) {
    if (["ellipse", "bezier", "spline"].includes(key)) throw new Error(`${place}.${key}: ${OTHER_CURVES}`);
    if (!keys.split(" ").includes(key))
      throw new Error(`${place}: unknown key "${plain(key)}"; give one of ${keys.replaceAll(" ", ", ")}`);
  }
}

function arc(value: Json, place: string): string {
  const of = fields(value, place);
  only(of, "to through center clockwise conjugate", place);
  const to = pair(of.to, `${place}.to`);
  if ((of.through === undefined) === (of.center === undefined)) fail(place, '"through" or "center"', value);
  if (of.through !== undefined) {
    for (const key of ["clockwise", "conjugate"])
      if (of[key]) throw new Error(`${place}.${key}: of arcs about a center; leave it out`);
    return `arc ${to} through ${pair(of.through, `${place}.through`)}`;
  }
  if (of.clockwise !== undefined && typeof of.clockwise !== "boolean")
    fail(`${place}.clockwise`, "true or false", of.clockwise);
  const side = of.clockwise ? "right" : "left";
  const radius = of.conjugate === undefined ? "" : ` conjugate ${pair(of.conjugate, `${place}.conjugate`)}`;
  return `arc ${to} about ${pair(of.center, `${place}.center`)} ${side}${radius}`;
}

// A closed path: a point, then points and arcs.
function path(value: Json, place: string): string {
  const items = list(value, place).map((item, k) => {
    const here = `${place}[${k}]`;
    if (Array.isArray(item) || k === 0) return pair(item, here);
    const of = fields(item, here);
    only(of, "arc", here);
    return arc(of.arc, `${here}.arc`);
  });
  return `path ${items.join(" ")}`;
}

function curve(of: Record<string, Json>, place: string): string | undefined {
  if (of.circle !== undefined) {
    const circle = fields(of.circle, `${place}.circle`);
    only(circle, "center radius", `${place}.circle`);
    const radius = number(circle.radius, `${place}.circle.radius`);
    return `circle ${pair(circle.center, `${place}.circle.center`)} ${radius}`;
  }
  return of.path === undefined ? undefined : path(of.path, `${place}.path`);
}

function round(of: Record<string, Json>, place: string): string {
  only(of, "name circle path outer holes grown", place);
  if (["circle", "path", "outer"].filter((key) => of[key] !== undefined).length !== 1)
    throw new Error(`${place}: give one of circle, path, outer`);
  const holes = of.holes === undefined ? [] : list(of.holes, `${place}.holes`);
  const hole = (value: Json, here: string) => {
    if (Array.isArray(value)) return path(value, here);
    const ring_of = fields(value, here);
    only(ring_of, "circle path", here);
    return curve(ring_of, here) ?? fail(here, '"circle" or "path"', value);
  };
  return [
    curve(of, place) ?? path(of.outer, `${place}.outer`),
    ...holes.map((value, k) => hole(value, `${place}.holes[${k}]`)),
    ...(of.grown === undefined ? [] : [`grown ${number(of.grown, `${place}.grown`)}`]),
  ].join(" ");
}

function polygon(value: Json, place: string): string {
  if (is_ring(value)) return ring(value, place);
  const of = fields(value, place);
  if (is_round(of)) return round(of, place);
  const holes = of.holes === undefined ? [] : list(of.holes, `${place}.holes`);
  return [ring(of.outer, `${place}.outer`), ...holes.map((hole, k) => ring(hole, `${place}.holes[${k}]`))].join(" ");
}

function pose(value: Json, place: string): FilePose | undefined {
  if (value === undefined || value === null) return undefined;
  const parts = list(value, place);
  if (parts.length !== 3 && parts.length !== 2) fail(place, "x, y and an angle", value);
  const [x, y] = [number(parts[0], `${place}[0]`), number(parts[1], `${place}[1]`)];
  if (parts.length === 2) return { x, y }; // a place with any angle
  return { x, y, ...angle(parts[2], `${place}[2]`) };
}

function angle(value: Json, place: string): { tau: string } | { theta: number } {
  if (value && typeof value === "object" && !(value instanceof LosslessNumber)) {
    const tau = fields(value, place).tau;
    return { tau: tau === null || tau === "inf" || tau === "-inf" ? "inf" : number(tau, `${place}.tau`) };
  }
  const degrees = typeof value === "string" ? /^\s*([-+.\deE]+)\s*(?:deg|°)\s*$/.exec(value) : null;
  const radians = typeof value === "string" ? /^\s*([-+.\deE]+)\s*rad\s*$/.exec(value) : null;
  const theta = degrees
    ? (Number(degrees[1]) * Math.PI) / 180
    : radians
      ? Number(radians[1])
      : Number(number(value, place));
  if (typeof value === "string" && !degrees && !radians && Math.abs(theta) > 2 * Math.PI)
    throw new Error(`${place}: ${value} is more than a whole turn in radians; write ${value}deg or ${value}rad`);
  return Number.isFinite(theta) ? { theta } : fail(place, "an angle", value);
}

// As in files, and in what Python sends.
export function read_vehicle(value: Json, place = "vehicle"): FileVehicle | undefined {
  if (value === undefined || value === null) return undefined;
  const of = fields(value, place);
  const kind =
    of.type === "car" || of.type === "differential"
      ? of.type
      : fail(`${place}.type`, '"car" or "differential"', of.type);
  const keys = kind === "car" ? "type turning_radius axle heading gears wheelbase" : "type axle heading";
  const unknown = Object.keys(of).find((key) => !keys.split(" ").includes(key));
  if (unknown !== undefined)
    throw new Error(
      `${place}: unknown key "${plain(unknown)}"; those of this vehicle are ${keys.replaceAll(" ", ", ")}`,
    );
  const exact = (c: Json, where: string) => {
    const text = number(c, where);
    return is_number(text) ? text : fail(where, 'a number or "p/q"', c);
  };
  const pair = (c: Json, where: string): [string, string] => {
    const parts = list(c, where);
    if (parts.length !== 2) fail(where, "two numbers", c);
    return [exact(parts[0], `${where}[0]`), exact(parts[1], `${where}[1]`)];
  };
  const [x, y] = of.axle === undefined ? ["0", "0"] : pair(of.axle, `${place}.axle`);
  const heading = of.heading === undefined ? { tau: "0" } : angle(of.heading, `${place}.heading`);
  const right_angles = "theta" in heading ? (2 * heading.theta) / Math.PI : 0;
  if (Math.abs(right_angles - Math.round(right_angles)) > 1e-12)
    throw new Error(`${place}.heading: give a multiple of 90deg, or {"tau": "p/q"}, the tangent of its half`);
  const tau = "tau" in heading ? heading.tau : ["0", "1", "inf", "-1"][((Math.round(right_angles) % 4) + 4) % 4]!;
  if (tau !== "inf" && !is_number(tau)) fail(`${place}.heading.tau`, 'a number or "p/q"', tau);
  if (kind === "differential") return { kind, x, y, tau, gears: "both" };
  const radius = of.turning_radius;
  const [left, right] = Array.isArray(radius)
    ? pair(radius, `${place}.turning_radius`)
    : [exact(radius, `${place}.turning_radius`), exact(radius, `${place}.turning_radius`)];
  if (!is_radius(left) || !is_radius(right)) fail(`${place}.turning_radius`, "a length above 0", radius);
  const gears =
    of.gears === undefined || of.gears === "both"
      ? "both"
      : of.gears === "forward"
        ? "forward"
        : fail(`${place}.gears`, '"both" or "forward"', of.gears);
  if (of.wheelbase === undefined) return { kind, left, right, x, y, tau, gears };
  const wheelbase = exact(of.wheelbase, `${place}.wheelbase`);
  if (!is_radius(wheelbase)) fail(`${place}.wheelbase`, "a length above 0", of.wheelbase);
  return { kind, left, right, x, y, tau, gears, wheelbase };
}

const RECORD = ["reading", "changed", "dropped"];
const KEYS = "version name note units source robot obstacles workspace bounds start goal goals vehicle check".split(
  " ",
);

function refuse_deep(source: string): void {
  let depth = 0;
  let quoted = false;
  for (let k = 0; k < source.length; ++k) {
    const c = source[k];
    if (quoted) {
      if (c === "\\") ++k;
      else if (c === '"') quoted = false;
    } else if (c === '"') quoted = true;
    else if (c === "[" || c === "{") {
      if (++depth > MOST_DEPTH) throw new Error(`nested deeper than ${MOST_DEPTH}: no scene is`);
    } else if (c === "]" || c === "}") --depth;
  }
}

function parsed(source: string): Json {
  try {
    return parse(source);
  } catch (error) {
    const said = (error as Error).message;
    const at = / at position (\d+)$/.exec(said);
    if (!at) throw error;
    const before = source.slice(0, Number(at[1])).split("\n");
    throw new Error(`line ${before.length}, column ${before.at(-1)!.length + 1}: ${plain(said.slice(0, at.index))}`);
  }
}

export function read_scene(source: string): SceneText {
  if (source.length > MOST_BYTES)
    throw new Error(`the file has ${(source.length / 1e6).toFixed(0)} MB; this page reads 16`);
  refuse_deep(source);
  const of = fields(parsed(source), "scene");
  if ("type" in of)
    throw new Error('GeoJSON: save it as a scene first, `cfree.save(cfree.load_scene(...), "scene.json")`');
  const unknown = Object.keys(of).find((key) => !KEYS.includes(key) && !RECORD.includes(key));
  if (unknown !== undefined) throw new Error(`unknown key "${plain(unknown)}"; those of scenes are ${KEYS.join(", ")}`);
  const words: string[] = [];
  const parts = Array.isArray(of.robot) && !is_ring(of.robot) ? of.robot : [of.robot];
  parts.forEach((part, k) => words.push("robot", polygon(part, parts.length > 1 ? `robot[${k}]` : "robot")));
  const obstacles =
    of.obstacles === undefined ? [] : is_ring(of.obstacles) ? [of.obstacles] : list(of.obstacles, "obstacles");
  const names = obstacles.map((obstacle, k) => {
    words.push("obstacle", polygon(obstacle, `obstacles[${k}]`));
    return plain(text((obstacle as Record<string, Json>).name, `obstacles[${k}].name`)) || `obstacle ${k}`;
  });
  if (of.workspace) words.push("workspace", polygon(of.workspace, "workspace"));
  if (of.bounds) {
    const bounds = list(of.bounds, "bounds");
    if (bounds.length !== 4) fail("bounds", "xmin, ymin, xmax, ymax", of.bounds);
    words.push("bounds", ...bounds.map((c, k) => number(c, `bounds[${k}]`)));
  }
  const joined = words.join(" ");
  if (joined.split(" ").length > 2 * MOST_VERTICES)
    throw new Error(`more than ${MOST_VERTICES.toLocaleString("en")} vertices: simplify`);
  return {
    name: plain(text(of.name, "name")),
    note: plain(text(of.note, "note"), 300),
    units: plain(text(of.units, "units"), 30),
    names,
    words: joined,
    start: pose(of.start, "start"),
    goal: of.goals === undefined ? pose(of.goal, "goal") : pose(list(of.goals, "goals")[0], "goals[0]"),
    vehicle: read_vehicle(of.vehicle),
  };
}
