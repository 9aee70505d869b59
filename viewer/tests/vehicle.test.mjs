import assert from "node:assert/strict";
import { test } from "node:test";
import {
  frame_of,
  heading_of,
  is_number,
  is_radius,
  is_vehicle,
  placed,
  record_of,
  seen_from,
  steering,
  track_of,
  usual,
  wheels_of,
  words_of,
} from "../src/vehicle.ts";
import { read_vehicle } from "../src/words.ts";

const CAR = { kind: "car", left: "4", right: "4", x: "-1.3", y: "1/9", tau: "0", gears: "both" };
const near = (a, b) => assert.ok(Math.abs(a - b) < 1e-9, `${a} is not near ${b}`);

test("a vehicle is words for the core, and none in any direction", () => {
  assert.equal(words_of(CAR), "car 4 4 -1.3 1/9 0 both");
  assert.equal(words_of({ ...CAR, right: "5", gears: "forward", tau: "inf" }), "car 4 5 -1.3 1/9 inf forward");
  assert.equal(words_of({ ...CAR, kind: "differential" }), "differential -1.3 1/9 0");
  assert.deepEqual([words_of({ ...CAR, kind: "any" }), words_of(undefined)], ["", ""]);
});

test("numbers are exact texts, radii above 0", () => {
  for (const well of ["0", "-1.3", ".5", "2.", "1/3", "1e-3", "-7/2"]) assert.ok(is_number(well), well);
  for (const bad of ["", "x", "1/0", "1/2/3", "NaN", "Infinity", "1e999", "- 1", 3, undefined])
    assert.ok(!is_number(bad), String(bad));
  assert.deepEqual(["4", "1/3", "0", "-1", "inf"].map(is_radius), [true, true, false, false, false]);
});

test("only whole vehicles are vehicles", () => {
  assert.ok(is_vehicle(CAR) && is_vehicle({ ...CAR, kind: "any", tau: "inf" }));
  for (const bad of [
    null,
    {},
    { ...CAR, left: "0" },
    { ...CAR, kind: "boat" },
    { ...CAR, tau: "<b>" },
    { ...CAR, gears: 1 },
  ])
    assert.ok(!is_vehicle(bad), JSON.stringify(bad));
});

test("files keep what is exact, and what is usual is left out", () => {
  const { left: _, right: __, ...drive } = { ...CAR, kind: "differential" };
  assert.deepEqual(record_of(CAR), { type: "car", turning_radius: "4", axle: ["-1.3", "1/9"] });
  assert.equal(record_of({ ...CAR, kind: "any" }), undefined);
  for (const vehicle of [CAR, { ...CAR, right: "5", tau: "20/7", gears: "forward" }, drive])
    assert.deepEqual(read_vehicle(record_of(vehicle)), vehicle);
});

test("a robot drives along its longer side, its axle a fifth from behind", () => {
  const box = (x0, y0, x1, y1) => [x0, y0, x1, y0, x1, y1, x0, y1];
  const long = usual(box(-2.3, -1.1, 1.9, 1.3));
  assert.deepEqual(long, { kind: "car", left: "4.2", right: "4.2", x: "-1.5", y: "0.1", tau: "0", gears: "both" });
  const high = usual(box(0, 0, 1, 30));
  assert.deepEqual([high.tau, high.x, high.y, high.left], ["1", "1", "6", "30"]);
  assert.ok(is_vehicle(usual(box(0, 0, 1e-7, 1e-7))));
});

test("headings are right angles if they are near, else short", () => {
  const degrees = (theta) => heading_of((theta * Math.PI) / 180);
  assert.deepEqual([0, 3, 90, 181, -92, 358].map(degrees), ["0", "0", "1", "inf", "-1", "0"]);
  for (let theta = -360; theta < 720; theta += 7) {
    const tau = degrees(theta);
    const angle = (frame_of({ ...CAR, tau }).theta * 180) / Math.PI;
    const off = Math.abs(((((angle - theta + 180) % 360) + 360) % 360) - 180);
    assert.ok(tau.length < 7 && off < 6, `${theta}: ${tau}`);
  }
});

test("points go to a frame and back", () => {
  const pose = { x: 3, y: 4, theta: 1 };
  const there = placed({ x: 1, y: 2, theta: 0.5 }, pose);
  const back = seen_from(pose, there);
  near(back.x, 1);
  near(back.y, 2);
  near(there.theta, 1.5);
});

test("the axle's track changes colour and has a dot where the gear changes", () => {
  const samples = [0, 0, 0, 1, 0, 0, 2, 0, 0, 1, 0, 0, 1, 0, 1, 2, 0, 1].map(Number);
  const frame = { x: 0, y: 0, theta: 0 };
  const track = track_of(samples, [1, 1, 1, -1, 0, 1], frame);
  assert.deepEqual(
    track.pieces.map(({ gear, points }) => [gear, points]),
    [
      [1, [0, 0, 1, 0, 2, 0]],
      [-1, [2, 0, 1, 0]],
      [0, [1, 0, 1, 0]],
      [1, [1, 0, 2, 0]],
    ],
  );
  assert.deepEqual(
    track.cusps.map(({ x, y }) => [x, y]),
    [
      [2, 0],
      [1, 0],
    ],
  );
  const moved = track_of([0, 0, Math.PI / 2, 0, 1, Math.PI / 2], [1, 1], { x: -1, y: 0, theta: 0 });
  near(moved.pieces[0].points[1], -1);
});

test("front wheels point across the pole", () => {
  const radius = 5;
  const on_arc = (turn) => ({ x: radius * Math.sin(turn), y: radius * (1 - Math.cos(turn)), theta: turn });
  for (const turn of [0.1, -0.1]) near(steering(on_arc(0), on_arc(turn), 2), Math.atan(2 / radius)); // also backward
  near(
    steering(on_arc(0.3), { ...on_arc(0.3), x: on_arc(0.3).x + Math.cos(0.3), y: on_arc(0.3).y + Math.sin(0.3) }, 2),
    0,
  );
  assert.equal(steering(on_arc(0), { ...on_arc(0), theta: 1 }, 2), undefined);
});

test("wheels are within the outline, those in front only of a car", () => {
  const robot = [-1, -0.9, 3.5, -0.9, 3.5, 0.9, -1, 0.9];
  const wheels = wheels_of({ ...CAR, x: "0", y: "0" }, robot);
  assert.ok(wheels.half_track < 0.9 && wheels.wheelbase > 2 && wheels.wheelbase < 3.5);
  assert.equal(wheels_of({ ...CAR, kind: "differential" }, robot).wheelbase, 0);
  const long = { ...CAR, wheelbase: "2.70" };
  assert.deepEqual([wheels_of(long, robot).wheelbase, record_of(long).wheelbase], [2.7, "2.70"]);
  assert.ok(wheels_of({ ...CAR, y: "5" }, robot).half_track > 0); // an axle beside the robot
});
