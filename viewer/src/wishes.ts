// What is wished of a path: the distance that it keeps, and the ways that are preferred.
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
export const FACTORS = ["sideways", "backward", "turning"] as const;
export const is_factor = (of: unknown): of is string => is_number(of) && number(of) >= 1;
export const is_length = (of: unknown): of is string => is_number(of) && number(of) >= 0;
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
