import assert from "node:assert/strict";
import { test } from "node:test";
import { History, fragment, from_fragment, from_words, words } from "../src/state.ts";

const POSE = { x: "1/3", y: "-0.25", tau: "inf" };
const state = (source, more = {}) => ({ source, robot: POSE, ...more });
const nothing = () => undefined;

test("poses are written as words and read back", () => {
  assert.equal(words(POSE), "1/3 -0.25 inf");
  assert.deepEqual(from_words(" 1/3 -0.25 inf\n"), POSE);
});

test("undo and redo go back and forth, a new state ends what could be redone", () => {
  const history = new History(state("a"));
  history.push(state("b"));
  history.push(state("b"));
  history.push(state("c"));
  assert.equal(history.undo().source, "b");
  assert.equal(history.undo().source, "a");
  assert.equal(history.undo(), undefined);
  assert.deepEqual([history.can_undo, history.can_redo], [false, true]);
  assert.equal(history.redo().source, "b");
  history.push(state("d"));
  assert.deepEqual([history.now.source, history.can_redo], ["d", false]);
  assert.equal(history.undo().source, "b");
});

test("the last 200 states are kept", () => {
  const history = new History(state("0"));
  for (let k = 1; k <= 250; ++k) history.push(state(String(k)));
  let count = 0;
  while (history.undo()) ++count;
  assert.deepEqual([count, history.now.source], [200, "50"]);
});

test("a link holds the state, and the scene of the gallery by its name", async () => {
  const own = state('{"robot": []}', { start: POSE, opened: 3 });
  const { opened: _, ...kept } = own;
  assert.deepEqual(await from_fragment(await fragment(own), nothing), kept);
  const link = await fragment(state("long text", { gallery: "maze" }));
  const text_of = (name) => (name === "maze" ? "text of the maze" : undefined);
  assert.equal((await from_fragment(link, text_of)).source, "text of the maze");
});

test("a link that would be too long is none, and foreign fragments are no states", async () => {
  const random = Array.from({ length: 20_000 }, (_, k) => Math.sin(k + 1)).join(",");
  assert.equal(await fragment(state(random)), undefined);
  assert.equal(await from_fragment("#top", nothing), undefined);
  const bad = await fragment(state("{}", { start: { ...POSE, x: "<b>" } }));
  assert.equal(await from_fragment(bad, nothing), undefined);
});

test("a link keeps the vehicle, and how the robot moves; a vehicle that is none makes no state", async () => {
  const vehicle = { kind: "any", left: "4", right: "4", x: "-1.3", y: "1/9", tau: "0", gears: "both" };
  const read = async (of) => from_fragment(await fragment(state("{}", { vehicle: of })), nothing);
  for (const kind of ["any", "car", "differential"])
    assert.deepEqual((await read({ ...vehicle, kind })).vehicle, { ...vehicle, kind });
  assert.equal(await read({ ...vehicle, left: "0" }), undefined);
});
