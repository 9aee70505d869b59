// The state of a page as texts that the core reads exactly: for undo, redo and links.
import { is_vehicle, type Vehicle } from "./vehicle";
import { is_wishes, type Wishes } from "./wishes";

export interface PoseText {
  x: string;
  y: string;
  tau: string;
}
// `opened` counts scenes opened, not edits of them.
export interface State {
  source: string;
  gallery?: string;
  opened?: number;
  robot: PoseText;
  start?: PoseText;
  goal?: PoseText;
  vehicle?: Vehicle;
  wishes?: Wishes;
}

export const words = (pose: PoseText) => `${pose.x} ${pose.y} ${pose.tau}`;
export function from_words(text: string): PoseText {
  const [x, y, tau] = text.trim().split(" ") as [string, string, string];
  return { x, y, tau };
}

export class History {
  private past: State[] = [];
  private future: State[] = [];
  constructor(public now: State) {}
  push(state: State): void {
    if (JSON.stringify(state) === JSON.stringify(this.now)) return;
    this.past.push(this.now);
    if (this.past.length > 200) this.past.shift();
    this.future = [];
    this.now = state;
  }
  undo(): State | undefined {
    return this.step(this.past, this.future);
  }
  redo(): State | undefined {
    return this.step(this.future, this.past);
  }
  get can_undo(): boolean {
    return this.past.length > 0;
  }
  get can_redo(): boolean {
    return this.future.length > 0;
  }
  private step(from: State[], to: State[]): State | undefined {
    const state = from.pop();
    if (state) {
      to.push(this.now);
      this.now = state;
    }
    return state;
  }
}

const MOST_LINK = 8192;

async function through(bytes: Uint8Array, stream: GenericTransformStream): Promise<Uint8Array> {
  return new Uint8Array(
    await new Response(
      new Blob([bytes as BlobPart]).stream().pipeThrough(stream as ReadableWritablePair<Uint8Array, BufferSource>),
    ).arrayBuffer(),
  );
}

// The fragment of a link; undefined if it would be too long.
export async function fragment(state: State): Promise<string | undefined> {
  const { source, opened: _, ...rest } = state;
  const text = JSON.stringify(state.gallery ? rest : { ...rest, source });
  const packed = await through(new TextEncoder().encode(text), new CompressionStream("deflate-raw"));
  if (packed.length > (MOST_LINK * 3) / 4) return undefined;
  const code = btoa(String.fromCharCode(...packed))
    .replaceAll("+", "-")
    .replaceAll("/", "_")
    .replace(/=+$/, "");
  return `#s=${code}`;
}

export async function from_fragment(
  hash: string,
  gallery: (name: string) => string | undefined,
): Promise<State | undefined> {
  const code = /^#s=([-\w]+)$/.exec(hash)?.[1];
  if (!code) return undefined;
  const packed = Uint8Array.from(atob(code.replaceAll("-", "+").replaceAll("_", "/")), (c) => c.charCodeAt(0));
  const state = JSON.parse(
    new TextDecoder().decode(await through(packed, new DecompressionStream("deflate-raw"))),
  ) as State;
  if (state.gallery) state.source = gallery(state.gallery) ?? "";
  const is_pose = (pose: unknown) =>
    pose === undefined ||
    Object.values(pose as object).every((c) => typeof c === "string" && /^[-+.\d/eEinf]+$/.test(c));
  return typeof state.source === "string" &&
    state.robot &&
    [state.robot, state.start, state.goal].every(is_pose) &&
    (state.vehicle === undefined || is_vehicle(state.vehicle)) &&
    (state.wishes === undefined || is_wishes(state.wishes))
    ? state
    : undefined;
}
