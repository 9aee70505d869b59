// A vehicle in exact texts: as words for the core, and its axle, wheels and track in doubles for the eye.
import { number, snapped } from "./shapes";

export type Moves = "any" | "differential" | "car";
// Its numbers stay while the robot moves in any direction: radii of arcs to the left and right, axle point, heading.
export interface Vehicle {
  kind: Moves;
  left: string;
  right: string;
  x: string;
  y: string;
  tau: string;
  gears: "both" | "forward";
  wheelbase?: string; // of a car, for the eye alone
}
export interface Axle {
  x: number;
  y: number;
  theta: number;
}

const RATIONAL = /^[-+]?(\d+\/\d+|(\d+\.?\d*|\.\d+)([eE][-+]?\d{1,3})?)$/;
const is_text = (of: unknown): of is string => typeof of === "string" && of.length < 4100;
export const is_number = (of: unknown): of is string => is_text(of) && RATIONAL.test(of) && Number.isFinite(number(of)); // no division by zero
export const is_radius = (of: unknown): of is string => is_number(of) && number(of) > 0;
export function is_vehicle(of: unknown): of is Vehicle {
  const { kind, left, right, x, y, tau, gears, wheelbase } = (of ?? {}) as Record<string, unknown>;
  return (
    (kind === "any" || kind === "differential" || kind === "car") &&
    is_radius(left) &&
    is_radius(right) &&
    is_number(x) &&
    is_number(y) &&
    (tau === "inf" || is_number(tau)) &&
    (gears === "both" || gears === "forward") &&
    (wheelbase === undefined || is_radius(wheelbase))
  );
}

// Empty if it moves in any direction.
export function words_of(vehicle: Vehicle | undefined): string {
  if (!vehicle || vehicle.kind === "any") return "";
  const { kind, left, right, x, y, tau, gears } = vehicle;
  return kind === "car" ? `car ${left} ${right} ${x} ${y} ${tau} ${gears}` : `differential ${x} ${y} ${tau}`;
}

// As in files, with numbers as texts or as they are made of them; nothing if it moves in any direction.
export function record_of(
  vehicle: Vehicle | undefined,
  number: (text: string) => unknown = (text) => text,
): Record<string, unknown> | undefined {
  if (!vehicle || vehicle.kind === "any") return undefined;
  const { kind, left, right, x, y, tau, gears, wheelbase } = vehicle;
  const is_car = kind === "car";
  return {
    type: kind,
    ...(is_car && { turning_radius: left === right ? number(left) : [number(left), number(right)] }),
    axle: [number(x), number(y)],
    ...(tau !== "0" && { heading: { tau } }),
    ...(is_car && gears === "forward" && { gears }),
    ...(is_car && wheelbase !== undefined && { wheelbase: number(wheelbase) }),
  };
}

function box_of(xy: ArrayLike<number>): [number, number, number, number] {
  const box: [number, number, number, number] = [Infinity, Infinity, -Infinity, -Infinity];
  for (let k = 0; k < xy.length; k += 2) {
    box[0] = Math.min(box[0], xy[k]!);
    box[1] = Math.min(box[1], xy[k + 1]!);
    box[2] = Math.max(box[2], xy[k]!);
    box[3] = Math.max(box[3], xy[k + 1]!);
  }
  return box;
}

// A guess for a robot: forward along its longer side, the axle a fifth from behind, its length as the radius.
export function usual(robot: ArrayLike<number>): Vehicle {
  const [x0, y0, x1, y1] = box_of(robot);
  const [w, h] = [x1 - x0, y1 - y0];
  const length = Math.max(w, h);
  const step = 10 ** (Math.floor(Math.log10(length)) - 1);
  const along = w >= h;
  const radius = snapped(length, step);
  return {
    kind: "car",
    left: radius,
    right: radius,
    x: snapped(along ? x0 + w / 5 : (x0 + x1) / 2, step),
    y: snapped(along ? (y0 + y1) / 2 : y0 + h / 5, step),
    tau: along ? "0" : "1",
    gears: "both",
  };
}

// Its axle in the robot's frame.
export const frame_of = ({ x, y, tau }: Vehicle): Axle => ({
  x: number(x),
  y: number(y),
  theta: tau === "inf" ? Math.PI : 2 * Math.atan(number(tau)),
});
export function placed(at: Axle, pose: Axle): Axle {
  const c = Math.cos(pose.theta);
  const s = Math.sin(pose.theta);
  return { x: pose.x + c * at.x - s * at.y, y: pose.y + s * at.x + c * at.y, theta: pose.theta + at.theta };
}
// A point in the coordinates of a frame.
export function seen_from(pose: Axle, { x, y }: { x: number; y: number }): { x: number; y: number } {
  const c = Math.cos(pose.theta);
  const s = Math.sin(pose.theta);
  return { x: c * (x - pose.x) + s * (y - pose.y), y: c * (y - pose.y) - s * (x - pose.x) };
}

// A heading as a simple tangent of its half: right angles within 4 degrees, else twentieths.
export function heading_of(theta: number): string {
  const turn = Math.atan2(Math.sin(theta), Math.cos(theta));
  const right = Math.round((2 * turn) / Math.PI);
  if (Math.abs(turn - (right * Math.PI) / 2) < Math.PI / 45) return ["0", "1", "inf", "-1"][(right + 4) % 4]!;
  const tau = Math.tan(turn / 2);
  const twentieths = Math.round(20 * (Math.abs(tau) < 1 ? tau : 1 / tau));
  return Math.abs(tau) < 1 ? String(twentieths / 20) : `${tau < 0 ? "-" : ""}20/${Math.abs(twentieths)}`;
}

// The wheels of a robot, by the box of its outline in the axle's frame: half of the track, wheelbase, size.
export interface Wheels {
  half_track: number;
  wheelbase: number;
  length: number;
  width: number;
}
export function wheels_of(vehicle: Vehicle, robot: ArrayLike<number>): Wheels {
  const frame = frame_of(vehicle);
  const xy: number[] = [];
  for (let k = 0; k < robot.length; k += 2) {
    const { x, y } = seen_from(frame, { x: robot[k]!, y: robot[k + 1]! });
    xy.push(x, y);
  }
  const [x0, y0, x1, y1] = box_of(xy);
  const half = Math.min(-y0, y1);
  const size = Math.min(x1 - x0, y1 - y0);
  return {
    half_track: 0.78 * (half > 0 ? half : (y1 - y0) / 2),
    wheelbase: vehicle.kind !== "car" ? 0 : vehicle.wheelbase ? number(vehicle.wheelbase) : Math.max(0, 0.78 * x1),
    length: 0.3 * size,
    width: 0.11 * size,
  };
}
// Steering angle on the way from one axle pose to the next; undefined while it turns in place, or stands.
export function steering(a: Axle, b: Axle, wheelbase: number): number | undefined {
  const turn = Math.atan2(Math.sin(b.theta - a.theta), Math.cos(b.theta - a.theta));
  const mean = a.theta + turn / 2;
  const ahead = (b.x - a.x) * Math.cos(mean) + (b.y - a.y) * Math.sin(mean);
  return Math.abs(ahead) < 1e-9 * wheelbase ? undefined : Math.atan((2 * wheelbase * Math.sin(turn / 2)) / ahead);
}

export type Gear = -1 | 0 | 1;
// The axle's track: points in one gear, the last of each the first of the next; and where forward and backward meet.
export interface Track {
  pieces: { gear: Gear; points: number[] }[];
  cusps: { x: number; y: number }[];
}
// From samples of the robot's pose, and the gear in which it comes to each.
export function track_of(samples: ArrayLike<number>, gears: ArrayLike<Gear>, frame: Axle): Track {
  const track: Track = { pieces: [], cusps: [] };
  let last = 0;
  let before: { x: number; y: number } | undefined;
  for (let k = 0; 3 * k < samples.length; ++k) {
    const at = placed(frame, { x: samples[3 * k]!, y: samples[3 * k + 1]!, theta: samples[3 * k + 2]! });
    const gear = gears[k] ?? 0;
    let piece = track.pieces.at(-1);
    if (before && piece?.gear !== gear) {
      if (gear !== 0) {
        if (gear === -last) track.cusps.push(before);
        last = gear;
      }
      piece = { gear, points: [before.x, before.y] };
      track.pieces.push(piece);
    }
    piece?.points.push(at.x, at.y);
    before = at;
  }
  return track;
}
