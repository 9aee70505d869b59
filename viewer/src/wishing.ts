// Controls of the wishes about a path.
import { $, say } from "./page";
import type { Session } from "./session";
import { FACTORS, NONE, is_factor, is_length, type Wishes } from "./wishes";

export class Wishing {
  constructor(private readonly session: Session) {
    for (const name of ["clearance", ...FACTORS] as const)
      $(name).addEventListener("change", () => this.typed(name, $<HTMLInputElement>(name)));
    $("objective").addEventListener("change", () => {
      const objective = $<HTMLSelectElement>("objective").value as Wishes["objective"];
      this.session.wish({ ...this.session.wishes, objective });
    });
    session.on_wishes = () => this.show();
  }

  // Take a number that was typed; one that is none is marked, and the wishes stay.
  private typed(name: "clearance" | (typeof FACTORS)[number], input: HTMLInputElement): void {
    if (!this.session.scene) return;
    const text = input.value.trim() || NONE[name];
    const well = name === "clearance" ? is_length(text) : is_factor(text);
    input.setAttribute("aria-invalid", String(!well));
    const wanted = name === "clearance" ? "give a length, 0 or more" : "give a factor of 1 or more";
    say("edit", { tone: "bad", text: well ? "" : `${name} ${input.value}: ${wanted}` });
    if (well) this.session.wish({ ...this.session.wishes, [name]: text });
  }

  show(): void {
    const { wishes, vehicle } = this.session;
    for (const name of ["clearance", ...FACTORS] as const) {
      const input = $<HTMLInputElement>(name);
      input.value = wishes[name];
      input.removeAttribute("aria-invalid");
    }
    $<HTMLSelectElement>("objective").value = wishes.objective;
    $("wishes").dataset.moves = vehicle.kind; // a vehicle has costs of its own
  }
}
