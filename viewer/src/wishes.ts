// What is wished of a path: the distance that it keeps, and the ways that are preferred; with their controls.
import { $, say } from "./page";
import type { Session } from "./session";
import { number } from "./shapes";
import { is_number } from "./vehicle";

export interface Wishes {
  clearance: string;
  objective: "short" | "clear";
  sideways: string; // factors of costs, as those of `cfree.Preferences`
  backward: string;
  turning: string;
}
export const NONE: Wishes = { clearance: "0", objective: "short", sideways: "1", backward: "1", turning: "1" };
const FACTORS = ["sideways", "backward", "turning"] as const;
const is_factor = (of: unknown): of is string => is_number(of) && number(of) >= 1;
const is_length = (of: unknown): of is string => is_number(of) && number(of) >= 0;
export function is_wishes(of: unknown): of is Wishes {
  const { clearance, objective, ...factors } = (of ?? {}) as Record<string, unknown>;
  return (
    is_length(clearance) &&
    (objective === "short" || objective === "clear") &&
    FACTORS.every((name) => is_factor(factors[name]))
  );
}

export const words_of = ({ objective, sideways, backward, turning }: Wishes) =>
  `${objective} ${sideways} ${backward} ${turning}`;
// Empty if there is none.
export const clearance_of = (wishes: Wishes | undefined) =>
  wishes && number(wishes.clearance) > 0 ? wishes.clearance : "";

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
