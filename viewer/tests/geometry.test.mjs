import assert from "node:assert/strict";
import { test } from "node:test";
import "./browser.mjs";
import { Vector3 } from "three";
import { on_scale, vertex_colours } from "../src/colours.ts";
import { DepthOrder } from "../src/depth.ts";
import { seen_of } from "../src/session.ts";
import { wrapped } from "../src/space.ts";
import { outline } from "../src/workspace.ts";

const close = (a, b) => assert.ok(Math.abs(a - b) < 1e-12, `${a} is not ${b}`);

test("angles are shown from a quarter turn below zero on", () => {
  close(wrapped(0), 0);
  close(wrapped(-Math.PI), Math.PI);
  close(wrapped(7 * Math.PI), Math.PI);
  close(wrapped(-Math.PI / 2), -Math.PI / 2);
  close(wrapped((3 * Math.PI) / 2), -Math.PI / 2);
});

test("poses in words are places and angles of a drawing", () => {
  assert.deepEqual(seen_of({ x: "1/4", y: "-2", tau: "1" }), { x: 0.25, y: -2, theta: Math.PI / 2 });
  assert.equal(seen_of({ x: "0", y: "0", tau: "inf" }).theta, Math.PI);
});

test("outlines have arcs where a vertex has a radius, also back to the first", () => {
  const half = outline([1, 0, -1, 0], [0, 2], 0, 1, [1, 0]);
  assert.equal(half, "M1 0A1 1 0 0 1 -1 0Z");
  assert.equal(outline([1, 0, -1, 0], [0, 2], 0, 1, [0, -1]), "M1 0L-1 0A1 1 0 0 0 1 0Z");
});

test("rings become closed outlines", () => {
  const path = outline([0, 0, 1, 0, 1, 2, 5, 5, 6, 5, 6, 7], [0, 3, 6]);
  assert.equal(path.match(/M/g).length, 2);
  assert.equal(path.match(/Z/gi).length, 2);
});

test("triangles are drawn from far to near, and the largest alone while something moves", () => {
  const count = 5;
  const position = new Float32Array(9 * count);
  const depths = [2, 0, 4, 1, 3];
  depths.forEach((z, k) => position.set([0, 0, z, 1, 0, z, 0, 1, z], 9 * k));
  const triangles = Uint32Array.from({ length: 3 * count }, (_, k) => k);
  const order = new DepthOrder(triangles, position, 1);
  const drawn = () => Array.from({ length: count }, (_, k) => depths[order.attribute.array[3 * k] / 3]);
  assert.equal(order.sort(new Vector3(0, 0, 1), false), count);
  assert.deepEqual(drawn(), [4, 3, 2, 1, 0]);
  assert.equal(order.sort(new Vector3(0, 0, -1), true), count);
  assert.deepEqual(drawn(), [0, 1, 2, 3, 4]);
});

test("colours follow the scale, the kind of contact, or a number that comes round", () => {
  assert.equal(on_scale(-1).getHexString(), "00224e");
  assert.equal(on_scale(2).getHexString(), "fee838");
  const mesh = {
    kind: Uint8Array.of(0, 1),
    cell: Int32Array.of(-8, 0),
    owner: Int32Array.of(0, 1),
    gaussian: Float64Array.of(-1, 0),
    mean: Float64Array.of(-2, 2),
  };
  const palette = { vertex_edge: "#000000", edge_vertex: "#ffffff" };
  assert.deepEqual([...vertex_colours(mesh, "contact", palette)], [0, 0, 0, 1, 1, 1]);
  const [first, second] = [0, 3].map((k) => vertex_colours(mesh, "cell", palette).slice(k, k + 3));
  assert.deepEqual(first, second);
  for (const by of ["gaussian", "mean"])
    assert.deepEqual(
      [...vertex_colours(mesh, by, palette)],
      [...on_scale(0).toArray(), ...on_scale(1).toArray()].map(Math.fround),
    );
});
