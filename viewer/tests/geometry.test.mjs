import assert from "node:assert/strict";
import { test } from "node:test";
import "./browser.mjs";
import { Vector3 } from "three";
import { LEGENDS, on_scale, vertex_colours } from "../src/colours.ts";
import { DepthOrder } from "../src/depth.ts";
import { coloured, entries } from "../src/legend.ts";
import { seen_of } from "../src/session.ts";
import { wrapped } from "../src/space.ts";
import { along_arc, corners_of, outline } from "../src/outlines.ts";

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

test("slices lose the points of chords, and their arcs have radii", () => {
  const { xy, ring, bend } = corners_of([1, 0, 0.7, 0.7, 0, 1, -1, 0], [0, 4], [1, -1e300, 0, 0]);
  assert.deepEqual(
    [xy, ring, bend],
    [
      [1, 0, 0, 1, -1, 0],
      [0, 3],
      [1, 0, 0],
    ],
  );
  assert.equal(outline(xy, ring, 0, undefined, bend), "M1 0A1 1 0 0 1 0 1L-1 0Z");
  assert.deepEqual(corners_of([0, 0, 1, 0, 1, 1], [0, 3], []).bend, [0, 0, 0]);
});

test("points along an arc are on its circle, in small steps to the right of the chord", () => {
  const points = along_arc([3, 1, 1, 3], 2);
  assert.deepEqual(
    [points[0], points.at(-1)],
    [
      [3, 1],
      [1, 3],
    ],
  );
  for (const [x, y] of points) close(Math.hypot(x - 1, y - 1), 2);
  for (let k = 1; k < points.length; ++k)
    assert.ok(Math.hypot(points[k][0] - points[k - 1][0], points[k][1] - points[k - 1][1]) < 0.11);
  assert.deepEqual(along_arc([0, 0, 3, 4], 0), [
    [0, 0],
    [3, 4],
  ]);
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
  const palette = { vertex_edge: "#000000", edge_vertex: "#ffffff", arc_arc: "#ff0000" };
  assert.deepEqual([...vertex_colours(mesh, "contact", palette)], [0, 0, 0, 1, 1, 1]);
  const [first, second] = [0, 3].map((k) => vertex_colours(mesh, "cell", palette).slice(k, k + 3));
  assert.deepEqual(first, second);
  for (const by of ["gaussian", "mean"])
    assert.deepEqual(
      [...vertex_colours(mesh, by, palette)],
      [...on_scale(0).toArray(), ...on_scale(1).toArray()].map(Math.fround),
    );
});

test("patches of an arc on an arc have a colour, and a scale of K to both sides", () => {
  const mesh = {
    kind: Uint8Array.of(2, 0, 2),
    cell: Int32Array.of(0, 0, 0),
    owner: Int32Array.of(0, 0, 0),
    gaussian: Float64Array.of(1.5, 0, -1),
    mean: Float64Array.of(-2, 0, 1),
  };
  const palette = { vertex_edge: "#000000", edge_vertex: "#ffffff", arc_arc: "#ff0000" };
  assert.deepEqual([...vertex_colours(mesh, "contact", palette)], [1, 0, 0, 0, 0, 0, 1, 0, 0]);
  assert.deepEqual(
    [...vertex_colours(mesh, "gaussian", palette)],
    [1, 0.5, 0].flatMap((share) => on_scale(share).toArray()).map(Math.fround),
  );
  assert.match(LEGENDS(true).gaussian, /-1 or less .*, 0, 1 or more/);
  assert.match(LEGENDS(false).gaussian, /-1 \(dark\) to 0/);
});

test("the legend has the patches and lines of rounded shapes that are there", () => {
  const told = (kind, grown, lines, owner = kind.map(() => 0)) =>
    entries({
      kind: Uint8Array.from(kind),
      ...(grown && { grown: Uint8Array.from(grown) }),
      line_kind: Uint8Array.from(lines),
      owner: Int32Array.from(owner),
    }).map(({ mark, text }) => `${mark}: ${text}`);
  const polygons = ["ve: vertex on edge", "ev: edge on vertex", "he: helix", "se: edge on edge"];
  assert.deepEqual(told([0], undefined, []), polygons);
  assert.deepEqual(told([0, 1, 1, 2, 2], [1, 1, 3, 1, 3], [0, 3, 2]), [
    "ve: arc on edge",
    "ev: edge on arc or vertex",
    "aa: arc on arc or vertex",
    "he: smooth joint",
    "se: edge on edge",
  ]);
  assert.deepEqual(told([0, 1, 2], [0, 2, 2], []), ["ve: vertex on edge", "ev: edge on arc", "aa: vertex on arc"]);
  assert.deepEqual(told([0, 2, 0], [1, 1, 0], [1, 3], [0, 0, -1]), [
    "ve: arc on edge",
    "aa: arc on vertex",
    "he: helix, smooth joint",
  ]);
  assert.deepEqual(told([2, 0], [3, 0], [], [0, -1]), ["aa: arc on arc"]);
});

test("the legend has the colours of cells and obstacles, the lines, and the surface of a proof", () => {
  const mesh = {
    kind: Uint8Array.of(0, 0, 1, 0),
    cell: Int32Array.of(0, 9, 0, -1),
    owner: Int32Array.of(1, 0, -2, 1),
    mean: Float64Array.of(-2, 0, 1, 0),
  };
  const told = (by, has_proof = false) =>
    coloured(mesh, by, ["kite", "obstacle 1"], has_proof).map(({ text, colour }) => [text, colour].join(" ").trim());
  assert.deepEqual(told("cell"), ["cell 0 #0072b2", "cell 9 #e69f00", "no cell #b2a13c", "helix", "edge on edge"]);
  assert.deepEqual(told("obstacle"), [
    "obstacle 0 (kite) #0072b2",
    "obstacle 1 #e69f00",
    "the workspace #8a7bd1",
    "helix",
    "edge on edge",
  ]);
  assert.deepEqual(told("mean", true), ["helix", "edge on edge", "separates start and goal"]);
  mesh.cell = Int32Array.from({ length: 12 }, (_, k) => k);
  assert.equal(told("cell")[8], "4 more in these colours transparent");
});
