// Runs the core of the page in node: `node engine.mjs page.html` reads calls, one a line as JSON [name, ...args], and answers each with
// a line: columns as [type, length, sha256], numbers of short ones, or of all if the name begins with "all ", texts; or {"fault": ...}.
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { createInterface } from "node:readline";
import { gunzipSync } from "node:zlib";

const page = readFileSync(process.argv[2], "utf8");
const part = (id) => new RegExp(`<script[^>]* id="${id}"[^>]*>([^]*?)</script>`).exec(page)[1];
const module = new WebAssembly.Module(gunzipSync(Buffer.from(part("core"), "base64")));

const waiting = new Map();
const self = { location: { href: "" }, postMessage: ({ id, columns, fault }) => { if (id !== undefined) waiting.get(id)(fault === undefined ? columns : { fault }); } };
new Function("self", "importScripts", part("worker"))(self, () => {});
let count = 0;
const call = (name, args) => new Promise((done) => { waiting.set(++count, done); self.onmessage({ data: { id: count, name, args } }); });

const seen = (column, most) => typeof column === "string" ? column : {
  type: column.constructor.name, length: column.length,
  sha256: createHash("sha256").update(column).digest("hex"),
  ...(column.length <= most ? { values: [...column] } : {}),
};
await call("start", [module]);
for await (const line of createInterface({ input: process.stdin })) {
  const [asked, ...args] = JSON.parse(line);
  const name = asked.replace(/^all /, "");
  const columns = await call(name, args);
  console.log(JSON.stringify("fault" in columns ? columns : Object.fromEntries(Object.entries(columns).map(([key, column]) => [key, seen(column, name === asked ? 64 : Infinity)]))));
}
