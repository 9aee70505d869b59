// How the robot moves: the switch and the numbers below the views, and the vehicle's handles in the left view.
import { doubles } from "./engine";
import { $, say } from "./page";
import { FINGER } from "./pointers";
import type { Session } from "./session";
import { moved, number, snapped } from "./shapes";
import { frame_of, heading_of, is_number, is_radius, seen_from, wheels_of, type Moves, type Vehicle } from "./vehicle";
import { degrees } from "./verdict";
import { frame, made, type Workspace } from "./workspace";

type Name = "axle" | "forward" | "left" | "right"; // the last two are poles: the middles of the narrowest arcs
type Point = { x: number; y: number };
const MOVES: Moves[] = ["any", "differential", "car"];
const UNITS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] } as const;
const TITLES: Record<Name, string> = {
  axle: "Axle point: drag it",
  forward: "Forward: turn it",
  left: "Middle of the narrowest arc to the left: drag it",
  right: "Middle of the narrowest arc to the right: drag it",
};

export class Driving {
  private readonly group: SVGGElement; // in the axle's frame
  private readonly circles: SVGPathElement;
  private readonly arms: SVGPathElement;
  private readonly handles = {} as Record<Name, SVGElement>;
  private readonly values = {} as Record<"axle" | "left" | "right", SVGTextElement>;

  constructor(
    private readonly workspace: Workspace,
    private readonly session: Session,
  ) {
    this.group = made("g", workspace.layers.drive, { class: "drive-handles" });
    this.circles = made("path", this.group, { class: "turning" });
    this.arms = made("path", this.group, { class: "arms" });
    for (const name of ["forward", "left", "right", "axle"] as const) this.handles[name] = this.handle(name);
    for (const name of ["axle", "left", "right"] as const)
      this.values[name] = made("text", this.group, { class: "value" });
    for (const input of this.switches) input.addEventListener("change", () => this.switch_to(input.value as Moves));
    for (const name of ["axle-x", "axle-y", "radius"])
      $(name).addEventListener("change", () => this.typed($<HTMLInputElement>(name)));
    $("reverses").addEventListener("change", () => {
      const gears = $<HTMLInputElement>("reverses").checked ? "both" : "forward";
      session.drive({ ...session.vehicle, gears }, true);
    });
    workspace.on_look.push(() => this.look());
    session.on_vehicle = () => this.show();
  }

  private get switches(): NodeListOf<HTMLInputElement> {
    return $("drive").querySelectorAll<HTMLInputElement>("input[name=moves]");
  }
  private switch_to(kind: Moves): void {
    if (!this.session.scene) return this.switches.forEach((input) => (input.checked = input.value === "any"));
    this.session.drive({ ...this.session.vehicle, kind }, true);
  }
  // The next way to move.
  next(): void {
    if (!this.session.scene) return;
    this.switch_to(MOVES[(MOVES.indexOf(this.session.vehicle.kind) + 1) % MOVES.length]!);
  }

  // Take a number that was typed; one that is none is marked, and the vehicle stays as it is.
  private typed(input: HTMLInputElement): void {
    if (!this.session.scene) return;
    const { vehicle } = this.session;
    const parts = input.value.split(/[\s,;]+/).filter(Boolean);
    const is_axle = input.id !== "radius";
    const well = is_axle ? parts.length === 1 && is_number(parts[0]) : parts.length < 3 && parts.every(is_radius);
    input.setAttribute("aria-invalid", String(!well || !parts.length));
    if (!well || !parts.length) {
      const wanted = is_axle
        ? 'give a number or "p/q"'
        : "give a length above 0, or one to the left and one to the right";
      return say("edit", { tone: "bad", text: `${is_axle ? "axle" : "turning radius"} ${input.value}: ${wanted}` });
    }
    say("edit", { tone: "plain", text: "" });
    const [first, last] = [parts[0]!, parts.at(-1)!];
    const change =
      input.id === "axle-x" ? { x: first } : input.id === "axle-y" ? { y: first } : { left: first, right: last };
    this.session.drive({ ...vehicle, ...change }, true);
  }

  show(): void {
    const { vehicle } = this.session;
    const { kind, x, y, left, right, gears } = vehicle;
    for (const input of this.switches) input.checked = input.value === kind;
    $("drive").dataset.moves = kind;
    const values = { "axle-x": x, "axle-y": y, radius: left === right ? left : `${left}, ${right}` };
    for (const [id, text] of Object.entries(values)) {
      const input = $<HTMLInputElement>(id);
      input.value = text;
      input.removeAttribute("aria-invalid");
    }
    $("forward").textContent = degrees(frame_of(vehicle).theta);
    $<HTMLInputElement>("reverses").checked = gears === "both";
    const robot = doubles(this.session.scene!, "robot.xy");
    const wheels = kind === "any" ? undefined : wheels_of(vehicle, robot);
    this.session.wheels = wheels;
    this.workspace.show_wheels(wheels, frame_of(vehicle));
    this.look();
  }

  // Put the handles at their present places.
  private look(): void {
    const { scene, vehicle } = this.session.scene ? this.session : { scene: undefined, vehicle: undefined };
    this.group.style.display = vehicle && vehicle.kind !== "any" ? "" : "none";
    if (!scene || !vehicle || vehicle.kind === "any") return;
    const px = this.workspace.pixel;
    const at = frame_of(vehicle);
    this.group.setAttribute("transform", frame(at));
    const is_car = vehicle.kind === "car";
    const [left, right] = [number(vehicle.left), number(vehicle.right)];
    const tip = Math.max(0.55 * (this.session.wheels?.wheelbase ?? 0), 0.35 * this.workspace.reach, 26 * px);
    const circle = (r: number, y: number) => `M${-r} ${y}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0`;
    this.circles.setAttribute("d", is_car ? circle(left, left) + circle(right, -right) : "");
    this.arms.setAttribute("d", `M0 0H${tip}${is_car ? `M0 ${left === right ? 0 : -right}V${left}` : ""}`);
    const places: Record<Name, Point> = {
      axle: { x: 0, y: 0 },
      forward: { x: tip, y: 0 },
      left: { x: 0, y: left },
      right: { x: 0, y: -right },
    };
    const is_shown = { axle: true, forward: true, left: is_car, right: is_car && left !== right };
    for (const name of ["axle", "forward", "left", "right"] as const) {
      const handle = this.handles[name];
      const { x, y } = places[name];
      handle.style.display = is_shown[name] ? "" : "none";
      handle.setAttribute("transform", `translate(${x} ${y}) scale(${px * FINGER})`);
    }
    const turn = ((at.theta + (this.workspace.robot?.theta ?? 0)) * 180) / Math.PI;
    const written = { axle: `(${vehicle.x}, ${vehicle.y})`, left: vehicle.left, right: vehicle.right };
    for (const name of ["axle", "left", "right"] as const) {
      const text = this.values[name];
      const { x, y } = places[name];
      text.textContent = is_shown[name] ? written[name] : "";
      text.setAttribute("transform", `translate(${x} ${y}) rotate(${-turn}) scale(${px} ${-px})`);
      text.setAttribute("x", "10");
      text.setAttribute("y", "-9");
    }
    this.handles.axle.setAttribute("aria-label", `axle point: x ${vehicle.x}, y ${vehicle.y}; arrows move it`);
    const slider = (name: Name, label: string, now: number, text: string) => {
      const values = { label, valuenow: String(now), valuetext: text };
      for (const [key, of] of Object.entries(values)) this.handles[name].setAttribute(`aria-${key}`, of);
    };
    const heading = Math.atan2(Math.sin(at.theta), Math.cos(at.theta));
    slider("forward", "forward, in the robot's frame", (heading * 180) / Math.PI, degrees(heading));
    const both = left === right;
    slider("left", both ? "turning radius" : "turning radius to the left", left, vehicle.left);
    slider("right", "turning radius to the right", right, vehicle.right);
  }

  private handle(name: Name): SVGElement {
    const is_point = name === "axle";
    const range = name === "forward" ? { min: -180, max: 180 } : { min: 0 };
    const aria = is_point
      ? { role: "button" }
      : Object.fromEntries([["role", "slider"], ...Object.entries(range).map(([key, of]) => [`aria-value${key}`, of])]);
    const handle = made("g", this.group, { class: `handle ${name}`, tabindex: 0, ...aria });
    made("circle", handle, { r: 11, class: "reach" }); // larger than what is drawn
    if (name === "forward") made("path", handle, { d: "M-6 -6L7 0L-6 6Z" });
    else made("circle", handle, { r: is_point ? 5 : 4.5 });
    made("title", handle).textContent = TITLES[name];
    handle.addEventListener("pointerdown", (event) => this.grab(event, name));
    for (const shows of ["pointerenter", "focus"]) handle.addEventListener(shows, () => this.look()); // values upright
    handle.addEventListener("keydown", (event) => this.key(event, name));
    return handle;
  }

  private grab(event: PointerEvent, name: Name): void {
    const pose = this.workspace.robot;
    if (event.button !== 0 || !pose) return;
    event.preventDefault();
    event.stopPropagation();
    this.handles[name].focus({ preventScroll: true });
    const from = this.session.vehicle;
    const at = frame_of(from);
    const begin = seen_from(pose, this.workspace.point(event));
    const { step } = this.workspace;
    const to = (now: PointerEvent): Vehicle => {
      const p = seen_from(pose, this.workspace.point(now));
      if (name === "axle")
        return { ...from, x: snapped(at.x + p.x - begin.x, step), y: snapped(at.y + p.y - begin.y, step) };
      if (name === "forward") return { ...from, tau: heading_of(Math.atan2(p.y - at.y, p.x - at.x)) };
      const across = seen_from(at, p).y - seen_from(at, begin).y;
      return this.with_radius(from, name, name === "left" ? across : -across);
    };
    let is_moved = false;
    this.group.classList.add("dragged");
    const ended = () => this.group.classList.remove("dragged");
    this.workspace.pointers.follow(event, {
      move: (now) => {
        if (!is_moved && Math.hypot(now.clientX - event.clientX, now.clientY - event.clientY) < 3) return;
        is_moved = true;
        this.session.drive(to(now), false);
      },
      end: (now) => {
        ended();
        if (is_moved) this.session.drive(to(now), true);
      },
      cancel: () => {
        ended();
        if (is_moved) this.session.drag("back");
      },
    });
  }

  // Both radii are one as long as they are equal.
  private with_radius(from: Vehicle, side: "left" | "right", by: number): Vehicle {
    const { step } = this.workspace;
    const radius = snapped(Math.max(step, number(from[side]) + by), step);
    return from.left === from.right ? { ...from, left: radius, right: radius } : { ...from, [side]: radius };
  }

  private key(event: KeyboardEvent, name: Name): void {
    const unit = UNITS[event.key as keyof typeof UNITS];
    const pose = this.workspace.robot;
    if (!unit || !pose || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    const from = this.session.vehicle;
    const { step, pixel } = this.workspace;
    const by = 8 * pixel * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1);
    const along = unit[0] + unit[1]; // more, or less
    const to = (): Vehicle => {
      if (name === "forward") return { ...from, tau: heading_of(frame_of(from).theta + (along * Math.PI) / 36) };
      if (name !== "axle") return this.with_radius(from, name, along * by);
      const p = seen_from({ x: 0, y: 0, theta: pose.theta }, { x: unit[0] * by, y: unit[1] * by });
      return { ...from, x: moved(from.x, snapped(p.x, step)), y: moved(from.y, snapped(p.y, step)) };
    };
    this.session.drive(to(), true);
  }
}
