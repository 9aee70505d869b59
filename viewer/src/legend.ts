// The legend of the right view: colours of the patches and lines that are there.
import { type Columns, bytes, integers } from "./engine";
import { $ } from "./page";

export interface Entry {
  mark: "ve" | "ev" | "aa" | "he" | "se";
  text: string;
}
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

export function show_legend(shown: Entry[]): void {
  $("legend").replaceChildren(
    ...shown.flatMap(({ mark, text }) => {
      const name = document.createElement("span");
      const sign = document.createElement("i");
      sign.className = mark;
      name.append(sign, text);
      return [name, " "];
    }),
  );
}
