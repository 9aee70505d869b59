// Unit tests of modules that need no browser: bundled by esbuild, run by node. `node test.mjs`
import { spawnSync } from "node:child_process";
import { readdirSync, rmSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const folder = join(dirname(fileURLToPath(import.meta.url)), "tests");
const outdir = join(folder, "..", "..", "build", "viewer-tests");
const entryPoints = readdirSync(folder)
  .filter((file) => file.endsWith(".test.mjs"))
  .map((file) => join(folder, file));

rmSync(outdir, { recursive: true, force: true });
await build({
  entryPoints,
  outdir,
  bundle: true,
  platform: "node",
  format: "esm",
  target: "es2022",
  sourcemap: "inline",
  outExtension: { ".js": ".mjs" },
  logLevel: "warning",
});
const files = readdirSync(outdir).map((file) => join(outdir, file));
const { status } = spawnSync(process.execPath, ["--enable-source-maps", "--test", ...files], { stdio: "inherit" });
process.exit(status ?? 1);
