// Obstacles and the robot's outline changed by dragging, or by keys: handles over the left view, new texts of the scene.
import { FINGER } from "./pointers";
import { Shapes, moved, number, same, snapped, type Point, type Rings, type Which } from "./shapes";
import { outline } from "./outlines";
import { made, type Workspace } from "./workspace";

interface Spot {
  ring: number;
  vertex: number;
}
const MOST = 400; // vertices with handles
const NEAR = 10; // pixels from an edge within which a click means it

const plain = (rings: Rings) => {
  const xy = rings.flat().flatMap(([x, y]) => [number(x), number(y)]);
  const ring = [0];
  for (const of of rings) ring.push(ring.at(-1)! + of.length);
  return { xy, ring };
};

export class Editor {
  is_on = false;
  private shapes?: Shapes;
  private chosen?: Which;
  private drawn?: { x: number; y: number }[]; // a new obstacle's vertices so far
  private pointer?: { x: number; y: number };
  private readonly frame: SVGGElement;
  private fault = "";
  names: string[] = [];
  on_change: (source: string, done: boolean) => void = () => {};
  on_cancel = () => {}; // the drag
  on_mode = () => {};

  constructor(private readonly workspace: Workspace) {
    this.frame = made("g", workspace.layers.edit, { class: "handles" });
    const { svg, layers } = workspace;
    workspace.on_look.push(() => this.look());
    layers.obstacles.addEventListener("pointerdown", (event) => this.grab(event));
    layers.obstacles.addEventListener("keydown", (event) => this.key(event));
    layers.floor.addEventListener("pointerdown", (event) => {
      if (this.is_on && !this.drawn && (event.target as Element).classList.contains("room"))
        this.choose({ kind: "workspace", k: 0 });
    });
    svg.parentElement!.addEventListener("focusin", (event) => {
      // an SVG element that listens to it would take part in Tab
      const target = event.target as Element;
      if (layers.obstacles.contains(target)) this.choose_at(target);
      else if (this.is_on && target.closest(".body.robot")) this.choose({ kind: "robot", k: 0 });
    });
    svg.addEventListener("pointerdown", (event) => this.put(event), true);
    svg.addEventListener("pointermove", (event) => {
      if (this.drawn) {
        this.pointer = workspace.point(event);
        this.look();
      }
    });
    svg.addEventListener("dblclick", (event) => this.double(event));
  }

  mode(is_on: boolean): void {
    this.is_on = is_on;
    this.drawn = undefined;
    if (!is_on) this.chosen = undefined;
    this.workspace.svg.classList.toggle("editing", is_on);
    this.make_reachable();
    this.look();
    this.on_mode();
  }
  get is_drawing(): boolean {
    return this.drawn !== undefined;
  }
  get has_chosen(): boolean {
    return this.chosen?.kind === "obstacle";
  }

  private make_reachable(): void {
    [...this.workspace.layers.obstacles.children].forEach((path, k) => this.reachable(path, k));
  }
  private reachable(path: Element, k: number): void {
    if (!this.is_on) return ["tabindex", "role", "aria-label"].forEach((name) => path.removeAttribute(name));
    path.setAttribute("tabindex", "0");
    path.setAttribute("role", "button");
    const which: Which = { kind: "obstacle", k };
    const is_round = this.shapes?.has(which) && this.shapes.is_round(which);
    const keys = is_round
      ? "arrows move it, Delete removes it"
      : "arrows move it, brackets turn it, Delete removes it; its vertices follow";
    path.setAttribute("aria-label", `${path.querySelector("title")?.textContent}: ${keys}`);
  }

  show(source: string): void {
    this.shapes = Shapes.of(source);
    this.fault = "";
    if (this.chosen && !this.shapes.has(this.chosen)) this.chosen = undefined;
    if (this.draft && this.chosen) {
      this.outlined(this.chosen, this.draft); // newer than the source
    } else {
      this.make_reachable();
      if (this.is_on) this.restore();
    }
    this.look();
  }
  // Show outlines as in the text, without a draft that was refused.
  private restore(): void {
    for (const which of this.shapes!.all()) this.outlined(which, this.shapes!.rings(which));
  }
  refused(message: string): void {
    this.fault = message;
    this.look();
  }

  private path_of(which: Which): Element | undefined {
    return which.kind === "obstacle"
      ? this.workspace.layers.obstacles.children[which.k]
      : which.kind === "workspace"
        ? (this.workspace.layers.floor.querySelector(".room") ?? undefined)
        : undefined;
  }
  private outlined(which: Which, rings: Rings): void {
    const parts = this.shapes!.all().filter(({ kind }) => kind === which.kind);
    if (which.kind === "robot" ? parts.some((part) => this.shapes!.is_round(part)) : !rings.length) return; // drawn as it is read
    const of = (one: Rings) => {
      const { xy, ring } = plain(one);
      return outline(xy, ring);
    };
    if (which.kind === "robot")
      this.workspace.shaped(
        this.shapes!.all()
          .filter(({ kind }) => kind === "robot")
          .map((part) => of(same(part, which) ? rings : this.shapes!.rings(part)))
          .join(""),
      );
    else this.path_of(which)?.setAttribute("d", of(rings));
  }

  choose(which: Which | undefined): void {
    if (same(which, this.chosen) && this.frame.childElementCount) return;
    this.chosen = which && this.shapes?.has(which) ? which : undefined;
    this.draft = undefined;
    this.look();
    this.on_mode();
  }
  private choose_at(path: Element): void {
    const k = [...this.workspace.layers.obstacles.children].indexOf(path);
    if (this.is_on && k >= 0) this.choose({ kind: "obstacle", k });
  }

  // Map the world to the chosen polygon's coordinates; the robot has its own.
  private local({ x, y }: { x: number; y: number }): { x: number; y: number } {
    const at = this.workspace.robot;
    if (this.chosen?.kind !== "robot" || !at) return { x, y };
    const c = Math.cos(at.theta);
    const s = Math.sin(at.theta);
    const u = x - at.x;
    const v = y - at.y;
    return { x: c * u + s * v, y: c * v - s * u };
  }

  private draft?: Rings; // of the chosen polygon, while it is dragged
  private get rings(): Rings {
    return this.draft ?? this.shapes!.rings(this.chosen!);
  }

  private change(rings: Rings | Shapes, done: boolean): void {
    const which = this.chosen!;
    if (rings instanceof Shapes) {
      this.fault = "";
      if (done) this.shapes = rings;
      this.look();
      return this.on_change(rings.text(), done);
    }
    this.draft = done ? undefined : rings;
    this.outlined(which, rings);
    this.fault = "";
    const changed = this.shapes!.with(which, rings);
    if (done) this.shapes = changed;
    this.look();
    this.on_change(changed.text(), done);
  }

  // The chosen shape moved: its rings, or the scene with a round one elsewhere.
  private step_of(dx: number, dy: number, rings: Rings, shapes: Shapes): Rings | Shapes {
    const { step } = this.workspace;
    const by = [snapped(dx, step), snapped(dy, step)];
    if (!rings.length) return shapes.moved_by(this.chosen!, by[0]!, by[1]!);
    return rings.map((ring) => ring.map(([x, y]): Point => [moved(x, by[0]!), moved(y, by[1]!)]));
  }
  private turned(angle: number, rings: Rings): Rings {
    const { x, y } = this.middle(rings);
    const c = Math.cos(angle);
    const s = Math.sin(angle);
    const step = this.workspace.step;
    return rings.map((ring) =>
      ring.map(([p, q]): Point => {
        const u = number(p) - x;
        const v = number(q) - y;
        return [snapped(x + c * u - s * v, step), snapped(y + s * u + c * v, step)];
      }),
    );
  }
  private middle(rings: Rings): { x: number; y: number; top: number } {
    const { xy } = plain(rings.slice(0, 1));
    let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
    for (let k = 0; k < xy.length; k += 2) {
      x0 = Math.min(x0, xy[k]!);
      x1 = Math.max(x1, xy[k]!);
      y0 = Math.min(y0, xy[k + 1]!);
      y1 = Math.max(y1, xy[k + 1]!);
    }
    return { x: (x0 + x1) / 2, y: (y0 + y1) / 2, top: y1 };
  }
  private vertex_at(rings: Rings, { ring, vertex }: Spot, x: string, y: string): Rings {
    return rings.map((of, r) => (r === ring ? of.map((point, k): Point => (k === vertex ? [x, y] : point)) : of));
  }

  remove(): void {
    if (this.chosen?.kind !== "obstacle") return;
    this.shapes = this.shapes!.with(this.chosen, undefined);
    this.chosen = undefined;
    this.on_change(this.shapes.text(), true);
    this.look();
    this.on_mode();
  }
  private remove_vertex({ ring, vertex }: Spot): void {
    if (this.rings[ring]!.length <= 3) return;
    this.change(
      this.rings.map((of, r) => (r === ring ? of.filter((_, k) => k !== vertex) : of)),
      true,
    );
  }
  private insert({ ring, vertex }: Spot, at?: { x: number; y: number }): void {
    const of = this.rings[ring]!;
    const a = of[vertex]!;
    const b = of[(vertex + 1) % of.length]!;
    const { step } = this.workspace;
    const x = at?.x ?? (number(a[0]) + number(b[0])) / 2;
    const y = at?.y ?? (number(a[1]) + number(b[1])) / 2;
    this.change(
      this.rings.map((each, r) =>
        r === ring
          ? [...each.slice(0, vertex + 1), [snapped(x, step), snapped(y, step)] as Point, ...each.slice(vertex + 1)]
          : each,
      ),
      true,
    );
    this.focus({ ring, vertex: vertex + 1 });
  }
  private focus({ ring, vertex }: Spot): void {
    this.frame.querySelector<SVGElement>(`[data-spot="${ring} ${vertex}"]`)?.focus();
  }

  // Follow any drag: `to` makes the rings from the distance dragged.
  private follow(event: PointerEvent, to: (x: number, y: number) => Rings | Shapes, ended = () => {}): void {
    event.preventDefault();
    event.stopPropagation();
    const begin = this.local(this.workspace.point(event));
    let is_moved = false;
    const at = (now: PointerEvent) => {
      const p = this.local(this.workspace.point(now));
      return to(p.x - begin.x, p.y - begin.y);
    };
    this.workspace.pointers.follow(event, {
      move: (now) => {
        if (!is_moved && Math.hypot(now.clientX - event.clientX, now.clientY - event.clientY) < 3) return;
        is_moved = true;
        this.change(at(now), false);
      },
      end: (now) => {
        ended();
        if (is_moved) this.change(at(now), true);
      },
      cancel: () => {
        ended();
        if (is_moved) this.cancelled();
      },
    });
  }
  private cancelled(): void {
    this.draft = undefined;
    this.fault = "";
    this.restore();
    this.look();
    this.on_cancel();
  }

  private grab(event: PointerEvent): void {
    const path = event.target as Element;
    const k = [...this.workspace.layers.obstacles.children].indexOf(path);
    if (!this.is_on || this.drawn || event.button !== 0 || k < 0) return;
    this.choose({ kind: "obstacle", k });
    (path as SVGElement).focus({ preventScroll: true });
    const from = this.rings;
    const shapes = this.shapes!;
    this.follow(event, (dx, dy) => this.step_of(dx, dy, from, shapes));
  }

  private key(event: KeyboardEvent): void {
    if (!this.is_on || !this.chosen || event.ctrlKey || event.metaKey) return;
    const times = event.shiftKey ? 10 : event.altKey ? 0.1 : 1;
    const by = 8 * this.workspace.pixel * times;
    const turn = (Math.PI / 36) * times;
    const move = (dx: number, dy: number) => () => this.change(this.step_of(dx, dy, this.rings, this.shapes!), true);
    const rotate = (angle: number) => () => this.rings.length && this.change(this.turned(angle, this.rings), true);
    const act = {
      ArrowLeft: move(-by, 0),
      ArrowRight: move(by, 0),
      ArrowUp: move(0, by),
      ArrowDown: move(0, -by),
      Delete: () => this.remove(),
      Enter: () => this.focus({ ring: 0, vertex: 0 }),
      "[": rotate(turn),
      "]": rotate(-turn),
    }[event.key];
    if (act) {
      event.preventDefault();
      event.stopPropagation();
      act();
    }
  }
  private vertex_key(event: KeyboardEvent, spot: Spot): void {
    if (event.ctrlKey || event.metaKey) return;
    const by = 8 * this.workspace.pixel * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1);
    const { step } = this.workspace;
    const move = (dx: number, dy: number) => () => {
      const [x, y] = this.rings[spot.ring]![spot.vertex]!;
      const to = this.chosen!.kind === "robot" ? this.local_step(dx, dy) : { x: dx, y: dy };
      this.change(this.vertex_at(this.rings, spot, moved(x, snapped(to.x, step)), moved(y, snapped(to.y, step))), true);
    };
    const act = {
      ArrowLeft: move(-by, 0),
      ArrowRight: move(by, 0),
      ArrowUp: move(0, by),
      ArrowDown: move(0, -by),
      Delete: () => this.remove_vertex(spot),
      Backspace: () => this.remove_vertex(spot),
      Insert: () => this.insert(spot),
      "+": () => this.insert(spot),
    }[event.key];
    if (act) {
      event.preventDefault();
      event.stopPropagation();
      act();
    }
  }
  private local_step(dx: number, dy: number): { x: number; y: number } {
    const a = this.local({ x: 0, y: 0 });
    const b = this.local({ x: dx, y: dy });
    return { x: b.x - a.x, y: b.y - a.y };
  }

  // A new obstacle: a vertex a click, closed by a click on the first, a double click or Enter.
  draw(): void {
    if (!this.is_on) this.mode(true);
    this.drawn = [];
    this.chosen = undefined;
    this.pointer = undefined;
    this.workspace.svg.focus();
    this.look();
    this.on_mode();
  }
  private put(event: PointerEvent): void {
    if (!this.drawn || event.button !== 0) return;
    event.preventDefault();
    event.stopPropagation();
    this.workspace.pan(event, (at) => this.corner(at));
  }
  private corner(at: { x: number; y: number }): void {
    if (!this.drawn) return;
    const first = this.drawn[0];
    const last = this.drawn.at(-1);
    const near = NEAR * FINGER * this.workspace.pixel;
    if (first && this.drawn.length > 2 && Math.hypot(at.x - first.x, at.y - first.y) < near) return this.finish();
    if (last && Math.hypot(at.x - last.x, at.y - last.y) < near / 2)
      return this.drawn.length > 2 ? this.finish() : undefined;
    this.drawn.push(at);
    this.look();
  }
  finish(): void {
    if (!this.drawn) return;
    const { step, shown } = this.workspace;
    const x = shown.x + shown.w / 2;
    const y = shown.y + shown.h / 2;
    const r = 0.08 * Math.min(shown.w, shown.h);
    const points =
      this.drawn.length > 2
        ? this.drawn
        : [
            { x: x - r, y: y - r },
            { x: x + r, y: y - r },
            { x, y: y + r },
          ];
    this.drawn = undefined;
    const k = this.shapes!.all().filter(({ kind }) => kind === "obstacle").length;
    this.chosen = { kind: "obstacle", k };
    this.change([points.map(({ x, y }): Point => [snapped(x, step), snapped(y, step)])], true);
    this.on_mode();
  }
  cancel(): boolean {
    const was = this.is_drawing;
    this.drawn = undefined;
    this.look();
    this.on_mode();
    return was;
  }

  private double(event: MouseEvent): void {
    if (!this.is_on || this.drawn || !this.shapes || (event.target as Element).closest(".vertex")) return;
    const p = this.workspace.point(event);
    let best: { which: Which; spot: Spot; far: number } | undefined;
    for (const which of this.shapes.all()) {
      const kept = this.chosen;
      this.chosen = which;
      const at = this.local(p);
      this.chosen = kept;
      this.shapes.rings(which).forEach((ring, r) =>
        ring.forEach(([x, y], k) => {
          const [u, v] = ring[(k + 1) % ring.length]!;
          const ax = number(x);
          const ay = number(y);
          const dx = number(u) - ax;
          const dy = number(v) - ay;
          const share = Math.max(0, Math.min(1, ((at.x - ax) * dx + (at.y - ay) * dy) / (dx * dx + dy * dy)));
          const far = Math.hypot(at.x - ax - share * dx, at.y - ay - share * dy);
          if (!best || far < best.far) best = { which, spot: { ring: r, vertex: k }, far };
        }),
      );
    }
    if (!best || best.far > NEAR * FINGER * this.workspace.pixel) return;
    event.preventDefault();
    this.choose(best.which);
    this.insert(best.spot, this.local(p));
  }

  // Put the handles at their present places.
  look(): void {
    const px = this.workspace.pixel;
    const chosen = this.is_on && this.shapes && this.chosen;
    for (const path of this.workspace.layers.obstacles.children) path.classList.remove("chosen", "refused");
    if (this.drawn) return this.look_drawn();
    if (!chosen) return this.frame.replaceChildren();
    this.path_of(chosen)?.classList.add("chosen");
    if (this.fault) this.path_of(chosen)?.classList.add("refused");
    const at = chosen.kind === "robot" ? this.workspace.robot : undefined;
    const rings = this.rings;
    const name =
      chosen.kind === "robot" ? "the robot" : chosen.kind === "workspace" ? "the workspace" : `obstacle ${chosen.k}`;
    const spots = rings.flatMap((ring, r) =>
      ring.map(([x, y], k) => ({ x: number(x), y: number(y), spot: { ring: r, vertex: k } })),
    );
    this.frame.setAttribute("transform", at ? `translate(${at.x} ${at.y}) rotate(${(at.theta * 180) / Math.PI})` : "");
    const key = `${chosen.kind} ${chosen.k} ${rings.map((ring) => ring.length).join(" ")}`;
    if (this.frame.dataset.key !== key || !this.frame.childElementCount || this.frame.querySelector(".drawn")) {
      this.frame.replaceChildren();
      this.frame.dataset.key = key;
      for (const { spot } of spots.length > MOST ? [] : spots) {
        const handle = made("circle", this.frame, {
          class: "vertex",
          tabindex: 0,
          role: "button",
          "data-spot": `${spot.ring} ${spot.vertex}`,
        });
        handle.addEventListener("pointerdown", (event) => {
          if (event.button !== 0) return;
          handle.focus({ preventScroll: true });
          const from = this.rings;
          const [x, y] = from[spot.ring]![spot.vertex]!;
          const { step } = this.workspace;
          this.follow(event, (dx, dy) =>
            this.vertex_at(from, spot, snapped(number(x) + dx, step), snapped(number(y) + dy, step)),
          );
        });
        handle.addEventListener("keydown", (event) => this.vertex_key(event, spot));
      }
      if (chosen.kind === "obstacle" && rings.length) this.knob();
    }
    this.frame.querySelectorAll<SVGElement>(".vertex").forEach((handle, k) => {
      const { x, y, spot } = spots[k]!;
      for (const [name_of, of] of Object.entries({ cx: x, cy: y, r: 5.5 * FINGER * px }))
        handle.setAttribute(name_of, String(of));
      handle.setAttribute(
        "aria-label",
        `vertex ${spot.vertex} of ${name}: x ${rings[spot.ring]![spot.vertex]![0]}, y ${rings[spot.ring]![spot.vertex]![1]}`,
      );
    });
    const knob = this.frame.querySelector(".knob");
    if (knob && !this.turning) {
      const { x, top } = this.middle(rings);
      knob.setAttribute("cx", String(x));
      knob.setAttribute("cy", String(top + 24 * px));
      knob.setAttribute("r", String(6 * FINGER * px));
    }
    this.frame.querySelector(".fault")?.remove();
    const place = /\((-?[\d./]+), (-?[\d./]+)\)/.exec(this.fault);
    if (place) made("circle", this.frame, { class: "fault", cx: number(place[1]!), cy: number(place[2]!), r: 9 * px });
  }
  private turning = false;
  private knob(): void {
    const knob = made("circle", this.frame, { class: "knob" });
    made("title", knob).textContent = "Turn it";
    knob.addEventListener("pointerdown", (event) => {
      const from = this.rings;
      const { x, y } = this.middle(from);
      const at = this.workspace.point(event);
      const first = Math.atan2(at.y - y, at.x - x);
      this.turning = true;
      this.follow(
        event,
        (dx, dy) => {
          knob.setAttribute("cx", String(at.x + dx));
          knob.setAttribute("cy", String(at.y + dy));
          return this.turned(Math.atan2(at.y + dy - y, at.x + dx - x) - first, from);
        },
        () => {
          this.turning = false;
          this.look();
        },
      );
    });
  }
  private look_drawn(): void {
    const points = [...this.drawn!, ...(this.pointer ? [this.pointer] : [])];
    const px = this.workspace.pixel;
    this.frame.replaceChildren();
    this.frame.setAttribute("transform", "");
    made("path", this.frame, {
      class: "drawn",
      d: points.map(({ x, y }, k) => `${k ? "L" : "M"}${x} ${y}`).join("") + (points.length > 2 ? "Z" : ""),
    });
    for (const { x, y } of this.drawn!) made("circle", this.frame, { class: "vertex", cx: x, cy: y, r: 5 * px });
  }
}
