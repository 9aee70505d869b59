// The core in a worker: calls by name, columns back. Their meaning is left to the callers.
// @ts-expect-error made by em++
import core from "core.js";
import { read_scene } from "./words";

export type Column = Float64Array | Int32Array | Uint8Array | string;
export type Columns = Record<string, Column>;

const scope = self as unknown as { onmessage: unknown; postMessage(message: unknown, transfer?: Transferable[]): void };
let made: Promise<any> | undefined;

function columns_of(module: any): Columns {
  const found: Columns = {};
  for (let k = 0; k < module._count(); ++k) {
    const at = module._bytes(k);
    const size = module._size(k);
    const bytes = module.HEAPU8.slice(at, at + size);
    const name = module.UTF8ToString(module._name(k));
    found[name] = [
      () => bytes,
      () => new Int32Array(bytes.buffer),
      () => new Float64Array(bytes.buffer),
      () => new TextDecoder().decode(bytes),
    ][module._type(k)]!();
  }
  return found;
}

function call(module: any, name: string, args: (string | number)[]): Columns {
  const texts: number[] = [];
  const passed = args.map((arg) => {
    if (typeof arg === "number") return arg;
    const size = module.lengthBytesUTF8(arg) + 1;
    const at = module._malloc(size);
    module.stringToUTF8(arg, at, size);
    texts.push(at);
    return at;
  });
  const well = module[`_${name}`](...passed);
  for (const at of texts) module._free(at);
  if (!well) throw new Error(module.UTF8ToString(module._fault()));
  return columns_of(module);
}

scope.onmessage = async ({ data: { id, name, args } }: MessageEvent) => {
  try {
    if (name === "start") {
      made = core({
        instantiateWasm(imports: WebAssembly.Imports, ok: (instance: WebAssembly.Instance) => void) {
          const instance = new WebAssembly.Instance(args[0], imports);
          ok(instance);
          return instance.exports;
        },
        share: (share: number) => scope.postMessage({ share }),
      });
      await made;
      return scope.postMessage({ id, columns: {} });
    }
    const module = await made;
    if (name === "open") {
      const { words, ...rest } = read_scene(args[0]);
      const scene = args[1] ? `${words} clearance ${args[1]}` : words;
      return scope.postMessage({ id, columns: { ...call(module, "scene", [scene]), file: JSON.stringify(rest) } });
    }
    const columns = call(module, name, args);
    const buffers = Object.values(columns).flatMap((column) =>
      typeof column === "string" ? [] : [column.buffer as ArrayBuffer],
    );
    scope.postMessage({ id, columns }, buffers);
  } catch (error) {
    const fault = error instanceof Error ? error.message : `a fault of cfree: ${String(error)}`;
    scope.postMessage({ id, fault });
  }
};
