// Eight steps, through the paper and to a car: each has a text, a scene, and something to drag.
import { $ } from "./page";
import type { Editor } from "./editor";
import type { Session } from "./session";

export class Lessons {
  private at = -1;
  private readonly steps = [...$("lessons").querySelectorAll<HTMLElement>("article")];

  constructor(
    private readonly session: Session,
    private readonly editor: Editor,
    private readonly scene_of: (name: string) => string | undefined,
  ) {
    $("lesson-back").addEventListener("click", () => void this.go(this.at - 1));
    $("lesson-next").addEventListener(
      "click",
      () => void (this.at + 1 < this.steps.length ? this.go(this.at + 1) : this.close()),
    );
    $("lesson-close").addEventListener("click", () => this.close());
  }

  toggle(): void {
    if (this.at < 0) void this.go(0);
    else this.close();
  }

  private close(): void {
    this.at = -1;
    $("lessons").hidden = true;
    $("learn").setAttribute("aria-pressed", "false");
    $("learn").focus();
  }

  private async go(k: number): Promise<void> {
    this.at = Math.max(0, Math.min(this.steps.length - 1, k));
    $("lessons").hidden = false;
    $("learn").setAttribute("aria-pressed", "true");
    this.steps.forEach((step, i) => {
      step.hidden = i !== this.at;
    });
    const { scene, colour = "contact", edit } = this.steps[this.at]!.dataset;
    $("lesson-step").textContent = `${this.at + 1} of ${this.steps.length}`;
    $<HTMLButtonElement>("lesson-back").disabled = this.at === 0;
    $("lesson-next").textContent = this.at + 1 < this.steps.length ? "Next" : "Done";
    const by = $<HTMLSelectElement>("colour");
    by.value = colour;
    by.dispatchEvent(new Event("change"));
    if (this.editor.is_on !== (edit === "yes")) this.editor.mode(edit === "yes");
    await this.session.open(this.scene_of(scene!)!, { gallery: scene! });
  }
}
