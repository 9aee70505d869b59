// Plain SVG files as scenes, their numbers exactly; y points upwards in a scene, so (x, y) of the drawing is (x, -y).
//
// Groups, rectangles, circles, polygons, polylines and paths of lines and circular arcs are read, as `cfree` reads them. Texts,
// pictures and open lines are left out and counted. Anything else that would change a shape is refused with the command that
// reads it.
import {
  ONE,
  ZERO,
  type Fraction,
  decimal,
  equal,
  float,
  fraction,
  is_less,
  is_zero,
  minus,
  negative,
  over,
  plus,
  root,
  text,
  times,
} from "./fraction";
import { json_of } from "./shapes";
import { parse, stringify } from "lossless-json";

type Point = [Fraction, Fraction];
type Matrix = [Fraction, Fraction, Fraction, Fraction, Fraction, Fraction];
// On to a point, by a line or by an arc about a center.
interface Piece {
  to: Point;
  center?: Point;
  through?: Point; // of an arc whose center is irrational
  is_clockwise?: boolean;
}
interface Ring {
  from: Point;
  pieces: Piece[];
  is_closed: boolean;
}

export interface Drawing {
  source: string; // a scene
  left_out: string; // empty if nothing is
}

const convert = (file: string, options = "") => `\`cfree convert ${file} scene.json${options}\``;
const number_of = (value: string): Fraction => {
  const read = decimal(value.trim());
  if (!read) throw new Error(`"${value.slice(0, 40)}": expected a number`);
  return read;
};
const NUMBER = /[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?/g;
const numbers_of = (value: string): Fraction[] => {
  if (value.replace(NUMBER, "").replace(/[\s,]/g, "")) throw new Error(`"${value.slice(0, 40)}": expected numbers`);
  return (value.match(NUMBER) ?? []).map(number_of);
};

const compose = ([a, b, c, d, e, f]: Matrix, [p, q, r, s, t, u]: Matrix): Matrix => [
  plus(times(a, p), times(c, q)),
  plus(times(b, p), times(d, q)),
  plus(times(a, r), times(c, s)),
  plus(times(b, r), times(d, s)),
  plus(plus(times(a, t), times(c, u)), e),
  plus(plus(times(b, t), times(d, u)), f),
];
const moved_by = (x: Fraction, y: Fraction): Matrix => [ONE, ZERO, ZERO, ONE, x, y];
const place = ([a, b, c, d, e, f]: Matrix, [x, y]: Point): Point => [
  plus(plus(times(a, x), times(c, y)), e),
  plus(plus(times(b, x), times(d, y)), f),
];

// Exact for quarter turns, else decimals of 14 digits.
function turned_by(degrees: Fraction): Matrix {
  const quarters = over(degrees, fraction(90n));
  const whole = quarters.n / quarters.d - (quarters.n < 0n && quarters.n % quarters.d ? 1n : 0n);
  const angle = (float(minus(quarters, fraction(whole))) * Math.PI) / 2;
  const short = (c: number) => decimal(c.toPrecision(14))!;
  let [c, s] = angle === 0 ? [ONE, ZERO] : [short(Math.cos(angle)), short(Math.sin(angle))];
  for (let k = ((whole % 4n) + 4n) % 4n; k > 0n; --k) [c, s] = [negative(s), c];
  return [c, s, negative(s), c, ZERO, ZERO];
}

function transform_of(value: string): Matrix {
  let all: Matrix = moved_by(ZERO, ZERO);
  const calls = [...value.matchAll(/([a-zA-Z]+)\s*\(([^()]*)\)/g)];
  if (value.replace(/([a-zA-Z]+)\s*\(([^()]*)\)/g, "").replace(/[\s,]/g, ""))
    throw new Error(`transform "${value.slice(0, 40)}"`);
  for (const [, name, content] of calls) {
    const of = numbers_of(content!);
    const [x, y, z] = of;
    const made = (): Matrix | undefined => {
      if (name === "matrix" && of.length === 6) return of as Matrix;
      if (name === "translate" && (of.length === 1 || of.length === 2)) return moved_by(x!, y ?? ZERO);
      if (name === "scale" && (of.length === 1 || of.length === 2)) return [x!, ZERO, ZERO, y ?? x!, ZERO, ZERO];
      if (name === "rotate" && of.length === 1) return turned_by(x!);
      if (name === "rotate" && of.length === 3)
        return compose(compose(moved_by(y!, z!), turned_by(x!)), moved_by(negative(y!), negative(z!)));
      return undefined;
    };
    const by = made();
    if (!by) throw new Error(`transform "${name}(${content!.slice(0, 40)})"`);
    all = compose(all, by);
  }
  return all;
}

const squared = ([x, y]: Point) => plus(times(x, x), times(y, y));
const from_to = (p: Point, q: Point): Point => [minus(q[0], p[0]), minus(q[1], p[1])];
const is_same = (p: Point, q: Point) => equal(p[0], q[0]) && equal(p[1], q[1]);

// An arc of a circle to a point, as path data has it.
function arc_to(from: Point, to: Point, radius: Fraction, is_large: boolean, is_rising: boolean): Piece {
  const along = from_to(from, to);
  const half = fraction(1n, 2n);
  const middle: Point = [plus(from[0], times(half, along[0])), plus(from[1], times(half, along[1]))];
  // the center is beside the middle, by a share of the chord
  const square = minus(over(times(radius, radius), squared(along)), fraction(1n, 4n));
  const is_clockwise = !is_rising; // in the drawing's axes, where y grows to the left of x
  const side = is_large === is_rising ? -1n : 1n;
  const beside = (share: Fraction): Point => [
    minus(middle[0], times(share, along[1])),
    plus(middle[1], times(share, along[0])),
  ];
  if (!is_less(ZERO, square)) return { to, center: middle, is_clockwise }; // too small a radius, or a half circle
  const exact = root(square);
  if (exact) return { to, center: beside(fraction(side * exact.n, exact.d)), is_clockwise };
  // the middle of the arc, on the other side of the chord than a center near it
  const share = Math.sqrt(float(square));
  const height = Math.sqrt(share * share + 0.25) + (is_large ? share : -share);
  const through = decimal((is_rising ? -height : height).toFixed(15))!;
  return { to, through: beside(through) };
}

const COMMANDS: Record<string, number> = { M: 2, L: 2, H: 1, V: 1, A: 7, Z: 0 };

function rings_of_path(data: string): Ring[] {
  const rings: Ring[] = [];
  let at: Point = [ZERO, ZERO];
  let ring: Ring | undefined;
  const chunks = [...data.matchAll(/([a-zA-Z])([^a-zA-Z]*(?:[eE][-+]?\d[^a-zA-Z]*)*)/g)];
  if (!/^\s*([mM]|$)/.test(data)) throw new Error("path data that begins without M");
  for (const [, letter, content] of chunks) {
    const command = letter!.toUpperCase();
    if (!(command in COMMANDS)) throw new Error(`path data ${letter}: curves`);
    const is_relative = letter !== command;
    const count = COMMANDS[command]!;
    if (command === "Z") {
      if (content!.trim()) throw new Error("path data: numbers after Z");
      if (ring) {
        ring.is_closed = true;
        at = ring.from;
      }
      ring = undefined;
      continue;
    }
    const tokens = command === "A" ? arc_numbers(content!) : numbers_of(content!);
    if (!tokens.length || tokens.length % count) throw new Error(`path data ${letter}: too few numbers`);
    for (let k = 0; k < tokens.length; k += count) {
      const of = tokens.slice(k, k + count);
      const x = is_relative ? at[0] : ZERO;
      const y = is_relative ? at[1] : ZERO;
      const end: Point =
        command === "H"
          ? [plus(x, of[0]!), at[1]]
          : command === "V"
            ? [at[0], plus(y, of[0]!)]
            : [plus(x, of[count - 2]!), plus(y, of[count - 1]!)];
      if (command === "M" && k === 0) {
        ring = { from: end, pieces: [], is_closed: false };
        rings.push(ring);
      } else {
        if (!ring) rings.push((ring = { from: at, pieces: [], is_closed: false }));
        const [rx, ry] = of.slice(0, 2).map((r) => (r.n < 0n ? negative(r) : r));
        if (is_same(at, end)) void 0;
        else if (command !== "A" || is_zero(rx!) || is_zero(ry!)) ring.pieces.push({ to: end });
        else if (!equal(rx!, ry!)) throw new Error("an arc of an ellipse");
        else ring.pieces.push(arc_to(at, end, rx!, !is_zero(of[3]!), !is_zero(of[4]!)));
      }
      at = end;
    }
  }
  return rings.filter(({ pieces }) => pieces.length);
}
// The flags of arcs may stand without a space before the next number.
function arc_numbers(content: string): Fraction[] {
  const found: Fraction[] = [];
  let rest = content;
  for (let k = 0; (rest = rest.replace(/^[\s,]+/, "")); ++k) {
    const pattern = k % 7 === 3 || k % 7 === 4 ? /^[01]/ : new RegExp(`^${NUMBER.source}`);
    const item = pattern.exec(rest)?.[0];
    if (!item) throw new Error("path data A: expected numbers and flags");
    found.push(number_of(item));
    rest = rest.slice(item.length);
  }
  return found;
}

const chain = (points: Point[], is_closed: boolean): Ring[] =>
  points.length < 2 ? [] : [{ from: points[0]!, pieces: points.slice(1).map((to) => ({ to })), is_closed }];

function circle_about(center: Point, r: Fraction): Ring[] {
  const [east, west]: Point[] = [
    [plus(center[0], r), center[1]],
    [minus(center[0], r), center[1]],
  ];
  const pieces = [west!, east!].map((to) => ({ to, center, is_clockwise: false }));
  return [{ from: east!, pieces, is_closed: true }];
}

function rounded_rectangle(x: Fraction, y: Fraction, w: Fraction, h: Fraction, r: Fraction): Ring[] {
  const [left, right, low, high] = [plus(x, r), minus(plus(x, w), r), plus(y, r), minus(plus(y, h), r)];
  const [far_x, far_y] = [plus(x, w), plus(y, h)];
  const ring: Ring = { from: [left, y], pieces: [], is_closed: true };
  const corner = (line: Point, to: Point, center: Point) => {
    if (!is_same(ring.pieces.at(-1)?.to ?? ring.from, line)) ring.pieces.push({ to: line });
    ring.pieces.push({ to, center, is_clockwise: false });
  };
  corner([right, y], [far_x, low], [right, low]);
  corner([far_x, high], [right, far_y], [right, high]);
  corner([left, far_y], [x, high], [left, high]);
  corner([x, low], [left, y], [left, low]);
  return [ring];
}

const SKIPPED =
  /^(defs|metadata|title|desc|script|linearGradient|radialGradient|pattern|marker|filter|symbol|clipPath|mask|namedview)$/;
const COUNTED: Record<string, string> = {
  text: "text",
  image: "picture",
  foreignObject: "foreign object",
  animate: "animation",
};
const SHAPES = ["rect", "circle", "ellipse", "polygon", "polyline", "line", "path"];
const SVG = "http://www.w3.org/2000/svg";
const DEEPEST = 100;

interface State {
  frame: Matrix;
  names: string[];
  is_filled: boolean;
  is_even_odd: boolean;
}
interface Item {
  role: "robot" | "obstacle" | "workspace";
  name: string;
  shapes: Ring[][]; // outer ring, then holes
}

class Reader {
  readonly items: Item[] = [];
  pivot?: Point;
  private readonly less = new Map<string, number>();
  private rounded = 0; // arcs with rounded centers
  constructor(private readonly file: string) {}

  get left_out(): string {
    const many = (count: number, what: string) => `${count} ${what}${count > 1 ? "s" : ""}`;
    const lost = [...this.less].map(([what, count]) => many(count, what));
    const lines = this.less.has("open line") ? `; ${convert(this.file, " --strokes drawn")} makes walls of lines` : "";
    const near = this.rounded ? [`Of ${many(this.rounded, "arc")} the center is rounded.`] : [];
    return [...(lost.length ? [`Left out: ${lost.join(", ")}${lines}.`] : []), ...near].join(" ");
  }
  private leave_out(what: string): void {
    this.less.set(what, (this.less.get(what) ?? 0) + 1);
  }

  walk(element: Element, outer: State, depth: number): void {
    const tag = element.localName;
    if (element.namespaceURI !== SVG && element.namespaceURI !== null) return;
    if (depth > DEEPEST) throw this.unread("elements nested more than 100 deep");
    if (tag === "style") {
      if (element.textContent!.trim()) throw this.unread("a style sheet");
      return;
    }
    if (SKIPPED.test(tag)) return;
    if (COUNTED[tag]) return this.leave_out(COUNTED[tag]!);
    const style = this.style_of(element);
    if (style.get("display") === "none") return this.leave_out("hidden element");
    if (!["visible", undefined].includes(style.get("visibility"))) throw this.unread(`${tag}: visibility`);
    for (const key of ["clip-path", "mask"])
      if ((style.get(key) ?? "none") !== "none") throw this.unread(`${tag}: ${key}`);
    const own = ["data-role", "inkscape:label", "label", "data-name", "id", "class"]
      .map((key) => element.getAttribute(key))
      .filter((name): name is string => !!name);
    const transform = depth ? element.getAttribute("transform") : null;
    const state: State = {
      frame: transform
        ? compose(
            outer.frame,
            this.tried(() => transform_of(transform)),
          )
        : outer.frame,
      names: [...own, ...outer.names],
      is_filled: style.has("fill") ? style.get("fill") !== "none" : outer.is_filled,
      is_even_odd: style.has("fill-rule") ? style.get("fill-rule") === "evenodd" : outer.is_even_odd,
    };
    if (SHAPES.includes(tag)) return this.tried(() => this.add(element, state));
    if (tag !== "g" && tag !== "a" && (tag !== "svg" || depth)) throw this.unread(`the element ${tag.slice(0, 40)}`);
    for (const child of element.children) this.walk(child, state, depth + 1);
  }

  private style_of(element: Element): Map<string, string> {
    const style = new Map<string, string>();
    for (const key of ["fill", "fill-rule", "display", "visibility", "clip-path", "mask"]) {
      const value = element.getAttribute(key);
      if (value !== null) style.set(key, value.trim());
    }
    for (const part of (element.getAttribute("style") ?? "").split(";")) {
      const [key, value] = part.split(":").map((of) => of.trim().toLowerCase());
      if (!key || value === undefined) continue;
      if (/^(transform.*|translate|rotate|scale|d|x|y|cx|cy|r|rx|ry|width|height|all)$/.test(key))
        throw this.unread(`${key} in a style`);
      style.set(key, value.replace(/\s*!important$/, ""));
    }
    return style;
  }

  private add(element: Element, state: State): void {
    const rings = this.rings_of(element);
    if (!rings.length) return;
    const [a, b, c, d] = state.frame;
    if (is_zero(minus(times(a, d), times(b, c)))) return this.leave_out("shape that its transform makes flat");
    if (state.names[0]?.toLowerCase() === "pivot") return this.mark(rings, state.frame);
    if (!state.is_filled || element.localName === "line") {
      if (rings.some(({ is_closed, from, pieces }) => !is_closed && !is_same(from, pieces.at(-1)!.to)))
        return this.leave_out("open line");
      if (rings.length > 1) throw new Error("an unfilled path of several outlines");
    }
    const placed = rings.map((ring) => this.placed(ring, state.frame));
    const mark = state.names.map((name) => /^(robot|obstacle|workspace)(?![a-z])/i.exec(name)).find(Boolean);
    const role = (mark?.[1]!.toLowerCase() ?? "obstacle") as Item["role"];
    const name = state.names.find((of) => of.toLowerCase() !== "obstacle") ?? "";
    this.items.push({ role, name, shapes: nested(placed, state.is_even_odd) });
  }

  private rings_of(element: Element): Ring[] {
    const value = (key: string) => {
      const of = element.getAttribute(key)?.trim();
      return of ? number_of(of.replace(/px$/, "")) : ZERO;
    };
    const size = (key: string) => {
      const of = value(key);
      return is_less(of, ZERO) ? ZERO : of;
    };
    switch (element.localName) {
      case "path":
        return rings_of_path(element.getAttribute("d") ?? "");
      case "polygon":
      case "polyline": {
        const c = numbers_of(element.getAttribute("points") ?? "");
        const points = Array.from({ length: c.length >> 1 }, (_, k): Point => [c[2 * k]!, c[2 * k + 1]!]);
        return chain(
          points.filter((p, k) => k === 0 || !is_same(p, points[k - 1]!)),
          element.localName === "polygon",
        );
      }
      case "line":
        return chain(
          [
            [value("x1"), value("y1")],
            [value("x2"), value("y2")],
          ],
          false,
        );
      case "rect": {
        const [x, y, w, h] = [value("x"), value("y"), size("width"), size("height")];
        if (is_zero(w) || is_zero(h)) return [];
        const given = ["rx", "ry"].map((key) =>
          (element.getAttribute(key) ?? "auto") === "auto" ? undefined : size(key),
        );
        const half = (of: Fraction, most: Fraction) => {
          const least = over(most, fraction(2n));
          return is_less(least, of) ? least : of;
        };
        const [rx, ry] = [half(given[0] ?? given[1] ?? ZERO, w), half(given[1] ?? given[0] ?? ZERO, h)];
        const right = plus(x, w);
        const high = plus(y, h);
        const corners: Point[] = [
          [x, y],
          [right, y],
          [right, high],
          [x, high],
        ];
        if (is_zero(rx) || is_zero(ry)) return chain(corners, true);
        if (!equal(rx, ry)) throw new Error("a rectangle with elliptic corners");
        return rounded_rectangle(x, y, w, h, rx);
      }
      default: {
        const is_circle = element.localName === "circle";
        const [rx, ry] = [size(is_circle ? "r" : "rx"), size(is_circle ? "r" : "ry")];
        if (is_zero(rx) || is_zero(ry)) return [];
        if (!equal(rx, ry)) throw new Error("an ellipse");
        return circle_about([value("cx"), value("cy")], rx);
      }
    }
  }

  private placed(ring: Ring, frame: Matrix): Ring {
    const [a, b, c, d] = frame;
    const has_arcs = ring.pieces.some(({ center, through }) => center || through);
    const is_similar = equal(squared([a, b]), squared([c, d])) && is_zero(plus(times(a, c), times(b, d)));
    if (has_arcs && !is_similar) throw new Error("an arc that its transform stretches or turns");
    const is_mirrored = is_less(minus(times(a, d), times(b, c)), ZERO);
    return {
      ...ring,
      from: place(frame, ring.from),
      pieces: ring.pieces.map(({ to, center, through, is_clockwise }) => {
        if (through) ++this.rounded;
        return {
          to: place(frame, to),
          ...(center && { center: place(frame, center), is_clockwise: is_clockwise !== is_mirrored }),
          ...(through && { through: place(frame, through) }),
        };
      }),
    };
  }

  private mark(rings: Ring[], frame: Matrix): void {
    if (this.pivot) throw new Error("several pivots");
    const points = rings.flatMap(({ from, pieces }) => [from, ...pieces.map(({ to }) => to)]);
    const center = rings[0]!.pieces[0]!.center;
    const middle = (k: 0 | 1) => {
      const sorted = points.map((p) => p[k]).sort((p, q) => (is_less(p, q) ? -1 : 1));
      return times(plus(sorted[0]!, sorted.at(-1)!), fraction(1n, 2n));
    };
    this.pivot = place(frame, center ?? [middle(0), middle(1)]);
  }

  private tried<T>(act: () => T): T {
    try {
      return act();
    } catch (error) {
      throw error instanceof Unread ? error : this.unread((error as Error).message);
    }
  }
  unread(what: string, options = ""): Unread {
    const curved = /curve|ellip|stretches/.test(what) ? " --outer 0.01" : options;
    return new Unread(`${this.file}: ${what}. The page reads plain SVG; ${convert(this.file, curved)} reads more.`);
  }
}

class Unread extends Error {}

// Outer rings with their holes: rings inside of others, by the fill rule. Crossings are left to the core, which refuses them.
function nested(rings: Ring[], is_even_odd: boolean): Ring[][] {
  if (rings.length === 1) return [rings];
  const outlines = rings.map(({ from, pieces }) => {
    const points = [from];
    for (const { to, center, through, is_clockwise } of pieces) {
      if (through) points.push(through);
      if (center) points.push(...middles(points.at(-1)!, to, center, is_clockwise!));
      points.push(to);
    }
    return points.map(([x, y]): [number, number] => [float(x), float(y)]);
  });
  const around = rings.map((_, k) =>
    rings.map((_, j) => j).filter((j) => j !== k && is_within(outlines[k]![0]!, outlines[j]!)),
  );
  const turn = outlines.map((points) => Math.sign(area_of(points)));
  const winding = (k: number) => turn[k]! + around[k]!.reduce((sum, j) => sum + turn[j]!, 0);
  const is_inside = (k: number) => (is_even_odd ? around[k]!.length % 2 === 0 : winding(k) !== 0);
  const was_inside = (k: number) => (is_even_odd ? around[k]!.length % 2 === 1 : winding(k) !== turn[k]!);
  const outer = rings.map((_, k) => k).filter((k) => is_inside(k) && !was_inside(k));
  const depth = (k: number) => around[k]!.length;
  return outer.map((k) => {
    const inner = (j: number) =>
      !is_inside(j) &&
      was_inside(j) &&
      around[j]!.includes(k) &&
      !outer.some((other) => around[j]!.includes(other) && depth(other) > depth(k));
    return [rings[k]!, ...rings.filter((_, j) => inner(j))];
  });
}
// Points of an arc at its quarters, about.
function middles(from: Point, to: Point, center: Point, is_clockwise: boolean): Point[] {
  const [u, v] = [from_to(center, from), from_to(center, to)].map(([x, y]) => Math.atan2(float(y), float(x)));
  const r = Math.sqrt(float(squared(from_to(center, from))));
  const turn = is_clockwise ? -1 : 1;
  const sweep = ((((v! - u!) * turn) % (2 * Math.PI)) + 2 * Math.PI) % (2 * Math.PI) || 2 * Math.PI;
  return [0.25, 0.5, 0.75].map((share) => {
    const angle = u! + turn * share * sweep;
    const near = (middle: Fraction, off: number) => plus(middle, decimal((r * off).toPrecision(15))!);
    return [near(center[0], Math.cos(angle)), near(center[1], Math.sin(angle))];
  });
}
const area_of = (points: [number, number][]) =>
  points.reduce((sum, [x, y], k) => {
    const [p, q] = points[(k + 1) % points.length]!;
    return sum + x * q - y * p;
  }, 0);
function is_within([x, y]: [number, number], points: [number, number][]): boolean {
  let is = false;
  points.forEach(([px, py], k) => {
    const [qx, qy] = points[(k + 1) % points.length]!;
    if (py > y !== qy > y && x < px + ((y - py) / (qy - py)) * (qx - px)) is = !is;
  });
  return is;
}

const point_json = ([x, y]: Point) => [json_of(text(x)), json_of(text(y))];
function ring_json(ring: Ring): { items: unknown[]; is_round: boolean } {
  const { from } = ring;
  const pieces = [...ring.pieces];
  const is_shut = is_same(pieces.at(-1)!.to, from);
  const is_round = pieces.some(({ center, through }) => center || through);
  if (is_shut && !pieces.at(-1)!.center && !pieces.at(-1)!.through) pieces.pop();
  const items = pieces.map(({ to, center, through, is_clockwise }) =>
    through
      ? { arc: { to: point_json(to), through: point_json(through) } }
      : center
        ? { arc: { to: point_json(to), center: point_json(center), ...(is_clockwise && { clockwise: true }) } }
        : point_json(to),
  );
  return { items: [point_json(from), ...items], is_round };
}
function shape_json([outer, ...holes]: Ring[], name?: string): Record<string, unknown> {
  const [first, ...others] = [outer!, ...holes].map(ring_json);
  const is_round = [first!, ...others].some((ring) => ring.is_round);
  return {
    ...(name && { name }),
    [is_round && !others.length ? "path" : "outer"]: first!.items,
    ...(others.length && { holes: others.map(({ items }) => items) }),
    ...(is_round && others.length && { outer: undefined, path: first!.items }),
  };
}

function unit_of(root_element: Element): { scale: Fraction; unit: string } {
  const length = (key: string) =>
    /^\s*([-+.\deE]+?)\s*(mm|cm|in|pt|pc|px|Q|m)?\s*$/.exec(root_element.getAttribute(key) ?? "");
  const width = length("width");
  const box = root_element.getAttribute("viewBox");
  if (!width || !box || !width[2] || width[2] === "px") return { scale: ONE, unit: "px" };
  const sizes = numbers_of(box);
  const height = length("height");
  if (sizes.length !== 4) throw new Error("viewBox: expected four numbers");
  const x = over(number_of(width[1]!), sizes[2]!);
  const y = height && height[2] === width[2] ? over(number_of(height[1]!), sizes[3]!) : x;
  if (!equal(x, y)) throw new Error("viewBox, width and height of different shapes");
  return { scale: x, unit: width[2] };
}

// The document is never shown, and none of its scripts runs.
interface Policies {
  createPolicy(name: string, rules: { createHTML(text: string): string }): { createHTML(text: string): string };
}
let policy: ReturnType<Policies["createPolicy"]> | undefined;
function parsed(content: string): Document {
  const policies = (window as unknown as { trustedTypes?: Policies }).trustedTypes;
  policy ??= policies?.createPolicy("drawing", { createHTML: (of) => of });
  return new DOMParser().parseFromString(policy ? policy.createHTML(content) : content, "image/svg+xml");
}

const SETTINGS = ["bounds", "start", "goal", "goals", "vehicle", "units", "note"];

// The scene of an SVG file. Throws an error with a command where it is not plain.
export function scene_of_svg(content: string, file: string): Drawing {
  const document = parsed(content);
  const fault = document.querySelector("parsererror");
  if (fault) {
    const [line] = /error on line [^\n]*/.exec(fault.textContent!) ?? [fault.textContent!];
    throw new Error(`${file}: no SVG: ${line.replace(/\s+/g, " ").slice(0, 160)}`);
  }
  const svg = document.documentElement;
  const reader = new Reader(file);
  if (svg.localName !== "svg") throw reader.unread(`the element ${svg.localName.slice(0, 40)}, not svg`);
  let unit: { scale: Fraction; unit: string };
  try {
    unit = unit_of(svg);
  } catch (error) {
    throw reader.unread((error as Error).message);
  }
  const frame: Matrix = [unit.scale, ZERO, ZERO, negative(unit.scale), ZERO, ZERO];
  reader.walk(svg, { frame, names: [], is_filled: true, is_even_odd: false }, 0);
  const of = (role: Item["role"]) => reader.items.filter((item) => item.role === role);
  const robot = of("robot").flatMap(({ shapes }) => shapes);
  if (!robot.length) {
    const remedy = convert(file, " --robot robot.json");
    throw new Error(`${file}: nothing is called robot. Give a group or an element the id "robot", or use ${remedy}.`);
  }
  const rooms = of("workspace").flatMap(({ shapes }) => shapes);
  if (rooms.length > 1) throw reader.unread(`${rooms.length} workspaces`);
  const { pivot } = reader;
  const back: Matrix = moved_by(negative(pivot?.[0] ?? ZERO), negative(pivot?.[1] ?? ZERO));
  const moved = (ring: Ring): Ring => ({
    ...ring,
    from: place(back, ring.from),
    pieces: ring.pieces.map((piece) => ({
      ...piece,
      to: place(back, piece.to),
      ...(piece.center && { center: place(back, piece.center) }),
      ...(piece.through && { through: place(back, piece.through) }),
    })),
  });
  let given: Record<string, unknown> = {};
  const data = svg.getAttribute("data-cfree");
  if (data) {
    try {
      given = parse(data) as Record<string, unknown>;
    } catch {
      throw reader.unread("data-cfree is no JSON");
    }
  }
  const settings = Object.fromEntries(SETTINGS.flatMap((key) => (given[key] == null ? [] : [[key, given[key]]])));
  const scene = {
    version: 1,
    name: typeof given.scene === "string" ? given.scene : file.replace(/\.\w+$/, ""),
    ...(data ? {} : { units: unit.unit }),
    ...(pivot && !settings.start ? { start: [...point_json(pivot), 0] } : {}),
    ...settings,
    robot: robot.map((shape) => shape_json(shape.map(moved))),
    obstacles: of("obstacle").flatMap(({ shapes, name }) => shapes.map((shape) => shape_json(shape, name))),
    ...(rooms.length && { workspace: shape_json(rooms[0]!) }),
  };
  return { source: stringify(scene)!, left_out: reader.left_out };
}
