// The legend of the right view: colours of the patches and lines that are there, as they are coloured now.
import { type ColourBy, LEGENDS, gradient, of_number, range_of } from "./colours";
import { type Columns, bytes, integers } from "./engine";
import { $ } from "./page";
import { obstacle_name } from "./verdict";

export interface Entry {
  mark: "ve" | "ev" | "aa" | "he" | "se" | "ba" | "own";
  text: string;
  colour?: string; // of its own
}
const MOST = 8; // colours of cells and obstacles, before they come again
const OF_POLYGONS: Entry[] = [
  { mark: "ve", text: "vertex on edge" },
  { mark: "ev", text: "edge on vertex" },
  { mark: "he", text: "helix" },
  { mark: "se", text: "edge on edge" },
];

// Among rounded shapes an arc stands for a vertex that is grown. Contacts with the bounds are those of the reference point.
export function entries(mesh: Columns): Entry[] {
  if (!mesh.grown) return OF_POLYGONS;
  const [kind, grown, owner] = [bytes(mesh, "kind"), bytes(mesh, "grown"), integers(mesh, "owner")];
  // the arcs of each kind of patch that there is: of the robot 1, of an obstacle 2
  const found = [0, 1, 2].map((of) => new Set(grown.filter((_, k) => kind[k] === of && owner[k] !== -1)));
  const name = (of: number, bit: number) =>
    ["arc", "vertex"].filter((_, k) => [...found[of]!].some((arcs) => (arcs & bit) > 0 === (k === 0))).join(" or ");
  const patches: (Entry & { is: boolean })[] = [
    { mark: "ve", text: `${name(0, 1)} on edge`, is: found[0]!.size > 0 },
    { mark: "ev", text: `edge on ${name(1, 2)}`, is: found[1]!.size > 0 },
    { mark: "aa", text: `${name(2, 1)} on ${name(2, 2)}`, is: found[2]!.size > 0 },
  ];
  const lines = new Set(bytes(mesh, "line_kind"));
  const curves = [...(lines.has(1) ? ["helix"] : []), ...(lines.has(3) ? ["smooth joint"] : [])].join(", ");
  return [
    ...patches.filter(({ is }) => is).map(({ mark, text }) => ({ mark, text })),
    ...(curves ? [{ mark: "he", text: curves } as const] : []),
    ...(lines.has(2) ? [{ mark: "se", text: "edge on edge" } as const] : []),
  ];
}

// Colours of numbers, each with its name; of many the first.
function numbered(column: Int32Array, name: (k: number) => string): Entry[] {
  const all = [...new Set(column)].sort((a, b) => (a < 0 || b < 0 ? b - a : a - b));
  const shown = all.slice(0, MOST).map((k): Entry => ({ mark: "own", text: name(k), colour: of_number(k) }));
  const more = all.length - shown.length;
  return more > 0 ? [...shown, { mark: "own", text: `${more} more in these colours`, colour: "transparent" }] : shown;
}

// The entries of a colouring; lines keep their colours in all of them, and so does the surface of a proof.
export function coloured(mesh: Columns, by: ColourBy, names: string[], has_proof: boolean): Entry[] {
  const contacts = entries(mesh);
  const lines = contacts.filter(({ mark }) => mark === "he" || mark === "se");
  const own = {
    contact: () => contacts,
    cell: () => [...numbered(integers(mesh, "cell"), (k) => (k < 0 ? "no cell" : `cell ${k}`)), ...lines],
    obstacle: () => [...numbered(integers(mesh, "owner"), (k) => obstacle_name(names, k)), ...lines],
    gaussian: () => lines,
    mean: () => lines,
  }[by]();
  return has_proof ? [...own, { mark: "ba", text: "separates start and goal" }] : own;
}

export function show_legend(shown: Entry[]): void {
  $("legend").replaceChildren(
    ...shown.flatMap(({ mark, text, colour }) => {
      const name = document.createElement("span");
      const sign = document.createElement("i");
      sign.className = mark;
      if (colour) sign.style.background = colour;
      name.append(sign, text);
      return [name, " "];
    }),
  );
}

// The scale of values, from the first colour to the last, and its words.
export function show_scale(mesh: Columns, by: ColourBy, clearance: Float64Array | undefined, units: string): void {
  const digits = (of: number) => String(Number(of.toPrecision(3)));
  const bar = (low: string, high: string, text: string) => {
    const sign = document.createElement("i");
    sign.style.background = gradient();
    $("scale").replaceChildren(low, sign, high, ` · ${text}`);
  };
  const range = range_of(mesh, by);
  const text = LEGENDS(bytes(mesh, "kind").includes(2))[by];
  if (clearance?.length) {
    const most = clearance.reduce((a, b) => Math.max(a, b), 0);
    bar("0", `${digits(most)}${units && ` ${units}`}`, "path: near obstacles (dark) to far from them (bright)");
  } else if (range) bar(...(range.map(digits) as [string, string]), text);
  else $("scale").textContent = text;
}
