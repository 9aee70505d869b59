import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { PointerElement, pointer } from "./browser.mjs";
import { Pointers } from "../src/pointers.ts";

let element;
let pointers;
let told;

const follower = (name) => ({
  move: ({ clientX }) => told.push(`${name} at ${clientX}`),
  end: () => told.push(`${name} ends`),
  cancel: () => told.push(`${name} cancelled`),
});
const press = (id, fields) => pointer(element, "pointerdown", id, fields);
const move = (id, clientX) => pointer(window, "pointermove", id, { clientX });
const lift = (id) => pointer(window, "pointerup", id);
const drag = (id) => {
  press(id);
  pointers.follow({ pointerId: id, target: element }, follower(`drag ${id}`));
};

beforeEach(() => {
  globalThis.window = new EventTarget();
  element = new PointerElement();
  told = [];
  pointers = new Pointers(element, (a, b) => {
    told.push(`pinch from ${a.clientX} and ${b.clientX}`);
    return {
      move: (p, q) => told.push(`pinch at ${p.clientX} and ${q.clientX}`),
      cancel: () => told.push("pinch cancelled"),
    };
  });
});

test("one pointer drags until it is lifted; others are not followed", () => {
  drag(1);
  move(1, 3);
  move(7, 9);
  lift(1);
  move(1, 4);
  assert.deepEqual(told, ["drag 1 at 3", "drag 1 ends"]);
  assert.deepEqual(element.captured, [1]);
});

test("a drag that the browser cancels is cancelled once", () => {
  drag(1);
  pointer(window, "pointercancel", 1);
  pointer(window, "pointercancel", 1);
  assert.deepEqual(told, ["drag 1 cancelled"]);
});

test("a second finger cancels the drag, and the two pinch", () => {
  drag(1);
  move(1, 10);
  const second = press(2, { clientX: 30 });
  assert.ok(second.defaultPrevented);
  move(2, 50);
  move(1, 5);
  lift(2);
  move(1, 6);
  assert.deepEqual(told, [
    "drag 1 at 10",
    "drag 1 cancelled",
    "pinch from 10 and 30",
    "pinch at 10 and 50",
    "pinch at 5 and 50",
  ]);
});

test("a third finger changes nothing", () => {
  drag(1);
  press(2);
  const before = told.length;
  const third = press(3, { clientX: 99 });
  move(3, 98);
  assert.ok(third.defaultPrevented);
  assert.equal(told.length, before);
  move(2, 4);
  assert.equal(told.at(-1), "pinch at 0 and 4");
});

test("a pinch that the browser cancels is cancelled", () => {
  drag(1);
  press(2);
  pointer(window, "pointercancel", 2);
  assert.equal(told.at(-1), "pinch cancelled");
});

test("a primary finger forgets those whose end was not told; a mouse does not pinch", () => {
  press(1);
  press(1);
  assert.deepEqual(told, []);
  press(2, { pointerType: "mouse" });
  assert.deepEqual(told, []);
});
