// Pointers on the drawing: one drags, two fingers pinch. A cancelled drag or pinch restores the state before it.
export interface Place {
  clientX: number;
  clientY: number;
}
export interface Follower {
  move: (now: PointerEvent) => void;
  end: (now: PointerEvent) => void;
  cancel: () => void;
}
export interface Pinch {
  move: (a: Place, b: Place) => void;
  cancel: () => void;
}

export const FINGER = matchMedia("(pointer: coarse)").matches ? 2 : 1; // factor for the size of handles

export class Pointers {
  private readonly fingers = new Map<number, Place>(); // those on the drawing now
  private cancel?: () => void; // the drag or pinch that has begun

  constructor(
    element: SVGElement,
    private readonly pinched: (a: Place, b: Place) => Pinch,
  ) {
    element.addEventListener("pointerdown", (event) => this.touched(event), true);
    window.addEventListener("pointermove", (event) => {
      if (this.fingers.has(event.pointerId)) this.fingers.set(event.pointerId, event);
    });
    for (const end of ["pointerup", "pointercancel"] as const)
      window.addEventListener(end, ({ pointerId }) => this.fingers.delete(pointerId));
  }

  // Follow a pointer from its press to its end, even outside the element.
  follow(begin: PointerEvent, follower: Follower): void {
    (begin.target as Element).setPointerCapture(begin.pointerId);
    this.listen((id) => id === begin.pointerId, follower);
  }

  private listen(is_mine: (pointer: number) => boolean, { move, end, cancel }: Follower): void {
    const over = new AbortController();
    const { signal } = over;
    const on = (name: "pointermove" | "pointerup" | "pointercancel", act: (now: PointerEvent) => void) =>
      window.addEventListener(
        name,
        (now) => {
          if (is_mine(now.pointerId)) act(now);
        },
        { signal, capture: true },
      );
    const finish = () => {
      over.abort();
      this.cancel = undefined;
    };
    this.cancel = () => {
      finish();
      cancel();
    };
    on("pointermove", move);
    on("pointerup", (now) => {
      finish();
      end(now);
    });
    on("pointercancel", this.cancel);
  }

  // The second finger cancels the drag of the first one, and the two pinch; further fingers are ignored.
  private touched(event: PointerEvent): void {
    if (event.pointerType !== "touch") return;
    if (event.isPrimary) this.fingers.clear();
    this.fingers.set(event.pointerId, event);
    if (this.fingers.size === 1) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    if (this.fingers.size > 2) return;
    this.cancel?.();
    const two = new Map(this.fingers);
    const places = () => [...two.values()] as [Place, Place];
    const pinch = this.pinched(...places());
    this.listen((id) => two.has(id), {
      move: (now) => {
        two.set(now.pointerId, now);
        pinch.move(...places());
      },
      end: () => {},
      cancel: pinch.cancel,
    });
  }
}
