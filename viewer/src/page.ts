// Parts of the page by their id, and messages in words.
import type { Palette } from "./colours";
import { Cancelled } from "./engine";
import type { Verdict } from "./verdict";

export const $ = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;
export const json = (id: string) => JSON.parse($(id).textContent!);

export const palette = (): Palette => {
  const of = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  return {
    vertex_edge: of("ve"),
    edge_vertex: of("ev"),
    arc_arc: of("aa"),
    helix: of("helix"),
    segment: of("segment"),
    ink: of("ink"),
    faint: of("soft"),
    path: of("path"),
    ahead: of("ahead"),
    back: of("back"),
    in_place: of("in-place"),
    good: of("good"),
    bad: of("bad"),
    accent: of("accent"),
    barrier: of("barrier"),
  };
};

export function say(id: "pose" | "way" | "missing" | "edit", verdict: Verdict): void {
  const element = $(id);
  if (element.textContent !== verdict.text) element.textContent = verdict.text;
  element.dataset.tone = verdict.tone;
  element.classList.remove("old");
}
export function fault(id: "pose" | "way" | "missing" | "edit", error: unknown): void {
  if (error instanceof Cancelled) return;
  const text = (error instanceof Error ? error.message : String(error)).replace(/(-?\d+)\/(\d+)(?=[,)])/g, (_, p, q) =>
    String(Number((Number(p) / Number(q)).toPrecision(5))),
  );
  say(id, { tone: "bad", text });
}
export function working(is: boolean): void {
  $("share-done").hidden = $("stop").hidden = !is;
}

export function download(name: string, content: BlobPart, type: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([content], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
