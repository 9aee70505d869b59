import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { setTimeout as pause } from "node:timers/promises";
import "./browser.mjs";
import { Cancelled, Engine } from "../src/engine.ts";

let workers;

class FakeWorker {
  asked = [];
  terminated = false;
  constructor() {
    workers.push(this);
  }
  postMessage(message) {
    this.asked.push(message);
  }
  terminate() {
    this.terminated = true;
  }
  names() {
    return this.asked.map(({ name, args }) => (name === "start" ? name : [name, ...args].join(" ")));
  }
  answer(name, reply) {
    const { id } = this.asked.find(
      (message) => message.name === name && !message.answered && (message.answered = true),
    );
    this.onmessage({ data: { id, ...reply } });
  }
}
globalThis.Worker = FakeWorker;

async function asked(count) {
  for (let k = 0; k < 200; ++k) {
    const worker = workers.at(-1);
    if (worker && worker.asked.length >= count) return worker;
    await pause(5);
  }
  throw new Error(`fewer than ${count} calls: ${workers.at(-1)?.names()}`);
}

beforeEach(() => {
  workers = [];
});

test("calls wait for the core, and each gets its own answer or fault", async () => {
  const engine = new Engine();
  const first = engine.call("pose", "1 2 0");
  const second = engine.call("cells");
  const worker = await asked(3);
  assert.deepEqual(worker.names(), ["start", "pose 1 2 0", "cells"]);
  assert.ok(engine.busy);
  worker.answer("cells", { columns: { count: "two" } });
  worker.answer("pose", { fault: "no scene" });
  assert.deepEqual(await second, { count: "two" });
  await assert.rejects(first, { message: "no scene" });
});

test("of questions that wait for the same answer only the newest is asked", async () => {
  const engine = new Engine();
  const first = engine.newest("slice", 1);
  const second = assert.rejects(engine.newest("slice", 2), Cancelled);
  const third = engine.newest("slice", 3);
  const worker = await asked(2);
  await second;
  assert.deepEqual(worker.names(), ["start", "slice 1"]);
  worker.answer("slice", { columns: { of: "1" } });
  assert.deepEqual(await first, { of: "1" });
  await asked(3);
  worker.answer("slice", { columns: { of: "3" } });
  assert.deepEqual(await third, { of: "3" });
});

test("an end cancels all that waits and drops late answers; the next call has a new worker", async () => {
  const engine = new Engine();
  const call = engine.call("boundary");
  const worker = await asked(2);
  engine.end();
  await assert.rejects(call, Cancelled);
  assert.deepEqual([worker.terminated, engine.busy], [true, false]);
  worker.answer("boundary", { columns: {} });
  void engine.call("boundary").catch(() => {});
  await asked(2);
  assert.equal(workers.length, 2);
});

test("a scene is opened once for several questions; a fault leaves the last one open", async () => {
  const engine = new Engine();
  const opened = engine.of("a scene");
  (await asked(2)).answer("open", { columns: {} });
  assert.equal(await opened, engine);
  assert.equal(await engine.of("a scene"), engine);
  assert.deepEqual(workers[0].names(), ["start", "open a scene"]);
  const broken = engine.open("no scene");
  (await asked(3)).answer("open", { fault: "line 1" });
  await assert.rejects(broken, { message: "line 1" });
  assert.equal(await engine.of("a scene"), engine);
  assert.equal(workers[0].asked.length, 3);
});

test("the share of the work that is done is passed on", async () => {
  const shares = [];
  const engine = new Engine((share) => shares.push(share));
  void engine.call("boundary");
  (await asked(2)).onmessage({ data: { share: 0.25 } });
  assert.deepEqual(shares, [0.25]);
});
