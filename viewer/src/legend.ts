// The legend of the right view: colours of the patches and lines that are there.
import { type Columns, bytes, doubles } from "./engine";
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

// Among round shapes: an arc stands for a vertex that is grown. Contacts with the bounds are those of the reference point.
export function entries(scene: Columns, mesh: Columns): Entry[] {
  if (!scene["robot.radius"]) return OF_POLYGONS;
  const robot = doubles(scene, "robot.radius")[0]! > 0 ? "arc" : "vertex";
  const radii = doubles(scene, "obstacles.radius");
  const [arcs, vertices] = [radii.some((r) => r > 0), radii.some((r) => r === 0)];
  const obstacle = arcs && vertices ? "arc or vertex" : arcs ? "arc" : "vertex";
  const owner = mesh.owner as Int32Array;
  const kinds = new Set(bytes(mesh, "kind").filter((_, k) => owner[k] !== -1));
  const lines = new Set(bytes(mesh, "line_kind"));
  const curves = [...(lines.has(1) ? ["helix"] : []), ...(lines.has(3) ? ["smooth joint"] : [])].join(", ");
  return [
    ...(kinds.has(0) ? [{ mark: "ve", text: `${robot} on edge` } as const] : []),
    ...(kinds.has(1) ? [{ mark: "ev", text: `edge on ${obstacle}` } as const] : []),
    ...(kinds.has(2) ? [{ mark: "aa", text: `${robot} on ${robot === "arc" ? obstacle : "arc"}` } as const] : []),
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
