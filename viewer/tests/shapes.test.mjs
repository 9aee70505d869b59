import assert from "node:assert/strict";
import { test } from "node:test";
import { Shapes, digits, moved, moved_exactly, number, pose_json, same, snapped } from "../src/shapes.ts";

const RING = '[[0, 0], [1.50, 0], ["1/3", 1e-7]]';
const SOURCE = `{"name": "three", "robot": {"outer": ${RING}}, "obstacles": [{"name": "kite", "outer": ${RING}}], "check": {}}`;
const SQUARE = [
  ["0", "0"],
  ["2", "0"],
  ["2", "2.0"],
];

test("every number is written as it was read, polygons a line each", () => {
  const text = Shapes.of(SOURCE).text();
  assert.match(text, /"robot": \{"outer": \[\[0, 0\], \[1\.50, 0\], \["1\/3", 1e-7\]\]\}/);
  assert.match(text, /"obstacles": \[\n {4}\{"name": "kite"/);
  assert.equal(Shapes.of(text).text(), text);
});

test("rings are replaced, added and removed; the old check goes, names stay", () => {
  const shapes = Shapes.of(SOURCE);
  const changed = shapes.with({ kind: "obstacle", k: 0 }, [SQUARE, SQUARE]);
  assert.deepEqual(changed.rings({ kind: "obstacle", k: 0 }), [SQUARE, SQUARE]);
  assert.match(changed.text(), /"name": "kite"/);
  assert.doesNotMatch(changed.text(), /check/);
  const more = shapes.with({ kind: "obstacle", k: 1 }, [SQUARE]).with({ kind: "workspace", k: 0 }, [SQUARE]);
  assert.deepEqual(
    more.all().map(({ kind, k }) => `${kind} ${k}`),
    ["workspace 0", "obstacle 0", "obstacle 1", "robot 0"],
  );
  const fewer = more.with({ kind: "obstacle", k: 0 }, undefined).with({ kind: "workspace", k: 0 }, undefined);
  assert.deepEqual([fewer.has({ kind: "obstacle", k: 1 }), fewer.has({ kind: "workspace", k: 0 })], [false, false]);
  assert.deepEqual(fewer.rings({ kind: "obstacle", k: 0 }), [SQUARE]);
  assert.match(shapes.text(), /check/);
});

test("start and goal replace those of the file", () => {
  const text = Shapes.of(`{"robot": ${RING}, "goals": [[1, 2, 0]]}`)
    .ending({ goal: pose_json({ x: "1", y: "1/3", tau: "inf" }) })
    .text();
  assert.deepEqual(JSON.parse(text).goal, [1, "1/3", { tau: "inf" }]);
  assert.doesNotMatch(text, /goals/);
});

test("coordinates are moved without losing digits", () => {
  assert.equal(moved("0.1", "0.2"), "0.3");
  assert.equal(moved("-0.05", "0.01"), "-0.04");
  assert.equal(moved("0.25", "-0.25"), "0");
  assert.equal(moved("123456789012345678901234567890.5", "0.5"), "123456789012345678901234567891");
  assert.equal(moved("1/4", "0.5"), "0.75");
});

test("coordinates on the grid are as short as they can be", () => {
  assert.deepEqual([digits(0.01), digits(1), digits(10)], [2, 0, 0]);
  assert.deepEqual(
    [snapped(1.2345, 0.01), snapped(0.999, 0.01), snapped(-0.001, 0.01), snapped(17, 10)],
    ["1.23", "1", "0", "20"],
  );
  assert.deepEqual([number("3/4"), number("-1e3")], [0.75, -1000]);
});

test("two names of a polygon are the same if kind and number are", () => {
  assert.ok(same({ kind: "robot", k: 0 }, { kind: "robot", k: 0 }));
  assert.ok(!same({ kind: "robot", k: 0 }, { kind: "obstacle", k: 0 }));
  assert.ok(!same(undefined, { kind: "robot", k: 0 }));
});

test("a round shape moves as a whole, exactly: centers, ends and points between, not its radius or growth", () => {
  const path = '{"path": [[0, 0], {"arc": {"to": [2, "1/3"], "center": [1, 0.5], "clockwise": true}}], "grown": 0.25}';
  const circle = '{"name": "post", "circle": {"center": [1, "2/3"], "radius": 0.50}}';
  const shapes = Shapes.of(`{"robot": ${RING}, "obstacles": [${path}, ${circle}]}`);
  const [first, second] = [0, 1].map((k) => ({ kind: "obstacle", k }));
  assert.deepEqual([shapes.is_round(first), shapes.rings(second)], [true, []]);
  const text = shapes.moved_by(first, "0.25", "-1").moved_by(second, "-1", "0.5").text();
  assert.match(
    text,
    /\[\[0\.25, -1\], \{"arc": \{"to": \[2\.25, "-2\/3"\], "center": \[1\.25, -0\.5\], "clockwise": true\}\}\]/,
  );
  assert.match(text, /"grown": 0\.25/);
  assert.match(text, /\{"name": "post", "circle": \{"center": \[0, "7\/6"\], "radius": 0\.50\}\}/);
  assert.deepEqual([moved_exactly("1/4", "-0.25"), moved_exactly("0.1", "0.2")], ["0", "0.3"]);
});
