// The robot on its path.
import { $, say } from "./page";
import type { Session } from "./session";
import { frame_of, placed, steering } from "./vehicle";

export class Player {
  private frame = 0;
  constructor(private readonly session: Session) {
    session.stop_playing = () => this.stop();
  }

  stop(): void {
    if (!this.frame) return;
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    $("play").textContent = "▶ Play";
  }

  // Turn the front wheels as on the way from one sample to the next.
  private steer(k: number, next: number): void {
    const { path, gears, driver, wheels, workspace } = this.session;
    if (!path || !gears || !driver || !wheels) return;
    const axle_at = (i: number) =>
      placed(frame_of(driver), { x: path[3 * i]!, y: path[3 * i + 1]!, theta: path[3 * i + 2]! });
    const angle = steering(axle_at(k), axle_at(next), wheels.wheelbase);
    if (angle !== undefined) workspace.steer(angle);
  }

  toggle(): void {
    if (this.frame) return this.stop();
    const { session } = this;
    const { path: samples } = session;
    if (!samples) return;
    const count = samples.length / 3;
    const duration = Math.max(2500, Math.min(14_000, 22 * count));
    $("play").textContent = "❚❚ Pause";
    let last: number | undefined;
    let share = 0;
    const step = (now: number) => {
      // the time of its frame, which may have begun before the click
      share += ((now - (last ?? now)) / duration) * Number($<HTMLSelectElement>("speed").value);
      last = now;
      if (share >= 1 && $<HTMLInputElement>("loop").checked) share %= 1;
      const at = Math.min(share, 1) * (count - 1);
      const k = Math.floor(at);
      const next = Math.min(k + 1, count - 1);
      const u = at - k;
      const c = (i: number) => samples[3 * k + i]! * (1 - u) + samples[3 * next + i]! * u;
      session.seen.robot = { x: c(0), y: c(1), theta: c(2) };
      session.workspace.place("robot", session.seen.robot, "good");
      this.steer(k, next);
      session.space?.place(session.seen.robot, true);
      session.set_slider(c(2));
      void session.ask_slice();
      if (share < 1) this.frame = requestAnimationFrame(step);
      else {
        this.stop();
        session.keep({ ...session.now, robot: session.now.goal! }, true);
        void session.ask_robot(session.now.robot);
      }
    };
    session.workspace.show_contacts(undefined, "", { x: 0, y: 0, theta: 0 });
    say("pose", { tone: "good", text: "On the path: free all the way." });
    this.frame = requestAnimationFrame(step);
  }
}
