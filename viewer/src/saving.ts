// What is shown as files.
import { download } from "./page";
import type { Session } from "./session";
import { Shapes, pose_json } from "./shapes";

const name_of = (session: Session) => (session.file.name || "scene").replace(/[^-\w]+/g, "_");

export function save_scene(session: Session): void {
  const { source, start, goal } = session.now;
  const text = Shapes.of(source).ending({ ...(start && { start: pose_json(start) }), ...(goal && { goal: pose_json(goal) }) }).text();
  download(`${name_of(session)}.json`, text, "application/json");
}
