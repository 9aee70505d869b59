// Scenes given to the page: written into it, or sent by the page around its frame, which gets its state back.
import { string } from "./engine";
import { $ } from "./page";
import type { Session } from "./session";
import type { PoseText } from "./state";

export interface Given {
  scene: string;
  robot?: PoseText;
  start?: PoseText;
  goal?: PoseText;
  poses?: string;
}

export async function show_given(session: Session, { scene, poses, ...ends }: Given): Promise<void> {
  if (session.scene && scene === session.now.source) await session.change(ends);
  else await session.open(scene, ends);
  if (poses) session.show_way(await (await session.planner.of(scene)).call("walk", poses));
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
    window.parent.postMessage({ cfree: "seen", seen: { scene, robot, start, goal, poses } }, "*");
  };
  window.parent.postMessage({ cfree: "ready" }, "*");
}
