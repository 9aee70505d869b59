import assert from "node:assert/strict";
import { test } from "node:test";
import {
  around_words,
  cell_words,
  contact_words,
  degrees,
  in_digits,
  missing_words,
  obstacle_name,
  patch_words,
  pose_verdict,
  way_verdict,
} from "../src/verdict.ts";

const NAMES = ["kite", "obstacle 1"];
const numbers = (fields) =>
  Object.fromEntries(Object.entries(fields).map(([name, value]) => [name, Float64Array.of(value)]));
const contacts = (prefix, kind, robot, corner, owner) => ({
  [`${prefix}.kind`]: Uint8Array.from(kind),
  [`${prefix}.robot_vertex`]: Int32Array.from(robot),
  [`${prefix}.obstacle_vertex`]: Int32Array.from(corner),
  [`${prefix}.obstacle`]: Int32Array.from(owner),
});

test("obstacles have their number, and their name if it says more", () => {
  assert.deepEqual(
    [-1, -2, 0, 1, 2].map((k) => obstacle_name(NAMES, k)),
    ["the bounds", "the workspace", "obstacle 0 (kite)", "obstacle 1", "obstacle 2"],
  );
  assert.deepEqual([degrees(Math.PI / 2), degrees(1)], ["90°", "57.3°"]);
});

test("contacts name vertex and edge", () => {
  const columns = contacts("c", [0, 1, 0], [2, 3, 0], [4, 5, 0], [0, 1, -1]);
  assert.deepEqual(
    [0, 1, 2].map((k) => contact_words(columns, "c", k, NAMES)),
    [
      "robot vertex 2 on edge 4 of obstacle 0 (kite)",
      "robot edge 3 on vertex 5 of obstacle 1",
      "the reference point on the bounds",
    ],
  );
});

test("a pose is free, touches or is forbidden", () => {
  const free = numbers({ free: 1 });
  assert.deepEqual(pose_verdict(free, NAMES), { tone: "good", text: "Free." });
  const touching = pose_verdict(
    { ...free, ...contacts("touching", [0, 1, 1], [2, 3, 3], [4, 5, 6], [1, 1, 1]) },
    NAMES,
  );
  assert.equal(touching.tone, "touch");
  assert.match(touching.text, /^Touching: robot vertex 2 .*; robot edge 3 .* and 1 more\. Allowed\.$/);
  const forbidden = (part, owner) =>
    pose_verdict({ ...numbers({ free: 0 }), pair: Int32Array.of(part, owner) }, NAMES).text;
  assert.equal(forbidden(0, 0), "Forbidden: the robot overlaps obstacle 0 (kite).");
  assert.equal(forbidden(0, -2), "Forbidden: the robot overlaps the outside of the workspace.");
  assert.equal(forbidden(-1, -1), "Forbidden: outside the bounds.");
});

test("a way is a motion, a proof, or undecided", () => {
  const path = { verdict: "path", ...numbers({ motions: 1, length: 2.345678, turning: Math.PI }) };
  assert.equal(
    way_verdict(path, NAMES, "m").text,
    "A motion exists: 1 piece, length 2.35 m, turning 180 degrees; proved free.",
  );
  const apart = (closed, owners, names) =>
    way_verdict({ verdict: "apart", obstacles: Int32Array.from(owners), ...numbers({ closed }) }, names, "").text;
  assert.equal(
    apart(1, [0, 1, 2], []),
    "No motion, not even touching: separated by obstacles 0, 1 and 2. Nor can a car, whatever its turning radius.",
  );
  assert.match(apart(1, [3], []), /^No motion, not even touching: separated by obstacle 3\. Nor can a car/);
  assert.equal(
    apart(0, [0, -1], NAMES),
    "No motion with clearance: separated by obstacle 0 (kite) and the bounds; no path that touches was found. Nor can a car, whatever its turning radius, with clearance.",
  );
  assert.match(apart(1, [0, 1, 2, 3, 4, 5], []), /obstacles 0, 1, 2, 3 and 2 more\./);
  assert.equal(way_verdict({ verdict: "open" }, NAMES, "").tone, "plain");
  const start = way_verdict({ verdict: "start forbidden", pair: Int32Array.of(0, 1) }, NAMES, "");
  assert.equal(start.text, "Start: the robot overlaps obstacle 1.");
});

test("a vehicle drives there, cannot either, or needs many manoeuvres", () => {
  const car = { kind: "car", gears: "both" };
  const drive = { kind: "differential", gears: "both" };
  const said = (verdict, more = {}, vehicle = car) => way_verdict({ verdict, ...more }, NAMES, "m", vehicle).text;
  const path = { gear: Int32Array.of(1, -1, 1), ...numbers({ motions: 3, cusps: 2, length: 13.06, turning: 1 }) };
  assert.equal(
    said("path", path),
    "A car drives there: 3 motions, 2 changes of direction, length 13.1 m; proved free.",
  );
  const one = { gear: Int32Array.of(1), ...numbers({ motions: 1, cusps: 1, length: 1, turning: 1 }) };
  assert.match(
    said("path", one, drive),
    /^A machine that turns in place drives there: 1 motion, 1 change of direction,/,
  );
  assert.match(said("path", one, { ...car, gears: "forward" }), /^A car without reverse gear drives there/);
  const apart = { obstacles: Int32Array.of(1), ...numbers({ closed: 1 }) };
  assert.match(said("apart", apart), /separated by obstacle 1\. Nor can a car, whatever its turning radius\.$/);
  assert.match(said("apart", apart, drive), /Nor can a machine that turns in place\.$/);
  assert.equal(said("manoeuvres", numbers({ manoeuvres: 1908 })), "A way exists; a car needs about 1,908 manoeuvres.");
  assert.match(said("manoeuvres", numbers({ manoeuvres: 0 })), /needs too many manoeuvres/);
  assert.match(said("start touches"), /^Start: the robot touches something\. .* for a car; use `cfree plan`\.$/);
  assert.match(said("goal touches", {}, drive), /^Goal: .* for a machine that turns in place;/);
  for (const verdict of ["contacts", "narrow", "forward"]) assert.ok(!said(verdict).startsWith("Undecided"), verdict);
});

test("cells and picked patches are told in words", () => {
  assert.equal(
    cell_words(5, numbers({ volume: 1.23456, turns: 0, caged: 1, bounded: 1 }), "m"),
    "Cell 5: volume 1.235 m² rad; caged: obstacles alone enclose it; the robot cannot turn round in it.",
  );
  assert.match(
    cell_words(0, numbers({ volume: Infinity, turns: 1, caged: 0, bounded: 0 }), ""),
    /^Cell 0: unbounded; not caged;/,
  );
  const found = {
    ...numbers({ t: 0.5, phi: Math.PI / 2, K: -0.25, H: 0 }),
    range: Float64Array.of(1, 0, 2),
    ...contacts("contact", [0], [2], [4], [0]),
    ...contacts("trims", [], [], [], []),
  };
  assert.deepEqual(patch_words(found, NAMES).split("\n"), [
    "robot vertex 2 on edge 4 of obstacle 0 (kite)",
    "S(t, φ) at t = 0.500, φ = 90°",
    "K = -0.2500, H = 0.000",
    "left of it: φ from 0° to 114.6°",
    "trimmed by nothing",
  ]);
});

test("among round shapes contact names the obstacle, and neither path nor proof leads to `cfree plan`", () => {
  const touching = (...touched) =>
    pose_verdict({ ...numbers({ free: 1 }), touched: Int32Array.from(touched) }, NAMES).text;
  assert.equal(touching(0), "Touching obstacle 0 (kite). Allowed.");
  assert.equal(touching(0, -2), "Touching obstacle 0 (kite) and the workspace. Allowed.");
  assert.equal(touching(0, 1, -2, -1), "Touching obstacle 0 (kite), obstacle 1 and 2 more. Allowed.");
  assert.equal(
    way_verdict({ verdict: "round" }, NAMES, "").text,
    "Undecided here for the round shapes: `cfree plan` decides more.",
  );
  assert.match(
    way_verdict({ verdict: "round joined" }, NAMES, "").text,
    /^A motion exists: start and goal are in one cell\. The page has found none/,
  );
  assert.match(
    way_verdict({ verdict: "round apart" }, NAMES, "").text,
    /^No motion with clearance: .* different cells\. The page does not decide whether one exists that touches\.$/,
  );
  const around = (...shapes) =>
    around_words({ ...numbers({ around: 0.25 }), "around.shapes": Int32Array.from(shapes) }, NAMES, "m");
  assert.equal(around(0), " · obstacle 0 (kite): drawn as a polygon around the arcs, within 0.25 m");
  assert.equal(
    around(-3, 1, -2),
    " · the robot, obstacle 1 and 1 more: drawn as polygons around the arcs, within 0.25 m",
  );
  assert.equal(around_words({}, NAMES, "m"), "");
});

test("arcs in contact are told from vertices, and contacts come before what touches", () => {
  const radii = (robot, obstacle) => ({
    "c.robot_radius": Float64Array.from(robot),
    "c.obstacle_radius": Float64Array.from(obstacle),
  });
  const columns = {
    ...contacts("c", [0, 1, 2, 2, 2], [2, 3, 0, 1, 4], [4, 5, 6, 0, 0], [0, 0, 0, 1, 1]),
    ...radii([1, 0, 1, 0, 1], [0, 1, 0, 1, 1]),
  };
  assert.deepEqual(
    [0, 1, 2, 3, 4].map((k) => contact_words(columns, "c", k, NAMES)),
    [
      "robot arc 2 on edge 4 of obstacle 0 (kite)",
      "robot edge 3 on arc 5 of obstacle 0 (kite)",
      "robot arc 0 on vertex 6 of obstacle 0 (kite)",
      "robot vertex 1 on arc 0 of obstacle 1",
      "robot arc 4 on arc 0 of obstacle 1",
    ],
  );
  const touching = { ...numbers({ free: 1 }), touched: Int32Array.of(1), ...contacts("touching", [2], [0], [0], [1]) };
  assert.match(pose_verdict(touching, NAMES).text, /^Touching: robot vertex 0 on vertex 0 of obstacle 1\. Allowed\.$/);
  const found = {
    ...numbers({ t: Math.PI, phi: 0, K: 1, H: -1 }),
    range: Float64Array.of(0, 1),
    ...contacts("contact", [2], [2], [4], [0]),
    ...contacts("trims", [], [], [], []),
  };
  assert.equal(patch_words(found, NAMES).split("\n")[1], "S(ψ, φ) at ψ = 180°, φ = 0°");
});

test("an answer about a clearance names it", () => {
  const path = {
    verdict: "path",
    ...numbers({ motions: 2, length: 3, turning: 0 }),
  };
  assert.match(way_verdict(path, NAMES, "m", undefined, "0.2").text, /^A motion exists that keeps 0\.2 m: 2 pieces/);
  const apart = { verdict: "apart", ...numbers({ closed: 1 }), obstacles: Int32Array.of(0) };
  assert.match(way_verdict(apart, NAMES, "m", undefined, "0.2").text, /^No motion that keeps 0\.2 m: separated by/);
  assert.match(way_verdict(apart, NAMES, "m").text, /^No motion, not even touching: separated by/);
  const start = { verdict: "start forbidden", pair: Int32Array.of(0, 1) };
  assert.equal(
    way_verdict(start, NAMES, "", undefined, "1/2").text,
    "Start: the robot is nearer than 1/2 to obstacle 1.",
  );
});

test("how much is missing is an inset, none, or not computed", () => {
  const found = numbers({ lo: 0.2484, hi: 0.25, proved: 1 });
  assert.equal(
    missing_words(found, "m"),
    "Missing: the robot gets there if all its sides move inwards by 0.25 m, and not by 0.248 m. It is about 0.5 m too wide.",
  );
  assert.match(missing_words({ ...found, ...numbers({ proved: 0 }) }, ""), /does not decide between the two\.$/);
  assert.match(missing_words({ verdict: "none" }, ""), /no inset that leaves all sides of the robot helps/);
  assert.match(missing_words({ verdict: "unknown" }, ""), /`cfree plan --nearest-miss` tells/);
});

test("numbers have some digits, and all before the point", () => {
  assert.deepEqual(
    [in_digits(4009.2, 3), in_digits(0.012345, 3), in_digits(1005000.4, 4), in_digits(5.5e-7, 3), in_digits(999.96, 4)],
    ["4009", "0.0123", "1005000", "5.50e-7", "1000"],
  );
});
