// Calls of the core in a worker: each is a promise; of many questions only the newest is asked; ending the worker cancels.
import type { Columns } from "./worker";
export type { Columns };

export class Cancelled extends Error {}

let module: Promise<WebAssembly.Module> | undefined;
let source: string | undefined;

const block = (id: string) => document.getElementById(id)!.textContent!;

async function unpacked(): Promise<WebAssembly.Module> {
  const packed = Uint8Array.from(atob(block("core").trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compile(await new Response(stream).arrayBuffer());
}

interface Policies {
  createPolicy(name: string, rules: { createScriptURL(url: string): string }): { createScriptURL(url: string): string };
}
function script_url(): string {
  if (source === undefined) {
    const url = URL.createObjectURL(new Blob([block("worker")], { type: "text/javascript" }));
    const policies = (window as unknown as { trustedTypes?: Policies }).trustedTypes;
    source = policies ? policies.createPolicy("worker", { createScriptURL: (of) => of }).createScriptURL(url) : url;
  }
  return source;
}

type Waiting = { done(columns: Columns): void; fail(error: Error): void };

export class Engine {
  private worker?: Worker;
  private waiting = new Map<number, Waiting>();
  private queued = new Map<string, { args: unknown[] } & Waiting>();
  private busy_with = new Set<string>();
  private opened?: string;
  private count = 0;

  constructor(private readonly on_share: (share: number) => void = () => {}) {}

  get busy(): boolean {
    return this.waiting.size > 0;
  }

  call(name: string, ...args: unknown[]): Promise<Columns> {
    this.worker ??= this.made();
    const id = ++this.count;
    return new Promise((done, fail) => {
      this.waiting.set(id, { done, fail });
      this.worker!.postMessage({ id, name, args });
    });
  }

  // Ask one at a time. Of those that wait only the newest is asked; the others are cancelled.
  async newest(name: string, ...args: unknown[]): Promise<Columns> {
    if (this.busy_with.has(name)) {
      this.queued.get(name)?.fail(new Cancelled());
      return new Promise((done, fail) => this.queued.set(name, { args, done, fail }));
    }
    this.busy_with.add(name);
    try {
      return await this.call(name, ...args);
    } finally {
      this.busy_with.delete(name);
      const next = this.queued.get(name);
      if (next) {
        this.queued.delete(name);
        this.newest(name, ...next.args).then(next.done, next.fail);
      }
    }
  }

  // Open the scene for later calls and end work for another one. Of several requests the newest succeeds. With a clearance the
  // robot is grown by it.
  async open(text: string, clearance = ""): Promise<Columns> {
    const opening = (this.opening = Symbol());
    try {
      return await this.reopened(text, clearance);
    } finally {
      if (this.opening === opening) this.opening = undefined;
    }
  }
  private opening?: symbol;
  private wishes = 0;
  private async reopened(text: string, clearance: string): Promise<Columns> {
    const before = this.opened;
    const wish = ++this.wishes;
    for (let k = 0; k < 6 && this.busy; ++k) {
      await new Promise((done) => setTimeout(done, 10));
      if (wish !== this.wishes) throw new Cancelled();
    }
    if (this.busy) this.end();
    const name = `${clearance} ${text}`;
    this.opened = name;
    try {
      return await this.call("open", text, ...(clearance ? [clearance] : []));
    } catch (error) {
      if (this.opened === name) this.opened = before;
      throw error;
    }
  }

  // Return this engine with the scene open. It waits while `open` opens another scene, and does not interrupt it.
  async of(text: string, clearance = ""): Promise<this> {
    while (this.opening) await new Promise((done) => setTimeout(done, 5));
    if (this.opened !== `${clearance} ${text}`) await this.reopened(text, clearance);
    return this;
  }

  // End all work; no scene is open afterwards.
  end(): void {
    this.worker?.terminate();
    this.worker = undefined;
    this.opened = undefined;
    const left = [...this.waiting.values(), ...this.queued.values()];
    this.waiting.clear();
    this.queued.clear();
    this.busy_with.clear();
    for (const { fail } of left) fail(new Cancelled());
  }

  private made(): Worker {
    const worker = new Worker(script_url());
    worker.onmessage = ({ data }) => {
      if (this.worker !== worker) return;
      if (data.share !== undefined) return this.on_share(data.share);
      const waiting = this.waiting.get(data.id);
      this.waiting.delete(data.id);
      if (data.fault !== undefined) waiting?.fail(new Error(data.fault));
      else waiting?.done(data.columns);
    };
    this.worker = worker;
    module ??= unpacked();
    const id = ++this.count;
    const held: unknown[] = [];
    const post = worker.postMessage.bind(worker);
    worker.postMessage = (message: unknown) => void held.push(message); // until the core is loaded
    void module.then((of) => {
      worker.postMessage = post as Worker["postMessage"];
      post({ id, name: "start", args: [of] });
      for (const message of held) post(message);
    });
    return worker;
  }
}

export const doubles = (columns: Columns, name: string) => (columns[name] ?? new Float64Array()) as Float64Array;
export const integers = (columns: Columns, name: string) => (columns[name] ?? new Int32Array()) as Int32Array;
export const bytes = (columns: Columns, name: string) => (columns[name] ?? new Uint8Array()) as Uint8Array;
export const value = (columns: Columns, name: string) => doubles(columns, name)[0] ?? Number.NaN;
export const string = (columns: Columns, name: string) => columns[name] as string;
