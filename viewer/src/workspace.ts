// The left view: robot, obstacles, start and goal as SVG; handles that are dragged, or moved by keys.
import { type Columns, bytes, doubles, integers } from "./engine";
import type { Track, Wheels } from "./vehicle";
import { corners_of, outline, to_point } from "./outlines";
import { in_digits } from "./verdict";
import { FINGER, Pointers, type Pinch, type Place } from "./pointers";

export type Who = "robot" | "start" | "goal";
export interface Seen {
  x: number;
  y: number;
  theta: number;
}
export interface Drag {
  who: Who;
  x: number;
  y: number;
  theta?: number;
  step: number;
  done: boolean;
}

export const SVG = "http://www.w3.org/2000/svg";
export function made<K extends keyof SVGElementTagNameMap>(
  name: K,
  parent: Element,
  attributes: Record<string, string | number> = {},
): SVGElementTagNameMap[K] {
  const element = document.createElementNS(SVG, name);
  for (const [key, of] of Object.entries(attributes)) element.setAttribute(key, String(of));
  parent.append(element);
  return element;
}

const outline_of = (scene: Columns, of: string, first?: number, last?: number) =>
  outline(doubles(scene, `${of}.xy`), integers(scene, `${of}.ring`), first, last, doubles(scene, `${of}.bend`));

const GEARS = { 1: "ahead", 0: "in-place", "-1": "back" } as const;
// A frame as an SVG transformation.
export const frame = ({ x, y, theta }: Seen) => `translate(${x} ${y}) rotate(${(theta * 180) / Math.PI})`;

export class Workspace {
  readonly svg: SVGSVGElement;
  readonly pointers: Pointers;
  private readonly world: SVGGElement;
  readonly layers: Record<
    "floor" | "slice" | "obstacles" | "sweep" | "trace" | "ghosts" | "robot" | "drive" | "marks" | "edit",
    SVGGElement
  >;
  private readonly bodies: Record<Who, SVGGElement>;
  private readonly at: Partial<Record<Who, Seen>> = {};
  private shape = "";
  private radius = 1;
  private box = { x: 0, y: 0, w: 1, h: 1 }; // the part shown, y upwards
  private whole = this.box;
  on_drag: (drag: Drag) => void = () => {};
  on_cancel = () => {}; // the drag
  readonly on_look: (() => void)[] = [];
  on_click: (at: { x: number; y: number }) => void = () => {};

  constructor(host: HTMLElement) {
    this.svg = made("svg", host, { role: "group", "aria-label": "Workspace: robot, obstacles, start and goal" });
    const defs = made("defs", this.svg);
    const hatch = made("pattern", defs, {
      id: "hatch",
      width: 7,
      height: 7,
      patternUnits: "userSpaceOnUse",
      patternTransform: "rotate(45)",
    });
    made("rect", hatch, { width: 7, height: 7, class: "hatch-ground" });
    made("rect", hatch, { width: 3, height: 7, class: "hatch-line" });
    this.world = made("g", this.svg);
    const layer = (name: string) => made("g", this.world, { class: name });
    this.layers = {
      floor: layer("floor"),
      slice: layer("slice"),
      obstacles: layer("obstacles"),
      sweep: layer("sweep"),
      trace: layer("trace"),
      ghosts: layer("ghosts"),
      robot: layer("robot-layer"),
      drive: layer("drive"),
      marks: layer("marks"),
      edit: layer("edit"),
    };
    this.bodies = {
      start: this.body("start", this.layers.ghosts),
      goal: this.body("goal", this.layers.ghosts),
      robot: this.body("robot", this.layers.robot),
    };
    this.pointers = new Pointers(this.svg, (a, b) => this.pinch(a, b));
    this.svg.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    this.svg.addEventListener("pointerdown", (event) => this.pan(event));
    new ResizeObserver(() => this.look()).observe(this.svg);
  }

  private body(who: Who, layer: SVGGElement): SVGGElement {
    const group = made("g", layer, {
      class: `body ${who}`,
      tabindex: 0,
      role: "application",
      "aria-roledescription": "movable robot",
      "aria-label": who,
    });
    made("path", group, { class: "halo" });
    made("path", group, { class: "shape" });
    if (who === "robot") made("g", group, { class: "wheels" });
    made("line", group, { class: "arm" });
    made("circle", group, { class: "point" });
    made("circle", group, { class: "knob" });
    if (who !== "robot") made("text", group, { class: "letter" }).textContent = who === "start" ? "S" : "G";
    group.addEventListener("pointerdown", (event) => this.grab(event, who));
    group.addEventListener("keydown", (event) => this.key(event, who));
    return group;
  }

  get step(): number {
    // of drags, below a pixel
    return 10 ** Math.floor(Math.log10(this.pixel));
  }
  get pixel(): number {
    return this.box.w / this.width;
  }
  private width = 1; // as last looked at: asking the browser lays out the page

  // Show a scene: anew with its poses, else with the same view.
  show_scene(scene: Columns, names: string[], poses: Seen[] | undefined): void {
    const xy = doubles(scene, "obstacles.xy");
    const polygon = integers(scene, "obstacles.polygon");
    this.radius = doubles(scene, "radius")[0]!;
    this.shape = outline_of(scene, "robot");
    this.layers.floor.replaceChildren();
    const kept = this.layers.obstacles.children; // it may have the focus
    while (kept.length + 1 > Math.max(polygon.length, 1)) kept[kept.length - 1]!.remove();
    for (let k = 0; k + 1 < polygon.length; ++k) {
      const path = kept[k] ?? made("path", this.layers.obstacles, { class: "obstacle" });
      const outline = outline_of(scene, "obstacles", polygon[k], polygon[k + 1]);
      if (path.getAttribute("d") !== outline) path.setAttribute("d", outline); // else it would be painted again
      (path.firstChild ?? made("title", path)).textContent = names[k] ?? `obstacle ${k}`;
    }
    const bounds = doubles(scene, "bounds");
    const room = doubles(scene, "workspace.xy");
    if (bounds.length)
      made("rect", this.layers.floor, {
        x: bounds[0]!,
        y: bounds[1]!,
        width: bounds[2]! - bounds[0]!,
        height: bounds[3]! - bounds[1]!,
        class: "bounds",
      });
    if (room.length) made("path", this.layers.floor, { d: outline_of(scene, "workspace"), class: "room" });
    this.shaped(this.shape);
    this.layers.marks.replaceChildren();
    if (!poses) return this.look();
    const xs: number[] = [];
    const ys: number[] = [];
    for (const of of [xy, bounds, room])
      for (let k = 0; k < of.length; k += 2) {
        xs.push(of[k]!);
        ys.push(of[k + 1]!);
      }
    for (const { x, y } of poses) {
      xs.push(x - this.radius, x + this.radius);
      ys.push(y - this.radius, y + this.radius);
    }
    const least = (of: number[]) => of.reduce((a, b) => Math.min(a, b));
    const most = (of: number[]) => of.reduce((a, b) => Math.max(a, b));
    const [x0, x1, y0, y1] = [least(xs), most(xs), least(ys), most(ys)];
    const margin = 0.06 * Math.max(x1 - x0, y1 - y0);
    this.whole = { x: x0 - margin, y: y0 - margin, w: x1 - x0 + 2 * margin, h: y1 - y0 + 2 * margin };
    this.fit();
  }

  // Mark the obstacles of a proof; below 0 are the bounds and the workspace.
  show_blocking(obstacles: number[]): void {
    const paths = this.layers.obstacles.children;
    for (let k = 0; k < paths.length; ++k) paths[k]!.classList.toggle("blocks", obstacles.includes(k));
    for (const [name, k] of [
      ["bounds", -1],
      ["room", -2],
    ] as const)
      this.layers.floor.querySelector(`.${name}`)?.classList.toggle("blocks", obstacles.includes(k));
  }
  // Draw the robot grown by the clearance of an answer, if it has one.
  show_halo(answer: Columns | undefined): void {
    const d = answer?.["grown.xy"] ? outline_of(answer, "grown") : "";
    for (const group of Object.values(this.bodies)) group.querySelector(".halo")!.setAttribute("d", d);
  }

  // Set the robot's outline, also during an edit.
  shaped(d: string): void {
    for (const group of Object.values(this.bodies)) group.querySelector(".shape")!.setAttribute("d", d);
  }
  fade(is: boolean): void {
    this.svg.classList.toggle("stale", is);
  }
  get shown(): { x: number; y: number; w: number; h: number } {
    return this.box;
  }
  // The robot's radius about its reference point.
  get reach(): number {
    return this.radius;
  }
  get robot(): Seen | undefined {
    return this.at.robot;
  }

  fit(): void {
    this.box = { ...this.whole };
    this.look();
  }

  private look(): void {
    const { clientWidth: width, clientHeight: height } = this.svg;
    if (!width || !height) return;
    this.width = width;
    const { x, y, w, h } = this.box;
    const more = Math.max(w / width, h / height);
    this.box = { x: x + (w - more * width) / 2, y: y + (h - more * height) / 2, w: more * width, h: more * height };
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.world.setAttribute(
      "transform",
      `matrix(${1 / more} 0 0 ${-1 / more} ${-this.box.x / more} ${height + this.box.y / more})`,
    );
    for (const who of Object.keys(this.bodies) as Who[]) this.place(who, this.at[who]);
    for (const look of this.on_look) look();
  }

  place(who: Who, at: Seen | undefined, tone = ""): void {
    const group = this.bodies[who];
    group.style.display = at ? "" : "none";
    if (!at) return void delete this.at[who];
    this.at[who] = at;
    const turn = (at.theta * 180) / Math.PI;
    const px = this.pixel;
    if (who === "robot")
      this.svg.querySelector("#hatch")!.setAttribute("patternTransform", `rotate(${45 - turn}) scale(${px})`);
    group.setAttribute("transform", frame(at));
    if (who === "robot") this.layers.drive.setAttribute("transform", frame(at));
    if (tone) group.dataset.tone = tone;
    group.setAttribute(
      "aria-label",
      `${who}: x ${in_digits(at.x, 4)}, y ${in_digits(at.y, 4)}, turned by ${turn.toFixed(1)} degrees`,
    );
    const reach = this.radius + 16 * px;
    const set = (selector: string, of: Record<string, number | string>) => {
      const element = group.querySelector(selector);
      for (const [key, item] of Object.entries(of)) element?.setAttribute(key, String(item));
    };
    set(".arm", { x1: 0, y1: 0, x2: reach, y2: 0 });
    set(".knob", { cx: reach, cy: 0, r: 6 * FINGER * px });
    set(".point", { cx: 0, cy: 0, r: 3.5 * px });
    set(".letter", { transform: `rotate(${-turn}) scale(${px} ${-px})`, x: 7, y: -7 });
  }

  // The forbidden region at the slider's orientation, its outline by contact type.
  show_slice(slice: Columns | undefined): void {
    const layer = this.layers.slice;
    layer.replaceChildren();
    if (!slice) return;
    const xy = doubles(slice, "xy");
    const start = integers(slice, "start");
    const shell = integers(slice, "shell");
    const { x, y, w, h } = this.whole;
    const far = 50 * Math.max(w, h);
    const outside = shell.includes(-1) ? `M${x - far} ${y - far}h${w + 2 * far}v${h + 2 * far}h${-w - 2 * far}Z` : "";
    const rings = corners_of(xy, start, doubles(slice, "bend"));
    made("path", layer, { d: outside + outline(rings.xy, rings.ring, 0, undefined, rings.bend), class: "forbidden" });
    const segments = doubles(slice, "segments");
    const kind = bytes(slice, "kind");
    const bend = doubles(slice, "segments.bend");
    const d = ["", "", "", ""];
    for (let k = 0; k < kind.length; ++k)
      d[kind[k]!] += `M${segments[4 * k]} ${segments[4 * k + 1]}${to_point(segments, 2 * k + 1, bend[k] ?? 0)}`;
    d.forEach((of, k) =>
      made("path", layer, { d: of, class: ["vertex-edge", "edge-vertex", "arc-arc", "at-bounds"][k]! }),
    );
  }

  // Show the robot along a path, and the track of its reference point, or that of a vehicle's axle.
  show_path(samples: Float64Array | undefined, track?: Track): void {
    this.layers.sweep.replaceChildren();
    this.layers.trace.replaceChildren();
    if (!samples?.length) return;
    let d = "";
    let last = -1;
    let way = 0;
    const spacing = 0.32 * this.radius;
    for (let k = 0; k < samples.length; k += 3) {
      const [x, y, theta] = [samples[k]!, samples[k + 1]!, samples[k + 2]!];
      d += `${k ? "L" : "M"}${x} ${y}`;
      if (k)
        way +=
          Math.hypot(x - samples[k - 3]!, y - samples[k - 2]!) + this.radius * 0.6 * Math.abs(theta - samples[k - 1]!);
      if (last >= 0 && way - last < spacing) continue;
      last = way;
      made("path", this.layers.sweep, {
        d: this.shape,
        transform: frame({ x, y, theta }),
      });
    }
    if (!track) return void made("path", this.layers.trace, { d });
    const line = (points: number[]) => points.map((c, k) => `${k % 2 ? " " : k ? "L" : "M"}${c}`).join("");
    for (const gear of [1, -1, 0] as const) {
      const pieces = track.pieces.filter((piece) => piece.gear === gear).map(({ points }) => line(points));
      if (pieces.length) made("path", this.layers.trace, { d: pieces.join(""), class: GEARS[gear] });
    }
    const dots = track.cusps.map(({ x, y }) => `M${x} ${y}h0`).join(""); // round ends of no length
    for (const part of ["cusps rim", "cusps"]) made("path", this.layers.trace, { d: dots, class: part });
  }

  // Draw the wheels of a vehicle on the robot, given its axle in the robot's frame.
  show_wheels(wheels: Wheels | undefined, axle: Seen): void {
    const group = this.bodies.robot.querySelector(".wheels")!;
    group.replaceChildren();
    if (!wheels) return;
    const { half_track, wheelbase, length, width } = wheels;
    group.setAttribute("transform", frame(axle));
    made("line", group, { x1: 0, y1: -half_track, x2: 0, y2: half_track });
    for (const x of wheelbase > 0 ? [0, wheelbase] : [0])
      for (const y of [-half_track, half_track]) {
        const turned = made("g", group, { class: x > 0 ? "front" : "rear", transform: `translate(${x} ${y})` });
        made("rect", turned, { x: -length / 2, y: -width / 2, width: length, height: width, rx: width / 4 });
      }
  }
  // Turn the front wheels, in radians.
  steer(angle: number): void {
    for (const wheel of this.bodies.robot.querySelectorAll(".front rect"))
      wheel.setAttribute("transform", `rotate(${(angle * 180) / Math.PI})`);
  }

  // Features of a contact: on the robot where it is, and on the obstacle.
  show_contacts(columns: Columns | undefined, prefix: string, at: Seen): void {
    this.layers.marks.replaceChildren();
    if (!columns) return;
    const robot = doubles(columns, `${prefix}.robot_xy`);
    const obstacle = doubles(columns, `${prefix}.obstacle_xy`);
    const mark = (parent: Element, of: ArrayLike<number>, k: number, radius: number) => {
      const [x0, y0, x1, y1] = [of[4 * k]!, of[4 * k + 1]!, of[4 * k + 2]!, of[4 * k + 3]!];
      if (x0 !== x1 || y0 !== y1)
        made("path", parent, { d: `M${x0} ${y0}${to_point(of, 2 * k + 1, radius)}`, class: radius > 0 ? "arc" : "" });
      else if (radius > 0) made("circle", parent, { cx: x0, cy: y0, r: radius, class: "arc" });
      else made("circle", parent, { cx: x0, cy: y0, r: 5 * this.pixel });
    };
    const moved = made("g", this.layers.marks, { transform: frame(at) });
    const [of_robot, of_obstacle] = ["robot", "obstacle"].map((of) => doubles(columns, `${prefix}.${of}_radius`));
    const kind = bytes(columns, `${prefix}.kind`);
    for (let k = 0; 4 * k < robot.length; ++k) {
      mark(this.layers.marks, obstacle, k, kind[k] === 0 ? 0 : (of_obstacle![k] ?? 0));
      mark(moved, robot, k, kind[k] === 1 ? 0 : (of_robot![k] ?? 0));
    }
  }

  point(event: { clientX: number; clientY: number }): { x: number; y: number } {
    const rect = this.svg.getBoundingClientRect();
    const px = this.pixel;
    return { x: this.box.x + (event.clientX - rect.left) * px, y: this.box.y + (rect.bottom - event.clientY) * px };
  }

  private grab(event: PointerEvent, who: Who): void {
    const at = this.at[who];
    if (!at || event.button !== 0) return;
    event.preventDefault();
    event.stopPropagation();
    const group = this.bodies[who];
    const begin = this.point(event);
    const from = { ...at };
    const turns = (event.target as Element).classList.contains("knob");
    group.focus({ preventScroll: true });
    const tell = (now: PointerEvent, done: boolean) => {
      const p = this.point(now);
      if (turns)
        this.on_drag({
          who,
          x: from.x,
          y: from.y,
          theta: Math.atan2(p.y - from.y, p.x - from.x),
          step: this.step,
          done,
        });
      else this.on_drag({ who, x: from.x + p.x - begin.x, y: from.y + p.y - begin.y, step: this.step, done });
    };
    this.pointers.follow(event, {
      move: (now) => tell(now, false),
      end: (now) => tell(now, true),
      cancel: () => this.on_cancel(),
    });
  }

  private key(event: KeyboardEvent, who: Who): void {
    const at = this.at[who];
    if (!at || event.ctrlKey || event.metaKey) return;
    const by = 8 * this.pixel * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1);
    const turn = (Math.PI / 36) * (event.shiftKey ? 3 : event.altKey ? 0.1 : 1);
    const moves: Record<string, [number, number, number]> = {
      ArrowLeft: [-by, 0, 0],
      ArrowRight: [by, 0, 0],
      ArrowUp: [0, by, 0],
      ArrowDown: [0, -by, 0],
      "[": [0, 0, turn],
      "]": [0, 0, -turn],
      "{": [0, 0, turn],
      "}": [0, 0, -turn],
    };
    const move = moves[event.key];
    if (!move) return;
    event.preventDefault();
    event.stopPropagation();
    const [dx, dy, turned] = move;
    this.on_drag({
      who,
      x: at.x + dx,
      y: at.y + dy,
      ...(turned ? { theta: at.theta + turned } : {}),
      step: this.step,
      done: true,
    });
  }

  // Move the drawing, or click a part of it.
  pan(event: PointerEvent, clicked = this.on_click): void {
    if (event.button !== 0) return;
    const from = { ...this.box };
    const px = this.pixel;
    const still = event.pointerType === "touch" ? 10 : 3;
    const to = (box: typeof from) => {
      this.box = box;
      this.look();
    };
    this.pointers.follow(event, {
      move: (now) =>
        to({ ...from, x: from.x - (now.clientX - event.clientX) * px, y: from.y + (now.clientY - event.clientY) * px }),
      end: (now) => {
        if (Math.hypot(now.clientX - event.clientX, now.clientY - event.clientY) < still) {
          to(from);
          clicked(this.point(now));
        }
      },
      cancel: () => to(from),
    });
  }

  // Pinch: the points under the fingers stay under them.
  private pinch(a: Place, b: Place): Pinch {
    const middle = (p: Place, q: Place) => ({
      clientX: (p.clientX + q.clientX) / 2,
      clientY: (p.clientY + q.clientY) / 2,
    });
    const apart = (p: Place, q: Place) => Math.max(1, Math.hypot(p.clientX - q.clientX, p.clientY - q.clientY));
    const from = { ...this.box };
    const held = this.point(middle(a, b));
    const first = apart(a, b);
    const move = (p: Place, q: Place) => {
      const by = first / apart(p, q);
      this.box = { ...from, w: from.w * by, h: from.h * by };
      const now = this.point(middle(p, q));
      this.box.x += held.x - now.x;
      this.box.y += held.y - now.y;
      this.look();
    };
    return {
      move,
      cancel: () => {
        this.box = from;
        this.look();
      },
    };
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const p = this.point(event);
    const by = Math.exp(0.0015 * event.deltaY);
    const { x, y, w, h } = this.box;
    this.box = { x: p.x + (x - p.x) * by, y: p.y + (y - p.y) * by, w: w * by, h: h * by };
    this.look();
  }
}
