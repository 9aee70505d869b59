// Questions to the core when something moves, and where its answers go.
import { Cancelled, Engine, type Columns, doubles, integers, string, value } from "./engine";
import type { Editor } from "./editor";
import { $, fault, say, working } from "./page";
import { digits, number } from "./shapes";
import { wrapped, type Space } from "./space";
import { History, fragment, from_words, words, type PoseText, type State } from "./state";
import { around_words, degrees, in_digits, missing_words, pose_verdict, way_verdict } from "./verdict";
import { frame_of, track_of, usual, words_of, type Gear, type Vehicle, type Wheels } from "./vehicle";
import { NONE, clearance_of, words_of as words_of_wishes, type Wishes } from "./wishes";
import type { FilePose, SceneText } from "./words";
import type { Drag, Seen, Who, Workspace } from "./workspace";

// ms that a boundary may take before the next edit ends it: half as long again as the last one, within these
const PATIENCE = 300;
const MOST_PATIENCE = 1500;
const LAG = 250; // milliseconds for which a drag waits for the slice of the scene before
const PAUSE = 4; // times that a way takes: so long a drag asks for no other
const REST = 4; // times that the right view takes: so long only the left one follows a drag
const COARSE = 9000;
const FINE = 60_000; // triangles
const QUICK = 300;
const LONG = 3000; // attempts to shorten a vehicle's path, during a drag and after it

export const seen_of = (pose: PoseText): Seen => ({
  x: number(pose.x),
  y: number(pose.y),
  theta: pose.tau === "inf" ? Math.PI : 2 * Math.atan(number(pose.tau)),
});

type Box = [number, number, number, number];
function box_of(read: Columns): Box {
  const bounds = doubles(read, "bounds");
  if (bounds.length) return [...bounds] as Box;
  const radius = value(read, "radius");
  const xy = doubles(read, doubles(read, "workspace.xy").length ? "workspace.xy" : "obstacles.xy");
  const box: Box = xy.length
    ? [Infinity, Infinity, -Infinity, -Infinity]
    : [-2 * radius, -2 * radius, 2 * radius, 2 * radius];
  for (let k = 0; k < xy.length; k += 2) {
    box[0] = Math.min(box[0], xy[k]! - radius);
    box[1] = Math.min(box[1], xy[k + 1]! - radius);
    box[2] = Math.max(box[2], xy[k]! + radius);
    box[3] = Math.max(box[3], xy[k + 1]! + radius);
  }
  return box;
}

// What is to be seen first, in place of what the file says; a vehicle may lack some of its numbers.
export type Opening = Omit<Partial<State>, "vehicle"> & { vehicle?: Partial<Vehicle> };

export class Session {
  readonly quick = new Engine(); // reads scenes, checks poses: answers at once
  readonly builder = new Engine((share) => {
    $<HTMLProgressElement>("share-done").value = share;
  }); // boundary, mesh, slices
  readonly planner = new Engine(); // ways
  private readonly misser = new Engine(); // what is missing where there is none
  history!: History;
  file!: Omit<SceneText, "words">;
  scene?: Columns;
  seen: { robot?: Seen; start?: Seen; goal?: Seen } = {};
  is_built = false; // of the scene as it is now
  private opened = 0;
  path: Float64Array | undefined;
  gears: Gear[] | undefined; // of each sample of the path, if a vehicle drives it
  wheels: Wheels | undefined; // as drawn
  driver: Vehicle | undefined; // whose answer is shown
  last_way: Columns | undefined;
  editor?: Editor;
  stop_playing = () => {};
  on_opened = () => {};
  on_seen = () => {};
  on_vehicle = () => {};
  on_wishes = () => {};
  mesh: Columns | undefined; // as shown
  on_built = () => {};

  constructor(
    readonly workspace: Workspace,
    readonly space: Space | undefined,
  ) {
    workspace.on_drag = (drag) => this.drag(drag);
    workspace.on_cancel = () => this.drag("back");
  }

  get now(): State {
    return this.history.now;
  }

  // Open a file's text: read and show it, and compute its boundary while paths are searched.
  async open(source: string, of?: Opening): Promise<void> {
    const { ready } = document.body.dataset;
    this.stop_playing();
    this.is_ready(undefined);
    try {
      const read = await this.quick.open(source);
      const file: SceneText = JSON.parse(string(read, "file"));
      const start = of?.start ?? (file.start && (await this.text_of(file.start)));
      const goal = of?.goal ?? (file.goal && (await this.text_of(file.goal, start?.tau))); // a goal without an angle has the start's
      const robot = of?.robot ?? start ?? (await this.robot_alone(read));
      const vehicle = of?.vehicle ?? file.vehicle;
      const state: State = {
        source,
        opened: ++this.opened,
        robot,
        ...(vehicle && { vehicle: { ...usual(doubles(read, "robot.xy")), ...vehicle } }),
        ...(start && { start }),
        ...(goal && { goal }),
        ...(of?.wishes && { wishes: of.wishes }),
        ...(of?.gallery && { gallery: of.gallery }),
      };
      if (this.history) this.history.push(state);
      else this.history = new History(state);
      this.take(read);
    } catch (error) {
      if (!(error instanceof Cancelled)) this.is_ready(ready);
      return fault("edit", error);
    }
    this.remember();
    await this.build(true);
  }

  // The pose of a robot without a start: its own in a drawing among the shapes, if it is free there, or else the middle.
  private async robot_alone(read: Columns): Promise<PoseText> {
    const drawn = { x: "0", y: "0", tau: "0" };
    const box = box_of(read);
    const is_among = doubles(read, "robot.xy").every((c, k) => box[k % 2]! <= c && c <= box[(k % 2) + 2]!);
    if (is_among && value(await this.quick.call("pose", words(drawn)), "free") === 1) return drawn;
    const middle = (k: 0 | 1) => ((box[k] + box[k + 2]!) / 2).toFixed(2);
    return { ...drawn, x: middle(0), y: middle(1) };
  }

  // Show the state with the scene that was read. A new scene gets a new view; an edited one keeps its view.
  private shown?: number;
  private take(read: Columns, is_last = true): void {
    const { now } = this;
    const is_other = now.opened !== this.shown;
    this.shown = now.opened;
    this.scene = read;
    this.file = JSON.parse(string(read, "file"));
    this.is_built = false;
    this.last_free = undefined;
    this.seen = {
      robot: seen_of(now.robot),
      ...(now.start && { start: seen_of(now.start) }),
      ...(now.goal && { goal: seen_of(now.goal) }),
    };
    document.title = `${this.file.name || "scene"}: cfree`;
    this.workspace.show_scene(read, this.file.names, is_other ? (Object.values(this.seen) as Seen[]) : undefined);
    const scenes = $<HTMLSelectElement>("scenes");
    scenes.value = now.gallery ?? "";
    if (!scenes.value) scenes.value = ""; // a lesson's
    $("picked").hidden = true;
    say("edit", { tone: "plain", text: "" });
    if (is_other) {
      this.workspace.show_slice(undefined);
      this.workspace.show_path(undefined);
      this.space?.show_scene(box_of(read), value(read, "radius"), true);
      $("facts").textContent = "";
      this.path = undefined;
      this.last_way = undefined;
      say("way", { tone: "plain", text: "" });
      this.end_missing();
      this.workspace.show_blocking([]);
    } else {
      this.space?.fade(true);
      this.workspace.fade(true);
    }
    for (const who of ["start", "goal"] as const) this.place(who);
    this.set_slider(this.seen.robot!.theta);
    this.editor?.show(now.source);
    this.on_vehicle();
    this.on_wishes();
    this.on_opened();
    void this.ask_robot(now.robot);
    void (is_last ? this.ask_last_way() : this.ask_ways());
  }

  place(who: Who, tone = ""): void {
    this.workspace.place(who, this.seen[who], tone);
    if (who === "start") this.space?.place_end(0, this.seen.start);
    if (who === "goal") this.space?.place_end(1, this.seen.goal);
  }

  // Build the boundary of the scene as it is now; of several requests the newest succeeds. The promise is that of all of them.
  private wanted?: { is_fine: boolean };
  private building?: Promise<void>;
  private building_since = 0;
  private last_took = 0;
  build(is_fine: boolean): Promise<void> {
    this.wanted = { is_fine };
    if (this.building) {
      const patience = Math.min(MOST_PATIENCE, Math.max(PATIENCE, 1.5 * this.last_took));
      if (is_fine || performance.now() - this.building_since > patience) this.builder.end();
    }
    return (this.building ??= this.build_all());
  }

  private async build_all(): Promise<void> {
    const slow = setTimeout(() => working(true), 250);
    for (let wish; (wish = this.wanted);) {
      this.wanted = undefined;
      this.building_since = performance.now();
      try {
        await this.build_once(wish.is_fine);
        this.last_took = performance.now() - this.building_since;
      } catch (error) {
        if (!(error instanceof Cancelled)) fault("pose", error);
        else if (!this.wanted) $("facts").textContent = "stopped: no boundary";
      }
    }
    this.building = undefined;
    clearTimeout(slow);
    working(this.planner.busy && this.is_waiting);
  }

  private async build_once(is_fine: boolean): Promise<void> {
    const { source } = this.now;
    const read = this.scene!;
    const box = box_of(read);
    const radius = value(read, "radius");
    const began = performance.now();
    const builder = await this.builder.of(source);
    if (!is_fine && (await this.build_slice(builder, source))) return;
    const sliced = performance.now();
    const counts = await builder.call("boundary");
    const seconds = (performance.now() - began) / 1000;
    const mesh = this.space && (await builder.call("mesh", radius / (is_fine ? 60 : 20), is_fine ? FINE : COARSE));
    const is_now = source === this.now.source;
    this.mesh_due = performance.now() + REST * (performance.now() - sliced);
    const cells = value(counts, "cells");
    $("facts").textContent =
      `${value(counts, "trapezoids").toLocaleString("en")} trapezoids · ${cells} ${cells === 1 ? "cell" : "cells"} · ${seconds.toFixed(2)} s${around_words(read, this.file.names, this.file.units)}`;
    if (this.space) {
      this.space.show_scene(box, radius, false);
      this.space.show_mesh(mesh!);
      this.mesh = mesh;
      this.on_built();
      for (const who of ["start", "goal"] as const) this.place(who);
    }
    if (!is_now) return;
    this.is_built = true;
    this.space?.fade(false);
    this.workspace.fade(false);
    this.show_way(this.last_way && (await this.with_cells(this.last_way)));
    await Promise.all([this.ask_slice(), this.ask_robot(this.now.robot)]);
    if (is_fine) this.is_ready(this.now.gallery ?? this.file.name);
    document.body.dataset.built = String(Number(document.body.dataset.built ?? 0) + 1);
  }

  // During a drag the slice follows each change. True if the right view need not follow now.
  private mesh_due = 0;
  private async build_slice(builder: Engine, source: string): Promise<boolean> {
    await builder.call("trimmed");
    if (source === this.now.source && this.seen.robot) {
      this.workspace.show_slice(await builder.call("slice", this.seen.robot.theta));
      this.workspace.fade(false);
      document.body.dataset.sliced = String(Number(document.body.dataset.sliced ?? 0) + 1);
    }
    return performance.now() < this.mesh_due;
  }

  // Set `data-ready` to the name of the scene once all of it is shown, for code outside the page.
  private is_ready(name: string | undefined): void {
    if (name === undefined) delete document.body.dataset.ready;
    else document.body.dataset.ready = name;
  }

  set_slider(theta: number): void {
    const at = wrapped(theta);
    $<HTMLInputElement>("theta").value = String((at * 180) / Math.PI);
    $("degrees").textContent = degrees(at);
    this.space?.set_theta(theta);
  }

  async ask_slice(): Promise<void> {
    if (!this.is_built || !this.seen.robot) return;
    try {
      const slice = await this.builder.newest("slice", this.seen.robot.theta);
      this.workspace.show_slice(slice);
      this.space?.show_slice(slice);
    } catch (error) {
      fault("pose", error);
    }
  }

  // Ask about the robot's pose: verdict, touching pairs, cells.
  async ask_robot(pose: PoseText): Promise<boolean | undefined> {
    try {
      const { source } = this.now;
      const asked = this.is_built ? this.builder : await this.quick.of(source);
      const answer = await asked.newest("pose", words(pose));
      if (source !== this.now.source) return undefined;
      const [x, y, theta] = doubles(answer, "place") as unknown as [number, number, number];
      const at = { x, y, theta };
      this.seen.robot = at;
      const is_free = value(answer, "free") === 1;
      const verdict = pose_verdict(answer, this.file.names);
      this.workspace.place("robot", at, verdict.tone);
      this.space?.place(at, is_free);
      this.workspace.show_contacts(is_free ? answer : undefined, "touching", at);
      this.editor?.look();
      const cells = integers(answer, "cells");
      const clearance = value(answer, "clearance");
      const units = this.file.units ? ` ${this.file.units}` : "";
      if (verdict.tone === "good" && Number.isFinite(clearance))
        verdict.text = `Free${cells.length ? `, in cell ${cells[0]}` : ""}; ${in_digits(clearance, 3)}${units} from obstacles.`;
      say("pose", verdict);
      return is_free;
    } catch (error) {
      fault("pose", error);
      return undefined;
    }
  }

  private is_waiting = false; // for a way
  async ask_way(is_last = true): Promise<void> {
    const { start, goal, source, vehicle } = this.now;
    const { wishes } = this;
    this.end_missing();
    $("start-here").hidden = start !== undefined;
    $("goal-here").hidden = goal !== undefined;
    if (!start || !goal) {
      const missing = start ? "goal" : goal ? "start" : "start and goal";
      return say("way", { tone: "plain", text: `No ${missing} in this scene: drag the robot there, and mark it.` });
    }
    $("way").classList.add("old");
    const slow = setTimeout(() => {
      this.is_waiting = true;
      working(true);
      say("way", { tone: "plain", text: "Looking for a motion …" });
    }, 400);
    try {
      const clearance = clearance_of(wishes);
      const planner = await this.planner.of(source, clearance);
      const attempts = is_last ? LONG : QUICK;
      const asked = [words(start), words(goal)] as const;
      const answer = await planner.newest("plan", ...asked, words_of(vehicle), attempts, words_of_wishes(wishes));
      if (source !== this.now.source || clearance !== clearance_of(this.wishes)) return;
      this.show_way(clearance ? answer : await this.with_cells(answer), vehicle, clearance);
      if (is_last && string(answer, "verdict") === "apart") void this.ask_missing(source, clearance, asked);
    } catch (error) {
      if (!(error instanceof Cancelled)) {
        this.show_way(undefined);
        fault("way", error);
      }
    } finally {
      clearTimeout(slow);
      this.is_waiting = false;
      if (!this.building) working(false);
    }
  }

  // During a drag ways are asked for one after the other; the one after it replaces them.
  private is_asking = false;
  private asks_again = false;
  private ask_last_way(): Promise<void> {
    this.asks_again = false;
    return this.ask_way();
  }
  private async ask_ways(): Promise<void> {
    this.asks_again = this.is_asking;
    if (this.is_asking) return;
    this.is_asking = true;
    do {
      this.asks_again = false;
      const began = performance.now();
      await this.ask_way(false);
      await new Promise((next) => setTimeout(next, PAUSE * (performance.now() - began)));
    } while (this.asks_again);
    this.is_asking = false;
  }

  // How much smaller the robot would have to be, beside the proof that there is no motion.
  private async ask_missing(source: string, clearance: string, ends: readonly [string, string]): Promise<void> {
    const wish = (this.missing_wish = Symbol());
    const is_wished = () => wish === this.missing_wish;
    const show = (text: string) => say("missing", { tone: "plain", text });
    show("How much is missing: being computed …");
    try {
      const misser = await this.misser.of(source, clearance);
      const found = await misser.call("missing", ...ends);
      if (is_wished()) show(missing_words(found, this.file.units));
    } catch (error) {
      if (!is_wished()) return;
      show("");
      fault("missing", error);
    }
  }
  private missing_wish?: symbol;
  private end_missing(): void {
    this.missing_wish = undefined;
    if (this.misser.busy) this.misser.end();
    say("missing", { tone: "plain", text: "" });
  }

  // Among round shapes the cells of the shown boundary tell of poses between which neither a path nor a proof was found.
  private async with_cells(answer: Columns): Promise<Columns> {
    const { start, goal, vehicle } = this.now;
    if (clearance_of(this.wishes) || string(answer, "verdict") !== "round" || !this.is_built || !start || !goal)
      return answer;
    const joined = value(await this.builder.call("joined", words(start), words(goal)), "joined");
    if (joined === 0) return { ...answer, verdict: "round apart" };
    return joined === 1 && words_of(vehicle) === "" ? { ...answer, verdict: "round joined" } : answer;
  }

  private kept = ""; // the clearance of the answer that is shown
  show_way(answer: Columns | undefined, vehicle = this.driver, clearance = this.kept): void {
    this.last_way = answer;
    this.driver = vehicle;
    this.kept = clearance;
    const verdict = answer && string(answer, "verdict");
    this.path = verdict === "path" ? doubles(answer!, "samples") : undefined;
    this.gears =
      this.path && answer?.gear
        ? [...integers(answer, "motion")].map((k) => (integers(answer, "gear")[k] ?? 0) as Gear)
        : undefined;
    if (answer) say("way", way_verdict(answer, this.file.names, this.file.units, vehicle, clearance));
    this.show_path();
    this.space?.show_barrier(verdict === "apart" ? answer : undefined);
    this.workspace.show_blocking(verdict === "apart" ? [...integers(answer!, "obstacles")] : []);
    this.workspace.show_halo(answer);
    $("frame-proof").hidden = verdict !== "apart" || !this.space;
    this.on_built(); // the legend
    $<HTMLButtonElement>("play").disabled = !this.path;
    this.on_seen();
  }
  show_path(): void {
    const shown = $<HTMLInputElement>("sweep").checked ? this.path : undefined;
    const by_clearance =
      $<HTMLSelectElement>("colour").value === "clearance"
        ? this.last_way && doubles(this.last_way, "clearance")
        : undefined;
    const gears = shown && this.gears;
    this.workspace.show_path(shown, gears && this.driver && track_of(shown, gears, frame_of(this.driver)));
    this.space?.show_path(shown, by_clearance, gears);
  }

  private drags: (Drag | "back")[] = []; // still to be followed
  private is_following = false;
  private last_free?: PoseText;
  drag(drag: Drag | "back"): void {
    const last = this.drags.at(-1);
    if (last && last !== "back" && !last.done) this.drags.pop(); // the next one replaces it
    this.drags.push(drag);
    if (!this.is_following) void this.follow();
  }
  private async follow(): Promise<void> {
    this.is_following = true;
    for (let drag; (drag = this.drags.shift());) {
      try {
        await (drag === "back" ? this.back() : this.moved(drag));
      } catch (error) {
        fault("pose", error);
      }
    }
    this.is_following = false;
  }

  private async moved(drag: Drag): Promise<void> {
    this.stop_playing();
    const now = this.now[drag.who]!;
    const decimal = (c: number) => c.toFixed(digits(drag.step));
    const wanted: PoseText =
      drag.theta === undefined
        ? { x: decimal(drag.x), y: decimal(drag.y), tau: now.tau }
        : { ...now, tau: await this.tau_of(drag.theta) };
    if (drag.who !== "robot") {
      this.seen[drag.who] = seen_of(wanted);
      this.place(drag.who);
      this.keep({ ...this.now, [drag.who]: wanted }, drag.done);
      return this.ask_way(drag.done);
    }
    const is_free = await this.ask_robot(wanted);
    let reached = wanted;
    if (is_free) this.last_free = wanted;
    else if (is_free === false && this.last_free && this.last_free.tau === wanted.tau && drag.theta === undefined) {
      const quick = await this.quick.of(this.now.source);
      const stop = from_words(string(await quick.call("stop", words(this.last_free), words(wanted)), "pose"));
      const at = seen_of(stop);
      if (Math.hypot(at.x - drag.x, at.y - drag.y) < 11 * this.workspace.pixel) {
        reached = stop;
        await this.ask_robot(stop);
      } // in contact, exactly
    }
    if (drag.theta !== undefined) {
      this.set_slider(this.seen.robot!.theta);
      void this.ask_slice();
    }
    this.keep({ ...this.now, robot: reached }, drag.done);
  }

  // Put start or goal where the robot is.
  mark_end(who: "start" | "goal"): void {
    this.stop_playing();
    const { robot } = this.now;
    this.seen[who] = seen_of(robot);
    this.place(who);
    this.keep({ ...this.now, [who]: robot }, true);
    void this.ask_way(true);
  }

  // The vehicle that is shown, or was before the robot moved in any direction, or a guess.
  get vehicle(): Vehicle {
    return this.now.vehicle ?? { ...usual(doubles(this.scene!, "robot.xy")), kind: "any" };
  }
  drive(vehicle: Vehicle, done: boolean): void {
    this.stop_playing();
    this.keep({ ...this.now, vehicle }, done);
    this.on_vehicle();
    this.on_wishes();
    void this.ask_way(done);
  }

  get wishes(): Wishes {
    return this.now.wishes ?? NONE;
  }
  wish(wishes: Wishes): void {
    this.stop_playing();
    this.keep({ ...this.now, wishes }, true);
    this.on_wishes();
    void this.ask_way();
  }

  // Take an edited text. A text that is no scene is refused, and the last valid scene stays.
  private edit?: { source: string; done: boolean } | "back";
  private is_editing = false;
  async edited(edit: { source: string; done: boolean } | "back"): Promise<void> {
    this.edit = edit;
    if (this.is_editing) return;
    this.is_editing = true;
    for (let edit; (edit = this.edit);) {
      this.edit = undefined;
      await (edit === "back" ? this.back() : this.edit_once(edit.source, edit.done));
    }
    this.is_editing = false;
  }
  private async edit_once(source: string, done: boolean): Promise<void> {
    this.stop_playing();
    try {
      const changes = source !== this.now.source;
      // the builder, if it has nothing to do, reads the scene meanwhile
      if (changes && !this.building && !this.builder.busy) this.builder.of(source).catch(() => {});
      const read = changes ? await this.quick.open(source) : undefined;
      const { gallery: _, ...now } = this.now;
      this.keep(read ? { ...now, source } : this.now, done);
      if (read) this.scene = read;
      const built = read || done ? this.build(done) : undefined; // by a worker, while the scene is drawn
      if (read) this.take(read, done);
      else say("edit", { tone: "plain", text: "" });
      if (done && !read) void this.ask_last_way();
      await Promise.race([built, new Promise((next) => setTimeout(next, LAG))]);
    } catch (error) {
      if (error instanceof Cancelled) return;
      fault("edit", error);
      this.editor?.refused(error instanceof Error ? error.message : "");
      if (!done) return;
      this.keep(this.now, true);
      this.editor?.show(this.now.source);
      void this.build(true);
    }
  }

  private before?: State;
  // Keep a state during a drag; once the drag has ended it can be undone.
  keep(state: State, done: boolean): void {
    this.before ??= this.now;
    this.history.now = state;
    if (!done) return;
    this.history.now = this.before;
    this.before = undefined;
    this.history.push(state);
    this.remember();
  }

  // Restore the state before a cancelled drag.
  private async back(): Promise<void> {
    const { before } = this;
    this.before = undefined;
    if (before) await this.restore(() => (this.history.now = before));
  }

  private due = 0;
  remember(): void {
    this.on_seen();
    $<HTMLButtonElement>("undo").disabled = !this.history.can_undo;
    $<HTMLButtonElement>("redo").disabled = !this.history.can_redo;
    clearTimeout(this.due);
    this.due = window.setTimeout(async () => {
      const hash = await fragment(this.now);
      try {
        window.history.replaceState(null, "", hash ?? "#");
      } catch {
        /* a frame without an address */
      }
    }, 300);
  }

  async undo(): Promise<void> {
    return this.restore(() => this.history.undo());
  }
  async redo(): Promise<void> {
    return this.restore(() => this.history.redo());
  }
  async change({ vehicle, ...of }: Opening): Promise<void> {
    return this.restore(() => {
      this.history.push({ ...this.now, ...of, ...(vehicle && { vehicle: { ...this.vehicle, ...vehicle } }) });
      return this.now;
    });
  }
  private async restore(step: () => State | undefined): Promise<void> {
    const { source } = this.now;
    const state = step();
    if (!state) return;
    this.stop_playing();
    if (state.source !== source) {
      this.is_ready(undefined);
      try {
        this.take(await this.quick.open(state.source));
      } catch (error) {
        return fault("edit", error);
      }
      void this.build(true);
    } else {
      this.seen = {
        robot: seen_of(state.robot),
        ...(state.start && { start: seen_of(state.start) }),
        ...(state.goal && { goal: seen_of(state.goal) }),
      };
      for (const who of ["start", "goal"] as const) this.place(who);
      this.set_slider(this.seen.robot!.theta);
      this.on_vehicle();
      this.on_wishes();
      void this.ask_robot(state.robot);
      void this.ask_slice();
      void this.ask_way();
    }
    this.remember();
  }

  stop(): void {
    this.stop_playing();
    this.end_missing();
    if (this.building) this.builder.end();
    if (this.planner.busy) {
      this.planner.end();
      say("way", { tone: "plain", text: "Stopped." });
    }
    working(false);
  }

  async tau_of(theta: number, fine = false): Promise<string> {
    return string(await this.quick.call("angle", theta, fine ? 1 : 0), "tau");
  }
  private async text_of(pose: FilePose, otherwise = "0"): Promise<PoseText> {
    return {
      x: pose.x,
      y: pose.y,
      tau: pose.tau ?? (pose.theta === undefined ? otherwise : await this.tau_of(pose.theta, true)),
    };
  }
}
