// The page: what is asked of the core when something moves, and where its answers go.
import { Cancelled, Engine, type Columns, doubles, integers, string, value } from "./engine";
import { Space, wrapped, type ColourBy, type Palette } from "./space";
import { History, from_fragment, from_words, fragment, words, type PoseText, type State } from "./state";
import { contact_words, degrees, obstacle_name, pose_verdict, way_verdict, type Verdict } from "./verdict";
import { Workspace, type Drag, type Seen, type Who } from "./workspace";
import type { FilePose, SceneText } from "./words";

const $ = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;
const json = (id: string) => JSON.parse($(id).textContent!);
const gallery: { name: string; title: string; text: string }[] = json("gallery");
const in_gallery = (name: string) => gallery.find((of) => of.name === name)?.text;

const palette = (): Palette => {
  const of = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  return { vertex_edge: of("ve"), edge_vertex: of("ev"), helix: of("helix"), segment: of("segment"), ink: of("ink"), faint: of("soft"),
    path: of("path"), good: of("good"), bad: of("bad"), accent: of("accent"), barrier: of("barrier") };
};

const workspace = new Workspace($("workspace"));
let space: Space | undefined;
try {
  space = new Space($("space"), palette());
} catch {
  $("picked").hidden = false, ($("picked").textContent = "This browser shows no WebGL: the workspace, slices and verdicts still work.");
}

const engine = new Engine((share) => { $<HTMLProgressElement>("share-done").value = share; });  // boundary, slices, poses
const planner = new Engine();                                                                  // ways
let history: History;
let file: Omit<SceneText, "words">;
let scene: Columns | undefined;
let seen: { robot?: Seen; start?: Seen; goal?: Seen } = {};
let is_built = false, is_meshing = false;
let last_way: Columns | undefined;
let last_free: PoseText | undefined;
let path: Float64Array | undefined;
let playing: { frame: number; began: number } | undefined;

function say(id: "pose" | "way", verdict: Verdict): void {
  const element = $(id);
  if (element.textContent !== verdict.text) element.textContent = verdict.text;
  element.dataset.tone = verdict.tone, element.classList.remove("old");
}
const fault = (id: "pose" | "way", error: unknown) => {
  if (!(error instanceof Cancelled)) say(id, { tone: "bad", text: error instanceof Error ? error.message : String(error) });
};
function working(is: boolean): void {
  $("share-done").hidden = $("stop").hidden = !is;
}

const decimal = (c: number, step: number) => c.toFixed(Math.min(20, Math.max(0, -Math.round(Math.log10(step)))));
async function tau_of(theta: number, fine = false): Promise<string> {
  return string(await engine.call("angle", theta, fine ? 1 : 0), "tau");
}
async function text_of(pose: FilePose, otherwise = "0"): Promise<PoseText> {
  return { x: pose.x, y: pose.y, tau: pose.tau ?? (pose.theta === undefined ? otherwise : await tau_of(pose.theta, true)) };
}
const number = (text: string) => { const [p, q] = text.split("/"); return Number(p) / Number(q ?? 1); };
const seen_of = (pose: PoseText): Seen => ({ x: number(pose.x), y: number(pose.y), theta: pose.tau === "inf" ? Math.PI : 2 * Math.atan(number(pose.tau)) });

// A scene's text: read, shown, its boundary computed while ways are looked for.
async function open(source: string, of?: Partial<State>): Promise<void> {
  stop_playing();
  const was_busy = engine.busy;
  if (was_busy) engine.cancel();
  try {
    const read = await engine.open(source);
    is_built = false, path = undefined, last_way = undefined, opened_source = source;
    planner.cancel();
    say("way", { tone: "plain", text: "" });
    void planner.open(source).catch(() => {});
    const found: SceneText = JSON.parse(string(read, "file"));
    const start = of?.start ?? (found.start && await text_of(found.start));
    const goal = of?.goal ?? (found.goal && await text_of(found.goal, start?.tau));  // a place: as the start is turned
    const box = box_of(read);
    const robot = of?.robot ?? start ?? { x: decimal((box[0] + box[2]) / 2, 0.01), y: decimal((box[1] + box[3]) / 2, 0.01), tau: "0" };
    file = found, scene = read;
    const state: State = { source, robot, ...(start && { start }), ...(goal && { goal }), ...(of?.gallery && { gallery: of.gallery }) };
    if (history) history.push(state); else history = new History(state);
    show(state, box);
  } catch (error) {
    fault("pose", error);
    if (!was_busy || !scene) return;  // else what was stopped for it begins anew
  }
  await build();
}

function box_of(read: Columns): [number, number, number, number] {
  const bounds = doubles(read, "bounds");
  if (bounds.length) return [...bounds] as [number, number, number, number];
  const radius = value(read, "radius"), xy = doubles(read, doubles(read, "workspace.xy").length ? "workspace.xy" : "obstacles.xy");
  const box: [number, number, number, number] = xy.length ? [Infinity, Infinity, -Infinity, -Infinity] : [-2 * radius, -2 * radius, 2 * radius, 2 * radius];
  for (let k = 0; k < xy.length; k += 2)
    box[0] = Math.min(box[0], xy[k]! - radius), box[1] = Math.min(box[1], xy[k + 1]! - radius), box[2] = Math.max(box[2], xy[k]! + radius), box[3] = Math.max(box[3], xy[k + 1]! + radius);
  return box;
}

function show(state: State, box: [number, number, number, number]): void {
  seen = { robot: seen_of(state.robot), ...(state.start && { start: seen_of(state.start) }), ...(state.goal && { goal: seen_of(state.goal) }) };
  document.title = `${file.name || "scene"}: cfree`;
  workspace.show_scene(scene!, file.names, Object.values(seen) as Seen[]);
  workspace.show_slice(undefined);
  space?.show_scene(box, value(scene!, "radius"));
  $<HTMLSelectElement>("scenes").value = state.gallery ?? "";
  $("facts").textContent = "";
  $("picked").hidden = true;
  last_free = undefined;
  for (const who of ["start", "goal"] as const) place(who);
  set_slider(seen.robot!.theta);
  void ask_robot(state.robot);
  void ask_way();
}

function place(who: Who, tone = ""): void {
  workspace.place(who, seen[who], tone);
  if (who === "start") space?.place_end(0, seen.start);
  if (who === "goal") space?.place_end(1, seen.goal);
}

async function build(): Promise<void> {
  const began = performance.now();
  working(true);
  try {
    const counts = await engine.call("boundary");
    is_built = true;
    const seconds = (performance.now() - began) / 1000;
    $("facts").textContent = `${value(counts, "trapezoids").toLocaleString("en")} trapezoids · ${value(counts, "cells")} ${value(counts, "cells") === 1 ? "cell" : "cells"} · ${seconds.toFixed(2)} s`;
    void ask_slice();
    void ask_robot(history.now.robot);
    is_meshing = true;
    if (space) space.show_mesh(await engine.call("mesh", value(scene!, "radius") / 60, 60_000));
    is_meshing = false;
    if (last_way) show_way(last_way);
    void ask_robot(history.now.robot);
    document.body.dataset.ready = history.now.gallery ?? file.name;
  } catch (error) {
    if (error instanceof Cancelled) { if (!is_built) $("facts").textContent = "stopped: no boundary"; }
    else fault("pose", error);
  } finally {
    is_meshing = false;
    working(false);
  }
}

function set_slider(theta: number): void {
  const at = wrapped(theta);
  $<HTMLInputElement>("theta").value = String(at * 180 / Math.PI), ($("degrees").textContent = degrees(at));
  space?.set_theta(theta);
}

async function ask_slice(): Promise<void> {
  if (!is_built || !seen.robot) return;
  try {
    const slice = await engine.newest("slice", seen.robot.theta);
    workspace.show_slice(slice), space?.show_slice(slice);
  } catch (error) { fault("pose", error); }
}

// Where the robot is: verdict, touching pairs, cells.
async function ask_robot(pose: PoseText): Promise<boolean | undefined> {
  const asked = (is_built || !engine.busy) && !is_meshing ? engine : planner;
  try {
    const answer = await asked.newest("pose", words(pose));
    const [x, y, theta] = doubles(answer, "place") as unknown as [number, number, number];
    seen.robot = { x, y, theta };
    const is_free = value(answer, "free") === 1, verdict = pose_verdict(answer, file.names);
    workspace.place("robot", seen.robot, verdict.tone), space?.place(seen.robot, is_free);
    workspace.show_contacts(is_free ? answer : undefined, "touching", seen.robot);
    const cells = integers(answer, "cells");
    if (verdict.tone === "good" && cells.length) verdict.text = `Free, in cell ${cells[0]}.`;
    say("pose", verdict);
    return is_free;
  } catch (error) { fault("pose", error); return undefined; }
}

async function ask_way(): Promise<void> {
  const { start, goal } = history.now;
  if (!start || !goal) return say("way", { tone: "plain", text: start || goal ? "" : "No start and goal in this scene." });
  $("way").classList.add("old");
  const slow = setTimeout(() => { working(true), say("way", { tone: "plain", text: "Looking for a motion …" }); }, 400);
  try {
    show_way(await planner.newest("plan", words(start), words(goal)));
  } catch (error) {
    if (!(error instanceof Cancelled)) show_way(undefined), fault("way", error);
  } finally {
    clearTimeout(slow);
    if (is_built) working(false);
  }
}

function show_way(answer: Columns | undefined): void {
  last_way = answer;
  const verdict = answer && string(answer, "verdict");
  path = verdict === "path" ? doubles(answer!, "samples") : undefined;
  if (answer) say("way", way_verdict(answer, file.names, file.units));
  const shown = $<HTMLInputElement>("sweep").checked ? path : undefined;
  workspace.show_path(shown), space?.show_path(shown);
  space?.show_barrier(verdict === "apart" ? answer : undefined);
  $<HTMLButtonElement>("play").disabled = !path;
}

let dragged: Drag | undefined, is_dragging = false;
workspace.on_drag = (drag) => { dragged = drag; if (!is_dragging) void follow(); };
async function follow(): Promise<void> {
  is_dragging = true;
  for (let drag; (drag = dragged); ) {
    dragged = undefined;
    try { await moved(drag); } catch (error) { fault("pose", error); }
  }
  is_dragging = false;
}

async function moved(drag: Drag): Promise<void> {
  stop_playing();
  const now = history.now[drag.who]!;
  const wanted: PoseText = { x: decimal(drag.x, drag.step), y: decimal(drag.y, drag.step), tau: drag.theta === undefined ? now.tau : await tau_of(drag.theta) };
  if (drag.theta !== undefined) wanted.x = now.x, wanted.y = now.y;
  if (drag.who !== "robot") {
    seen[drag.who] = seen_of(wanted);
    place(drag.who);
    keep({ ...history.now, [drag.who]: wanted }, drag.done);
    return ask_way();
  }
  const is_free = await ask_robot(wanted);
  let reached = wanted;
  if (is_free) last_free = wanted;
  else if (is_free === false && last_free && last_free.tau === wanted.tau && drag.theta === undefined && is_built) {
    const stop = from_words(string(await engine.call("stop", words(last_free), words(wanted)), "pose")), at = seen_of(stop);
    if (Math.hypot(at.x - drag.x, at.y - drag.y) < 11 * workspace.pixel) reached = stop, await ask_robot(stop);  // in contact, exactly
  }
  if (drag.theta !== undefined) set_slider(seen.robot!.theta), void ask_slice();
  keep({ ...history.now, robot: reached }, drag.done);
}

let before: State | undefined;
// A state on the way of a drag; with its end it can be undone.
function keep(state: State, done: boolean): void {
  before ??= history.now;
  history.now = state;
  if (!done) return;
  history.now = before, (before = undefined);
  history.push(state);
  remember();
}

let due = 0;
function remember(): void {
  $<HTMLButtonElement>("undo").disabled = !history.can_undo, ($<HTMLButtonElement>("redo").disabled = !history.can_redo);
  clearTimeout(due);
  due = window.setTimeout(async () => {
    const hash = await fragment(history.now);
    try { window.history.replaceState(null, "", hash ?? "#"); } catch { /* a frame without an address */ }
  }, 300);
}

async function restore(state: State | undefined): Promise<void> {
  if (!state) return;
  if (state.source !== current_source()) {
    const kept = history;
    await reopen(state, kept);
  } else {
    seen = { robot: seen_of(state.robot), ...(state.start && { start: seen_of(state.start) }), ...(state.goal && { goal: seen_of(state.goal) }) };
    for (const who of ["start", "goal"] as const) place(who);
    set_slider(seen.robot!.theta);
    void ask_robot(state.robot), void ask_slice(), void ask_way();
  }
  remember();
}
let opened_source = "";
const current_source = () => opened_source;
async function reopen(state: State, kept: History): Promise<void> {
  const box_read = await engine.open(state.source);
  opened_source = state.source;
  void planner.open(state.source).catch(() => {});
  file = JSON.parse(string(box_read, "file")), (scene = box_read), (is_built = false);
  history = kept;
  show(state, box_of(box_read));
  await build();
}
async function choose(source: string, of?: Partial<State>): Promise<void> {
  await open(source, of);
  if (history) remember();
}

const turned = (done: boolean) => {
  stop_playing();
  const theta = Number($<HTMLInputElement>("theta").value) * Math.PI / 180;
  $("degrees").textContent = degrees(theta), space?.set_theta(theta);
  if (!seen.robot) return;
  seen.robot = { ...seen.robot, theta }, workspace.place("robot", seen.robot);
  dragged = { who: "robot", x: seen.robot.x, y: seen.robot.y, theta, step: workspace.step, done };
  if (!is_dragging) void follow();
};
$("theta").addEventListener("input", () => turned(false));
$("theta").addEventListener("change", () => turned(true));

function stop_playing(): void {
  if (playing) cancelAnimationFrame(playing.frame), (playing = undefined), ($("play").textContent = "▶ Play");
}
function play(): void {
  if (playing) return stop_playing();
  if (!path) return;
  const samples = path, count = samples.length / 3, duration = Math.max(2500, Math.min(14_000, 22 * count));
  $("play").textContent = "❚❚ Pause";
  const frame = (now: number) => {
    if (!playing) return;
    const share = Math.min((now - playing.began) / duration, 1), at = share * (count - 1), k = Math.min(Math.floor(at), count - 2), u = at - k;
    const c = (i: number) => samples[3 * k + i]! * (1 - u) + samples[3 * k + 3 + i]! * u;
    seen.robot = { x: c(0), y: c(1), theta: c(2) };
    workspace.place("robot", seen.robot, "good"), space?.place(seen.robot, true), set_slider(seen.robot.theta);
    void ask_slice();
    if (share < 1) playing.frame = requestAnimationFrame(frame);
    else stop_playing(), keep({ ...history.now, robot: history.now.goal! }, true), void ask_robot(history.now.robot);
  };
  workspace.show_contacts(undefined, "", { x: 0, y: 0, theta: 0 });
  say("pose", { tone: "good", text: "On the path: free all the way." });
  playing = { frame: requestAnimationFrame(frame), began: performance.now() };
}

if (space) space.on_pick = async (face, x, y, theta) => {
  if (!is_built) return;
  const found = await engine.call("picked", face, x, y, theta), range = doubles(found, "range"), pose = from_words(string(found, "pose"));
  const low = range.reduce((a, b) => Math.min(a, b), Infinity), high = range.reduce((a, b) => Math.max(a, b), -Infinity), at = seen_of(pose);
  $("picked").hidden = false;
  $("picked").textContent = `${contact_words(found, "contact", 0, file.names)}\nS(t, φ) at t = ${value(found, "t").toFixed(3)}, φ = ${degrees(theta)}: (${at.x.toFixed(3)}, ${at.y.toFixed(3)})\nleft of it: φ from ${degrees(low)} to ${degrees(high)}; bounds cell ${value(found, "cell")}`;
  keep({ ...history.now, robot: pose }, true);
  set_slider(at.theta);
  await ask_robot(pose);
  void ask_slice();
};

function save_scene(): void {
  const { source, start, goal } = history.now;
  const pose = (of: PoseText) => `[${[of.x, of.y].map((c) => c.includes("/") ? JSON.stringify(c) : String(c)).join(", ")}, {"tau": ${JSON.stringify(of.tau)}}]`;
  let text = source;
  for (const [name, of] of [["start", start], ["goal", goal]] as const) {
    if (!of) continue;
    const key = new RegExp(`"${name}"\\s*:\\s*\\[(?:[^\\[\\]]|\\{[^}]*\\})*\\]`);
    text = key.test(text) ? text.replace(key, () => `"${name}": ${pose(of)}`) : text.replace(/\}\s*$/, () => `,\n  "${name}": ${pose(of)}\n}\n`);
  }
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type: "application/json" }));
  link.download = `${(file.name || "scene").replace(/[^-\w]+/g, "_")}.json`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

async function open_file(of: File | undefined): Promise<void> {
  if (!of) return;
  if (of.size > 16 << 20) return say("pose", { tone: "bad", text: `${obstacle_name([], 0) && of.name.slice(0, 80)}: ${(of.size / 1e6).toFixed(0)} MB; this page reads 16.` });
  await choose(await of.text());
}

async function share(): Promise<void> {
  const hash = await fragment(history.now);
  if (!hash) return say("way", { tone: "plain", text: "This scene is too long for a link: save the file." });
  window.history.replaceState(null, "", hash);
  try { await navigator.clipboard.writeText(location.href); say("way", { tone: "good", text: "The link is copied." }); } catch { say("way", { tone: "plain", text: "The link is in the address bar." }); }
}

function stop(): void {
  stop_playing();
  if (!is_built) engine.cancel();
  if (planner.busy) planner.cancel(), say("way", { tone: "plain", text: "Stopped." });
  working(false);
}

const actions: Record<string, () => void> = {
  open: () => $("file").click(), save: save_scene, share: () => void share(), undo: () => void restore(history.undo()), redo: () => void restore(history.redo()),
  help: () => $<HTMLDialogElement>("keys").showModal(), play, stop,
};
for (const [id, action] of Object.entries(actions)) $(id).addEventListener("click", action);
$<HTMLInputElement>("file").addEventListener("change", (event) => void open_file((event.target as HTMLInputElement).files?.[0]));
$("colour").addEventListener("change", () => space?.colour($<HTMLSelectElement>("colour").value as ColourBy));
$("solid").addEventListener("change", () => space?.solid($<HTMLInputElement>("solid").checked));
$("cut").addEventListener("change", () => space?.cut($<HTMLInputElement>("cut").checked));
$("sweep").addEventListener("change", () => { const shown = $<HTMLInputElement>("sweep").checked ? path : undefined; workspace.show_path(shown), space?.show_path(shown); });
document.addEventListener("dragover", (event) => { event.preventDefault(), document.body.classList.add("dropping"); });
document.addEventListener("dragleave", () => document.body.classList.remove("dropping"));
document.addEventListener("drop", (event) => { event.preventDefault(), document.body.classList.remove("dropping"), void open_file(event.dataTransfer?.files[0]); });
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => space?.repaint(palette()));

document.addEventListener("keydown", (event) => {
  if (event.key === "Escape") return stop();
  const key = event.key.toLowerCase();
  if (event.ctrlKey || event.metaKey) {
    const id = { z: event.shiftKey ? "redo" : "undo", y: "redo", o: "open", s: "save" }[key];
    if (id) event.preventDefault(), actions[id]!();
    return;
  }
  const focus = document.activeElement;
  if (!focus?.closest(".view")) return;
  const toggle = (id: string) => { $<HTMLInputElement>(id).click(); };
  const colour = (k: number) => { const of = $<HTMLSelectElement>("colour"); of.selectedIndex = k, of.dispatchEvent(new Event("change")); };
  const slide = (by: number) => { const of = $<HTMLInputElement>("theta"); of.value = String(Number(of.value) + by), turned(true); };
  const keys: Record<string, () => void> = { " ": play, x: () => toggle("cut"), f: () => { workspace.fit(), space?.home(); }, "?": actions.help!, ",": () => slide(-1), ".": () => slide(1), 1: () => colour(0), 2: () => colour(1), 3: () => colour(2) };
  if (keys[key]) event.preventDefault(), keys[key]!();
});

const scenes = $<HTMLSelectElement>("scenes");
const option = (of: { value: string; text: string }) => scenes.append(Object.assign(document.createElement("option"), of));
for (const { name, title } of gallery) option({ value: name, text: title });
option({ value: "", text: "Own scene" });
scenes.addEventListener("change", () => { if (scenes.value) void choose(in_gallery(scenes.value)!, { gallery: scenes.value }); });

async function begin(): Promise<void> {
  const given: { scene: string; start?: PoseText; goal?: PoseText; poses?: string } | null = json("given");
  if (given) {
    const { scene: source, poses, ...ends } = given;
    await choose(source, ends);
    if (poses) show_way(await planner.call("walk", poses));
    return;
  }
  const linked = await from_fragment(location.hash, in_gallery).catch(() => undefined);
  await (linked ? choose(linked.source, linked) : choose(gallery[0]!.text, { gallery: gallery[0]!.name }));
}
window.addEventListener("hashchange", async () => { const state = await from_fragment(location.hash, in_gallery).catch(() => undefined); if (state) await choose(state.source, state); });
void begin();
