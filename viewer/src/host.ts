// Scenes given to the page: written into it, or sent by the page around its frame, which gets its state back.
import { string } from "./engine";
import { $ } from "./page";
import type { Session } from "./session";
import type { PoseText } from "./state";
import { record_of, words_of, type Vehicle } from "./vehicle";
import { read_vehicle } from "./words";

export interface Given {
  scene: string;
  robot?: PoseText;
  start?: PoseText;
  goal?: PoseText;
  vehicle?: unknown; // as in files; null for a robot that moves in any direction, although the file has a vehicle
  poses?: string;
}

export async function show_given(session: Session, { scene, poses, vehicle, ...ends }: Given): Promise<void> {
  const drives: Partial<Vehicle> | undefined = vehicle === null ? { kind: "any" } : read_vehicle(vehicle);
  const first = { ...ends, ...(drives && { vehicle: drives }) };
  if (session.scene && scene === session.now.source) await session.change(first);
  else await session.open(scene, first);
  if (!poses) return;
  const driver = session.now.vehicle;
  session.show_way(await (await session.planner.of(scene)).call("walk", poses, words_of(driver)), driver);
}

// Ignore the wheel in a frame without focus: a user who scrolls past does not want to zoom.
export function spare_the_wheel(): void {
  const spare = (event: WheelEvent) => {
    if (!event.ctrlKey && !document.hasFocus()) event.stopImmediatePropagation();
  };
  if (window.parent !== window) window.addEventListener("wheel", spare, { capture: true });
}

export function be_hosted(session: Session): void {
  $("share").hidden = true; // a frame has no address of its own
  window.addEventListener("message", ({ source, data }) => {
    if (source === window.parent && data?.cfree === "show") void show_given(session, data.given);
  });
  session.on_seen = () => {
    const { source: scene, robot, start, goal } = session.now;
    const poses = session.path ? string(session.last_way!, "poses") : "";
    const vehicle = record_of(session.now.vehicle) ?? null;
    window.parent.postMessage({ cfree: "seen", seen: { scene, robot, start, goal, vehicle, poses } }, "*");
  };
  window.parent.postMessage({ cfree: "ready" }, "*");
}
