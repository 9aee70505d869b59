// Stand-ins for the parts of a browser that modules need to load, and for pointers on an element.
import { gzipSync } from "node:zlib";

globalThis.window = new EventTarget();
globalThis.matchMedia = () => ({ matches: false });

const EMPTY_MODULE = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0);
const blocks = { core: gzipSync(EMPTY_MODULE).toString("base64"), worker: "" };
globalThis.document = { getElementById: (id) => ({ textContent: blocks[id] }) };

export class PointerElement extends EventTarget {
  captured = [];
  setPointerCapture(id) {
    this.captured.push(id);
  }
}

export function pointer(target, type, pointerId, fields = {}) {
  const event = new Event(type, { cancelable: true });
  Object.assign(event, {
    pointerId,
    pointerType: "touch",
    isPrimary: pointerId === 1,
    clientX: 0,
    clientY: 0,
    ...fields,
  });
  target.dispatchEvent(event);
  return event;
}
