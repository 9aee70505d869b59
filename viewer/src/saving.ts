// Files of the view: the scene, the answer, pictures and the mesh.
import { string } from "./engine";
import { $, download, fault, say } from "./page";
import type { Session } from "./session";
import { Shapes, json_of, pose_json } from "./shapes";
import { model_of } from "./model";
import { record_of } from "./vehicle";

const name_of = (session: Session, end: string) => `${(session.file.name || "scene").replace(/[^-\w]+/g, "_")}${end}`;

export function save_scene(session: Session): void {
  const { source, start, goal, vehicle } = session.now;
  const text = Shapes.of(source)
    .ending({
      ...(start && { start: pose_json(start) }),
      ...(goal && { goal: pose_json(goal) }),
      vehicle: record_of(vehicle, json_of),
    })
    .text();
  download(name_of(session, ".json"), text, "application/json");
}

// Save the answer for `cfree verify`; the hash identifies its scene.
async function save_answer(session: Session): Promise<void> {
  if (!crypto.subtle)
    throw new Error(
      "This page came over a connection that is not secure, where browsers compute no hashes: save the page, or use https",
    );
  const written = await session.planner.call("written");
  const hash = await crypto.subtle.digest("SHA-256", new TextEncoder().encode(string(written, "scene")));
  const hex = [...new Uint8Array(hash)].map((byte) => byte.toString(16).padStart(2, "0")).join("");
  download(name_of(session, "_answer.json"), string(written, "answer").replace("{sha256}", hex), "application/json");
}

// The left view with its colours written into it.
function workspace_svg(): SVGSVGElement {
  const shown = $("workspace").querySelector("svg")!;
  const copy = shown.cloneNode(true) as SVGSVGElement;
  const originals = shown.querySelectorAll("*");
  const copies = copy.querySelectorAll("*");
  const handles = copy.querySelectorAll(".drive");
  const looks = [
    "fill",
    "fill-opacity",
    "fill-rule",
    "stroke",
    "stroke-opacity",
    "stroke-width",
    "stroke-dasharray",
    "stroke-linejoin",
    "stroke-linecap",
    "opacity",
    "font",
    "vector-effect",
    "display",
  ];
  originals.forEach((element, k) => {
    const look = getComputedStyle(element);
    const into = copies[k]! as SVGElement;
    for (const name of looks) into.style.setProperty(name, look.getPropertyValue(name));
    for (const name of ["class", "tabindex", "role", "aria-label", "aria-roledescription"]) into.removeAttribute(name);
  });
  for (const handle of handles) handle.remove();
  copy.querySelectorAll("[style*='display: none']").forEach((element) => element.remove());
  const { width, height } = shown.getBoundingClientRect();
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.setAttribute("width", String(width));
  copy.setAttribute("height", String(height));
  return copy;
}
function save_svg(session: Session): void {
  download(name_of(session, ".svg"), new XMLSerializer().serializeToString(workspace_svg()), "image/svg+xml");
}

async function picture_of(svg: SVGSVGElement): Promise<HTMLImageElement> {
  const picture = new Image();
  const url = URL.createObjectURL(new Blob([new XMLSerializer().serializeToString(svg)], { type: "image/svg+xml" }));
  picture.src = url;
  await picture.decode();
  URL.revokeObjectURL(url);
  return picture;
}
async function save_png(session: Session): Promise<void> {
  const svg = workspace_svg();
  const left = await picture_of(svg);
  const right = session.space?.picture();
  const ratio = Math.max(2, devicePixelRatio);
  const width = Number(svg.getAttribute("width"));
  const height = Number(svg.getAttribute("height"));
  const canvas = document.createElement("canvas");
  const to = canvas.getContext("2d")!;
  const share = right ? height / right.height : 0;
  canvas.width = ratio * (width + (right ? right.width * share : 0));
  canvas.height = ratio * height;
  to.scale(ratio, ratio);
  to.fillStyle = getComputedStyle($("workspace")).backgroundColor;
  to.fillRect(0, 0, canvas.width, canvas.height);
  to.drawImage(left, 0, 0, width, height);
  if (right) to.drawImage(right, width, 0, right.width * share, height);
  const blob = await new Promise<Blob | null>((done) => canvas.toBlob(done, "image/png"));
  download(name_of(session, ".png"), blob!, "image/png");
}

async function save_glb(session: Session): Promise<void> {
  const model = session.space && (await model_of(session.space.shown));
  if (!model) return say("edit", { tone: "bad", text: "There is no mesh yet." });
  download(name_of(session, ".glb"), model, "model/gltf-binary");
}

const ways: Record<string, (session: Session) => unknown> = {
  scene: save_scene,
  answer: save_answer,
  png: save_png,
  svg: save_svg,
  glb: save_glb,
};
export async function save(session: Session, what: string): Promise<void> {
  try {
    await ways[what]?.(session);
  } catch (error) {
    fault("edit", error);
  }
}
