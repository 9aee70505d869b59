import assert from "node:assert/strict";
import { test } from "node:test";
import { MOST_BYTES, MOST_DEPTH, plain, read_scene } from "../src/words.ts";

const ROBOT = "[[0, 0], [1, 0], [0.10, 1e-3]]";
const scene = (fields) => read_scene(`{"robot": ${ROBOT}, "obstacles": []${fields ? `, ${fields}` : ""}}`);
const refused = (fields, message) => assert.throws(() => scene(fields), { message });

test("numbers stay the texts that they are in the file", () => {
  assert.equal(scene().words, "robot ring 0 0 1 0 0.10 1e-3");
  const long = `0.${"1".repeat(400)}`;
  assert.equal(scene(`"bounds": [${long}, -1, "3/7", 1E5]`).words.split(" bounds ")[1], `${long} -1 3/7 1E5`);
});

test("polygons may be rings, or objects with holes; a robot may have several parts", () => {
  const hole = "[[0.2, 0.2], [0.3, 0.2], [0.2, 0.3]]";
  const { words, names } = read_scene(
    `{"robot": [{"outer": ${ROBOT}}, {"outer": ${ROBOT}}],
      "obstacles": [{"outer": ${ROBOT}, "holes": [${hole}], "name": "kite"}, {"outer": ${ROBOT}}]}`,
  );
  const outer = "ring 0 0 1 0 0.10 1e-3";
  const holes = "ring 0.2 0.2 0.3 0.2 0.2 0.3";
  assert.equal(words, `robot ${outer} robot ${outer} obstacle ${outer} ${holes} obstacle ${outer}`);
  assert.deepEqual(names, ["kite", "obstacle 1"]);
  assert.equal(read_scene(`{"robot": ${ROBOT}, "obstacles": ${ROBOT}}`).names.length, 1);
});

test("angles are numbers, degrees, radians or tangents of half the angle", () => {
  const start = (angle) => scene(`"start": [1, "1/3", ${angle}]`).start;
  assert.deepEqual(start("0.5"), { x: "1", y: "1/3", theta: 0.5 });
  assert.deepEqual(start('"90deg"'), { x: "1", y: "1/3", theta: Math.PI / 2 });
  assert.deepEqual(start('"90°"').theta, Math.PI / 2);
  assert.deepEqual(start('"100rad"').theta, 100);
  assert.deepEqual(start('{"tau": "2/3"}'), { x: "1", y: "1/3", tau: "2/3" });
  for (const infinite of ["null", '"inf"', '"-inf"']) assert.equal(start(`{"tau": ${infinite}}`).tau, "inf");
  assert.deepEqual(scene('"goal": [1, 2]').goal, { x: "1", y: "2" });
  assert.deepEqual(scene('"goals": [[3, 4], [5, 6]]').goal, { x: "3", y: "4" });
});

test("faults name their place, the value wanted and the value there", () => {
  refused('"start": [1, 2, "7"]', "start[2]: 7 is more than a whole turn in radians; write 7deg or 7rad");
  refused('"start": [1, true, 0]', 'start[1]: expected a number or "p/q", got true');
  refused('"goal": 5', "goal: expected a list, got 5");
  refused('"bounds": [1, 2, 3]', "bounds: expected xmin, ymin, xmax, ymax, got a list");
  refused('"workspace": {"outer": [[0, 0], [1]]}', "workspace.outer[1]: expected two numbers, got a list");
  refused('"name": {}', "name: expected a text, got an object");
  refused('"speed": 1', /^unknown key "speed"; those of scenes are version, name/);
  refused('"type": "FeatureCollection"', /^GeoJSON: save it as a scene first/);
});

test("text that is not JSON is refused with line and column", () => {
  assert.throws(() => read_scene('{\n  "robot": [1,\n   x]}'), { message: /^line 3, column 4: / });
});

test("files are refused that are too large or nested too deep, before they are parsed", () => {
  assert.throws(() => read_scene(" ".repeat(MOST_BYTES + 1)), { message: /this page reads 16$/ });
  assert.throws(() => read_scene("[".repeat(MOST_DEPTH + 1)), {
    message: `nested deeper than ${MOST_DEPTH}: no scene is`,
  });
  assert.doesNotThrow(() => scene(`"note": "${"[".repeat(200)}"`));
});

test("names lose what turns the direction of writing, and are cut", () => {
  assert.equal(plain("a\u202eb\u0000c"), "abc");
  assert.equal(plain("x".repeat(90)), `${"x".repeat(79)}…`);
});

test("a vehicle is read exactly", () => {
  const vehicle = (fields) => scene(`"vehicle": {${fields}}`).vehicle;
  const car = { kind: "car", left: "4.0", right: "4.0", x: "-1.30", y: "1/9", tau: "0", gears: "both" };
  assert.deepEqual(vehicle('"type": "car", "turning_radius": 4.0, "axle": [-1.30, "1/9"]'), car);
  const other = '"type": "car", "turning_radius": [4, "9/2"], "heading": "-90deg", "gears": "forward"';
  assert.deepEqual(vehicle(other), { ...car, left: "4", right: "9/2", x: "0", y: "0", tau: "-1", gears: "forward" });
  assert.equal(vehicle('"type": "car", "turning_radius": 4.0, "wheelbase": 2.70').wheelbase, "2.70");
  const drive = { kind: "differential", x: "0", y: "0", tau: "20/7", gears: "both" };
  assert.deepEqual(vehicle('"type": "differential", "heading": {"tau": "20/7"}'), drive);
  const heading = (angle) => vehicle(`"type": "differential", "heading": ${angle}`).tau;
  assert.deepEqual(['"450deg"', '"180deg"', '{"tau": null}', "0"].map(heading), ["1", "inf", "inf", "0"]);
  assert.equal(scene('"vehicle": null').vehicle, undefined);
});

test("what is no vehicle is refused with its place", () => {
  const vehicle = (fields, message) => refused(`"vehicle": {${fields}}`, message);
  vehicle('"type": "boat"', /^vehicle\.type: expected "car" or "differential"/);
  vehicle('"type": "car"', /^vehicle\.turning_radius: expected a number/);
  for (const radius of ["0", "-1", '"1/0"', "[1, 0]"])
    vehicle(`"type": "car", "turning_radius": ${radius}`, /^vehicle\.turning_radius/);
  vehicle('"type": "differential", "turning_radius": 1', /unknown key "turning_radius"/);
  vehicle('"type": "differential", "axle": [1]', /^vehicle\.axle: expected two numbers/);
  vehicle('"type": "differential", "heading": 0.5', /^vehicle\.heading: give a multiple of 90deg/);
  vehicle('"type": "car", "turning_radius": 1, "gears": "back"', /^vehicle\.gears/);
  vehicle('"type": "car", "turning_radius": 1, "wheelbase": 0', "vehicle.wheelbase: expected a length above 0, got 0");
});

test("round shapes are read with their numbers as written: circles, paths with arcs, grown polygons, round holes", () => {
  const words_of = (shape) => scene(`"obstacles": [${shape}]`).words.split(" obstacle ")[1];
  const scene = (fields) => read_scene(`{"robot": ${ROBOT}, ${fields}}`);
  assert.equal(words_of('{"circle": {"center": [3, "1/3"], "radius": 0.30}}'), "circle 3 1/3 0.30");
  assert.equal(
    words_of(
      '{"path": [[0, 0], [1, 0], {"arc": {"to": [1, 2], "center": [1, 1]}}, {"arc": {"to": [0, 0], "through": [-1, 1]}}]}',
    ),
    "path 0 0 1 0 arc 1 2 about 1 1 left arc 0 0 through -1 1",
  );
  assert.equal(
    words_of('{"path": [[1, 0], {"arc": {"to": [-1, 0], "center": [0, 0], "clockwise": true, "conjugate": [0, 1]}}]}'),
    "path 1 0 arc -1 0 about 0 0 right conjugate 0 1",
  );
  assert.equal(words_of(`{"outer": ${ROBOT}, "grown": "1/4"}`), "path 0 0 1 0 0.10 1e-3 grown 1/4");
  const holes = `[${ROBOT}, {"circle": {"center": [0, 0], "radius": 1}}]`;
  assert.equal(
    words_of(`{"circle": {"center": [0, 0], "radius": 9}, "holes": ${holes}}`),
    "circle 0 0 9 path 0 0 1 0 0.10 1e-3 circle 0 0 1",
  );
});

test("curves other than lines and circular arcs are refused with the remedy, other faults with their place", () => {
  const shape = (text, message) => refused(`"workspace": ${text}`, message);
  shape('{"ellipse": {}}', /^workspace\.ellipse: the page takes lines and circular arcs; `cfree convert` with --outer/);
  shape('{"path": [[0, 0], {"spline": []}]}', /^workspace\.path\[1\]\.spline: the page takes/);
  shape(
    '{"path": [[0, 0], {"arc": {"to": [1, 1]}}]}',
    'workspace.path[1].arc: expected "through" or "center", got an object',
  );
  shape('{"path": [{"arc": {}}]}', "workspace.path[0]: expected a list, got an object");
  shape('{"circle": {"center": [0, 0], "radius": 1}, "outer": []}', "workspace: give one of circle, path, outer");
  shape('{"circle": {"centre": [0, 0]}}', 'workspace.circle: unknown key "centre"; give one of center, radius');
});
