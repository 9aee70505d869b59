// The page: buttons, keys, files and links.
import type { ColourBy } from "./colours";
import { Driving } from "./driving";
import { doubles, integers, string, value } from "./engine";
import { Editor } from "./editor";
import { read_file } from "./files";
import { be_hosted, show_given, spare_the_wheel, type Given } from "./host";
import { coloured, show_legend, show_scale } from "./legend";
import { Lessons } from "./lessons";
import { $, fault, json, palette, say } from "./page";
import { Player } from "./playing";
import { save, save_scene } from "./saving";
import { Session, seen_of } from "./session";
import { snapped } from "./shapes";
import { Space } from "./space";
import { fragment, from_fragment, from_words, words } from "./state";
import { cell_words, degrees, patch_words } from "./verdict";
import { Wishing } from "./wishing";
import { Workspace } from "./workspace";

const gallery: { name: string; title?: string; text: string }[] = json("gallery");
const in_gallery = (name: string) => gallery.find((of) => of.name === name)?.text;

const workspace = new Workspace($("workspace"));
let space: Space | undefined;
try {
  space = new Space($("space"), palette());
} catch {
  $("picked").hidden = false;
  $("picked").textContent = "This browser shows no WebGL: the workspace, slices and verdicts still work.";
}
const session = new Session(workspace, space);
const player = new Player(session);
const editor = new Editor(workspace);
session.editor = editor;
const driving = new Driving(workspace, session);
new Wishing(session);
const lessons = new Lessons(session, editor, in_gallery);
editor.on_change = (source, done) => void session.edited({ source, done });
editor.on_cancel = () => void session.edited("back");
editor.on_mode = () => {
  $("edit-shapes").setAttribute("aria-pressed", String(editor.is_on));
  $("tools").classList.toggle("on", editor.is_on);
  $<HTMLButtonElement>("remove").disabled = !editor.has_chosen;
  $("hint").textContent = !editor.is_on
    ? ""
    : editor.is_drawing
      ? "Click the new obstacle's corners; the first one again, or Enter, closes it."
      : "Drag a shape or its corners; a double click on an edge adds one.";
};

const turned = (done: boolean) => {
  session.stop_playing();
  const theta = (Number($<HTMLInputElement>("theta").value) * Math.PI) / 180;
  $("degrees").textContent = degrees(theta);
  space?.set_theta(theta);
  const { robot } = session.seen;
  if (!robot) return;
  session.seen.robot = { ...robot, theta };
  workspace.place("robot", session.seen.robot);
  session.drag({ who: "robot", x: robot.x, y: robot.y, theta, step: workspace.step, done });
};
$("theta").addEventListener("input", () => turned(false));
$("theta").addEventListener("change", () => turned(true));

if (space)
  space.on_pick = async (face, x, y, theta) => {
    if (!session.is_built) return;
    const found = await session.builder.call("picked", face, x, y, theta);
    const pose = from_words(string(found, "pose"));
    space?.highlight(integers(found, "same"));
    const cell = await cell_of(value(found, "cell"));
    show_picked(`${patch_words(found, session.file.names)}\n${cell}`);
    session.keep({ ...session.now, robot: pose }, true);
    session.set_slider(seen_of(pose).theta);
    await session.ask_robot(pose);
    void session.ask_slice();
  };
const cell_of = async (k: number) => cell_words(k, await session.builder.call("cell", k), session.file.units);
function show_picked(text: string): void {
  $("picked").hidden = false;
  $("picked").textContent = text;
}
async function show_cell(pose: string): Promise<void> {
  if (!session.is_built) return;
  space?.highlight(undefined);
  const found = integers(await session.builder.call("pose", pose), "cells");
  if (found.length) show_picked(await cell_of(found[0]!));
}
workspace.on_click = ({ x, y }) =>
  void show_cell(`${snapped(x, workspace.step)} ${snapped(y, workspace.step)} ${session.now.robot.tau}`);

async function open_file(of: File | undefined): Promise<void> {
  if (!of) return;
  try {
    const { source, left_out } = await read_file(of);
    await session.open(source);
    if (left_out && session.now.source === source) say("edit", { tone: "plain", text: left_out });
  } catch (error) {
    fault("edit", error);
  }
}

async function share(): Promise<void> {
  const hash = await fragment(session.now);
  if (!hash) return say("way", { tone: "plain", text: "This scene is too long for a link: save the file." });
  window.history.replaceState(null, "", hash);
  try {
    await navigator.clipboard.writeText(location.href);
    say("way", { tone: "good", text: "The link is copied." });
  } catch {
    say("way", { tone: "plain", text: "The link is in the address bar." });
  }
}

const actions: Record<string, () => void> = {
  open: () => $("file").click(),
  save: () => save_scene(session),
  share: () => void share(),
  undo: () => void session.undo(),
  redo: () => void session.redo(),
  help: () => $<HTMLDialogElement>("keys").showModal(),
  play: () => player.toggle(),
  stop: () => session.stop(),
  learn: () => lessons.toggle(),
  "edit-shapes": () => editor.mode(!editor.is_on),
  draw: () => editor.draw(),
  remove: () => editor.remove(),
  "frame-proof": () => space?.frame_barrier(),
  "start-here": () => session.mark_end("start"),
  "goal-here": () => session.mark_end("goal"),
};
for (const [id, action] of Object.entries(actions)) if (id !== "save") $(id).addEventListener("click", action);
$("save").addEventListener("change", () => {
  const what = $<HTMLSelectElement>("save").value;
  $<HTMLSelectElement>("save").value = "";
  void save(session, what);
});
$<HTMLInputElement>("file").addEventListener("change", (event) => {
  const input = event.target as HTMLInputElement;
  const file = input.files?.[0];
  input.value = ""; // else the same file, changed, is not opened again
  void open_file(file);
});
const colouring = (): ColourBy | "clearance" => $<HTMLSelectElement>("colour").value as ColourBy | "clearance";
session.on_built = () => {
  const { mesh, last_way, file } = session;
  if (!mesh) return;
  const by = colouring();
  const patches = by === "clearance" ? "contact" : by;
  const has_proof = last_way !== undefined && string(last_way, "verdict") === "apart";
  show_legend(coloured(mesh, patches, file.names, has_proof));
  show_scale(mesh, patches, by === "clearance" && last_way ? doubles(last_way, "clearance") : undefined, file.units);
};
$("colour").addEventListener("change", () => {
  const by = colouring();
  space?.colour(by === "clearance" ? "contact" : by);
  session.show_path();
  session.on_built();
});
$("palette").addEventListener("change", () => {
  document.documentElement.dataset.palette = $<HTMLSelectElement>("palette").value;
  space?.repaint(palette());
});
$("solid").addEventListener("change", () => space?.solid($<HTMLInputElement>("solid").checked));
$("cut").addEventListener("change", () => space?.cut($<HTMLInputElement>("cut").checked));
$("sweep").addEventListener("change", () => session.show_path());
document.addEventListener("dragover", (event) => {
  event.preventDefault();
  document.body.classList.add("dropping");
});
document.addEventListener("dragleave", () => document.body.classList.remove("dropping"));
document.addEventListener("drop", (event) => {
  event.preventDefault();
  document.body.classList.remove("dropping");
  void open_file(event.dataTransfer?.files[0]);
});
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
  space?.repaint(palette());
  session.show_path();
});

document.addEventListener("keydown", (event) => {
  if (event.key === "Escape") return editor.cancel() ? undefined : session.stop();
  if (event.key === "Enter" && editor.is_drawing) {
    event.preventDefault();
    return editor.finish();
  }
  const key = event.key.toLowerCase();
  if (event.ctrlKey || event.metaKey) {
    const id = { z: event.shiftKey ? "redo" : "undo", y: "redo", o: "open", s: "save" }[key];
    if (id) {
      event.preventDefault();
      actions[id]!();
    }
    return;
  }
  const focus = document.activeElement;
  if (!focus?.closest(".view") || focus.closest("button")) return;
  const toggle = (id: string) => {
    $<HTMLInputElement>(id).click();
  };
  const colour = (k: number) => {
    const of = $<HTMLSelectElement>("colour");
    of.selectedIndex = k;
    of.dispatchEvent(new Event("change"));
  };
  const slide = (by: number) => {
    const of = $<HTMLInputElement>("theta");
    of.value = String(Number(of.value) + by);
    turned(true);
  };
  const keys: Record<string, () => void> = {
    " ": actions.play!,
    s: actions["start-here"]!,
    g: actions["goal-here"]!,
    x: () => toggle("cut"),
    f: () => {
      workspace.fit();
      space?.home();
    },
    "?": actions.help!,
    ",": () => slide(-1),
    ".": () => slide(1),
    c: () => void show_cell(words(session.now.robot)),
    p: () => space?.pick_middle(),
    e: actions["edit-shapes"]!,
    n: actions.draw!,
    m: () => driving.next(),
    1: () => colour(0),
    2: () => colour(1),
    3: () => colour(2),
    4: () => colour(3),
  };
  if (keys[key]) {
    event.preventDefault();
    keys[key]!();
  }
});

const scenes = $<HTMLSelectElement>("scenes");
const option = (of: { value: string; text: string }) =>
  scenes.append(Object.assign(document.createElement("option"), of));
for (const { name, title } of gallery) if (title) option({ value: name, text: title });
option({ value: "", text: "Another scene" });
scenes.addEventListener("change", () => {
  if (scenes.value) void session.open(in_gallery(scenes.value)!, { gallery: scenes.value });
});

async function begin(): Promise<void> {
  const given: Given | "host" | null = json("given");
  if (given) return given === "host" ? be_hosted(session) : show_given(session, given);
  const linked = await from_fragment(location.hash, in_gallery).catch(() => undefined);
  await (linked ? session.open(linked.source, linked) : session.open(gallery[0]!.text, { gallery: gallery[0]!.name }));
}
window.addEventListener("hashchange", async () => {
  const state = await from_fragment(location.hash, in_gallery).catch(() => undefined);
  if (state) await session.open(state.source, state);
});
spare_the_wheel();
void begin();
