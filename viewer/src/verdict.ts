// Answers of the core in words.
import { type Columns, bytes, doubles, integers, string, value } from "./engine";
import type { Vehicle } from "./vehicle";

export const degrees = (theta: number) => `${((theta * 180) / Math.PI).toFixed(1).replace(/\.0$/, "")}°`;
// A number with some digits, and all those before the point.
export function in_digits(of: number, count: number): string {
  const short = of.toPrecision(count);
  return short.includes("e+") ? of.toFixed(0) : short;
}
export type Tone = "good" | "touch" | "bad" | "proof" | "plain";
export interface Verdict {
  tone: Tone;
  text: string;
}

export function obstacle_name(names: string[], k: number): string {
  if (k === -1) return "the bounds";
  if (k === -2) return "the workspace";
  const name = names[k] ?? `obstacle ${k}`;
  return name === `obstacle ${k}` ? name : `obstacle ${k} (${name})`;
}

// "robot vertex 2 on edge 4 of obstacle 3 (kite)"; where shapes are grown "robot arc 2 on arc 1 of obstacle 4".
export function contact_words(columns: Columns, prefix: string, k: number, names: string[]): string {
  const of = (name: string) => integers(columns, `${prefix}.${name}`)[k]!;
  const owner = of("obstacle");
  const robot = of("robot_vertex");
  const corner = of("obstacle_vertex");
  const where = obstacle_name(names, owner);
  if (owner === -1) return "the reference point on the bounds";
  const kind = bytes(columns, `${prefix}.kind`)[k]!;
  const corner_of = (side: string) => ((doubles(columns, `${prefix}.${side}_radius`)[k] ?? 0) > 0 ? "arc" : "vertex");
  const [first, second] = [kind === 1 ? "edge" : corner_of("robot"), kind === 0 ? "edge" : corner_of("obstacle")];
  return `robot ${first} ${robot} on ${second} ${corner} of ${where}`;
}

const joined = (some: string[]): string =>
  some.length > 1 ? `${some.slice(0, -1).join(", ")} and ${some.at(-1)}` : some[0]!;

export function pose_verdict(columns: Columns, names: string[]): Verdict {
  if (value(columns, "free") === 0) {
    const [part, owner] = integers(columns, "pair");
    if (part === -1) return { tone: "bad", text: `Forbidden: outside ${obstacle_name(names, owner!)}.` };
    return {
      tone: "bad",
      text: `Forbidden: the robot overlaps ${owner! < 0 ? "the outside of " : ""}${obstacle_name(names, owner!)}.`,
    };
  }
  const touching = bytes(columns, "touching.kind").length;
  const touched = [...integers(columns, "touched")]; // among round shapes
  if (touched.length && touching === 0) {
    const some = touched.slice(0, 2).map((k) => obstacle_name(names, k));
    if (touched.length > 2) some.push(`${touched.length - 2} more`);
    return { tone: "touch", text: `Touching ${joined(some)}. Allowed.` };
  }
  if (touching === 0) return { tone: "good", text: "Free." };
  const said = Array.from({ length: Math.min(touching, 2) }, (_, k) => contact_words(columns, "touching", k, names));
  const rest = touching > 2 ? ` and ${touching - 2} more` : "";
  return { tone: "touch", text: `Touching: ${said.join("; ")}${rest}. Allowed.` };
}

// The boundary at the right is that of polygons around shapes that are not rounded.
export function around_words(scene: Columns, names: string[], units: string): string {
  const owners = [...integers(scene, "around.shapes")];
  if (!owners.length) return "";
  const some = owners.slice(0, 2).map((k) => (k === -3 ? "the robot" : obstacle_name(names, k)));
  if (owners.length > 2) some.push(`${owners.length - 2} more`);
  const within = `${in_digits(value(scene, "around"), 2)}${units && ` ${units}`}`;
  return ` · ${joined(some)}: drawn as ${owners.length > 1 ? "polygons" : "a polygon"} around the arcs, within ${within}`;
}

function blocking(owners: number[], names: string[]): string {
  const are_plain = owners.every((k) => k >= 0 && (names[k] ?? `obstacle ${k}`) === `obstacle ${k}`);
  const some = owners.slice(0, 4).map((k) => (are_plain ? String(k) : obstacle_name(names, k)));
  if (owners.length > 4) some.push(`${owners.length - 4} more`);
  return are_plain ? `obstacle${owners.length > 1 ? "s" : ""} ${joined(some)}` : joined(some);
}

// The machine in a sentence, with its article.
const machine = (vehicle: Vehicle | undefined): string =>
  vehicle?.kind === "car"
    ? `a car${vehicle.gears === "forward" ? " without reverse gear" : ""}`
    : "a machine that turns in place";
const many = (count: number, what: string) => `${count.toLocaleString("en")} ${what}${count === 1 ? "" : "s"}`;

// How far a path keeps away: "that keeps 0.2 m".
const kept = (clearance: string, units: string) => `that keeps ${clearance}${units && ` ${units}`}`;

function path_words(columns: Columns, units: string, vehicle: Vehicle | undefined, clearance: string): string {
  const pieces = value(columns, "motions");
  const length = `length ${in_digits(value(columns, "length"), 3)}${units ? ` ${units}` : ""}`;
  if (columns.gear) {
    const cusps = value(columns, "cusps");
    const changes = `${many(cusps, "change")} of direction`;
    const far = clearance && `, on a path ${kept(clearance, units)}`;
    const text = `${machine(vehicle)} drives there${far}: ${many(pieces, "motion")}, ${changes}, ${length}; proved free.`;
    return text[0]!.toUpperCase() + text.slice(1);
  }
  const turning = (doubles(columns, "turning")[0]! * 180) / Math.PI;
  return `A motion exists${clearance && ` ${kept(clearance, units)}`}: ${pieces} ${pieces === 1 ? "piece" : "pieces"}, ${length}, turning ${turning.toFixed(0)} degrees; proved free.`;
}

// Answers about vehicles that are neither a path nor a proof.
function open_words(verdict: string, columns: Columns, vehicle: Vehicle | undefined): string | undefined {
  const it = machine(vehicle);
  const touches = /^(start|goal) touches$/.exec(verdict);
  if (touches)
    return `${touches[1] === "start" ? "Start" : "Goal"}: the robot touches something. The page does not decide this for ${it}; use \`cfree plan\`.`;
  if (verdict === "contacts")
    return `A motion exists, but along contacts only. The page does not decide this for ${it}; use \`cfree plan\`.`;
  if (verdict === "round") return "Undecided here for the round shapes: `cfree plan` decides more.";
  if (verdict === "round joined")
    return "A motion exists: start and goal are in one cell. The page has found none to show; `cfree plan` searches longer.";
  if (verdict === "round apart")
    return "No motion with clearance: start and goal are in different cells. The page does not decide whether one exists that touches.";
  if (verdict === "narrow") return `A way of ${it} exists; the page cannot write it down: its passages are too narrow.`;
  if (verdict === "forward")
    return "A way exists with a reverse gear; none without one was found here: `cfree plan` may decide it.";
  if (verdict !== "manoeuvres") return undefined;
  const needed = value(columns, "manoeuvres");
  return `A way exists; ${it} needs ${needed > 0 ? `about ${needed.toLocaleString("en")}` : "too many"} manoeuvres.`;
}

export function way_verdict(
  columns: Columns,
  names: string[],
  units: string,
  vehicle?: Vehicle,
  clearance = "",
): Verdict {
  const verdict = string(columns, "verdict");
  if (verdict.endsWith("forbidden")) {
    const owner = integers(columns, "pair")[1]!;
    const overlaps = owner < 0 ? "overlaps the outside of" : "overlaps";
    const how = clearance ? `is nearer than ${clearance}${units && ` ${units}`} to` : overlaps;
    const end = verdict.startsWith("start") ? "Start" : "Goal";
    return { tone: "bad", text: `${end}: the robot ${how} ${obstacle_name(names, owner)}.` };
  }
  if (verdict === "path") return { tone: "good", text: path_words(columns, units, vehicle, clearance) };
  if (verdict === "apart") {
    const owners = [...integers(columns, "obstacles")];
    // the proof holds for every vehicle
    const it = vehicle?.kind === "differential" ? machine(vehicle) : "a car, whatever its turning radius";
    if (clearance)
      return {
        tone: "proof",
        text: `No motion ${kept(clearance, units)}: separated by ${blocking(owners, names)}. Nor does one of ${it}.`,
      };
    return {
      tone: "proof",
      text:
        value(columns, "closed") === 1
          ? `No motion, not even touching: separated by ${blocking(owners, names)}. Nor can ${it}.`
          : `No motion with clearance: separated by ${blocking(owners, names)}; no path that touches was found. Nor can ${it}, with clearance.`,
    };
  }
  return {
    tone: "plain",
    text: open_words(verdict, columns, vehicle) ?? "Undecided here: `cfree plan` decides it.",
  };
}

// What beside a proof tells how much smaller the robot would have to be.
export function missing_words(found: Columns, units: string): string {
  if (found.verdict === "none")
    return "How much is missing: no inset that leaves all sides of the robot helps; `cfree plan --nearest-miss` tries more.";
  if (found.verdict === "unknown")
    return "How much is missing is not computed here for this robot: `cfree plan --nearest-miss` tells.";
  const [low, high] = [value(found, "lo"), value(found, "hi")];
  const short = (length: number) => Number(length.toPrecision(3));
  const unit = units && ` ${units}`;
  const proved = value(found, "proved") === 1 ? "" : " The page does not decide between the two.";
  return `Missing: the robot gets there if all its sides move inwards by ${short(high)}${unit}, and not by ${short(low)}${unit}. It is about ${short(2 * high)}${unit} too wide.${proved}`;
}

// "Cell 5: volume 1.24, caged: obstacles alone enclose it; the robot cannot turn round in it."
export function cell_words(k: number, cell: Columns, units: string): string {
  const volume = value(cell, "volume");
  const turns = value(cell, "turns");
  const size = Number.isFinite(volume) ? `volume ${in_digits(volume, 4)}${units ? ` ${units}²` : ""} rad` : "unbounded";
  const caged =
    value(cell, "caged") === 1
      ? "caged: obstacles alone enclose it"
      : value(cell, "bounded") === 1
        ? "bounded, not by obstacles alone"
        : "not caged";
  return `Cell ${k}: ${size}; ${caged}; the robot ${turns === 1 ? "can" : "cannot"} turn round in it.`;
}

// A picked patch: its contact, the point, curvatures, range, and the contacts whose surfaces trim it.
export function patch_words(found: Columns, names: string[]): string {
  const range = doubles(found, "range");
  const low = range.reduce((a, b) => Math.min(a, b), Infinity);
  const high = range.reduce((a, b) => Math.max(a, b), -Infinity);
  const trims = Array.from({ length: bytes(found, "trims.kind").length }, (_, k) =>
    contact_words(found, "trims", k, names),
  );
  const more = trims.length > 4 ? ` and ${trims.length - 4} more` : "";
  const number = (name: string) => in_digits(value(found, name), 4);
  const place =
    bytes(found, "contact.kind")[0] === 2
      ? `S(ψ, φ) at ψ = ${degrees(value(found, "t"))}`
      : `S(t, φ) at t = ${value(found, "t").toFixed(3)}`;
  return [
    contact_words(found, "contact", 0, names),
    `${place}, φ = ${degrees(value(found, "phi"))}`,
    `K = ${number("K")}, H = ${number("H")}`,
    `left of it: φ from ${degrees(low)} to ${degrees(high)}`,
    trims.length ? `trimmed by: ${trims.slice(0, 4).join("; ")}${more}` : "trimmed by nothing",
  ].join("\n");
}
