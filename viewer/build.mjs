// The page: the core by em++, what is around it by esbuild, packed into one file. `node build.mjs --boost FOLDER --hash HASH`
import { execFile, execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readFileSync, readdirSync, statSync, writeFileSync } from "node:fs";
import { availableParallelism } from "node:os";
import { dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs, promisify } from "node:util";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";
import temml from "temml";

const root = join(dirname(fileURLToPath(import.meta.url)), "..");
const objects = join(root, "build", "wasm");
const page = join(root, "src", "cfree", "viewer", "page.html");
const MOST = 4 << 20; // bytes of the page
const flags = ["-std=c++20", "-O2", "-ffp-contract=off", "-fwasm-exceptions", `-ffile-prefix-map=${root}=.`];
const link = [
  "-sMODULARIZE=1",
  "-sEXPORT_NAME=core",
  "-sALLOW_MEMORY_GROWTH=1",
  "-sENVIRONMENT=web,worker",
  "-sFILESYSTEM=0",
  "-sDYNAMIC_EXECUTION=0",
  "-sSTACK_SIZE=1048576",
  "-sTOTAL_STACK=1048576",
  "-sEXPORTED_FUNCTIONS=_malloc,_free",
  "-sEXPORTED_RUNTIME_METHODS=UTF8ToString,stringToUTF8,lengthBytesUTF8",
].filter((flag) => !flag.startsWith("-sSTACK_SIZE")); // its name in later releases

function files(folder) {
  return readdirSync(join(root, folder), { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => relative(root, join(entry.parentPath, entry.name)))
    .sort();
}

async function compile_core(boost) {
  const env = { ...process.env, NODE_PATH: "/usr/share/nodejs" };
  const include = ["-Icpp/include", "-Icpp/src", "-isystem", boost];
  const sources = [...files("cpp/src"), ...files("cpp/wasm")].filter((file) => file.endsWith(".cpp"));
  const is_old = (object, depends) => {
    if (!existsSync(object) || !existsSync(depends)) return true;
    const made = statSync(object).mtimeMs;
    const of = readFileSync(depends, "utf8")
      .replace(/\\\n/g, " ")
      .split(": ")
      .slice(1)
      .join(" ")
      .split(/\s+/)
      .filter(Boolean);
    return of.some(
      (file) =>
        (!existsSync(join(root, file)) && !existsSync(file)) ||
        statSync(existsSync(file) && file.startsWith("/") ? file : join(root, file)).mtimeMs > made,
    );
  };
  const work = sources.map((source) => ({ source, object: join(objects, source.replace(/cpp$/, "o")) }));
  const queue = work.filter(({ object }) => is_old(object, object.replace(/o$/, "d")));
  const output = join(objects, "core.js");
  const listed = join(objects, "sources.txt");
  const list = sources.join("\n");
  if (!queue.length && existsSync(output) && existsSync(listed) && readFileSync(listed, "utf8") === list)
    return readFileSync(join(objects, "core.wasm"));
  const one = async () => {
    for (let item; (item = queue.shift());) {
      mkdirSync(dirname(item.object), { recursive: true });
      process.stdout.write(`${item.source}\n`);
      await promisify(execFile)("em++", [...flags, ...include, "-MMD", "-c", item.source, "-o", item.object], {
        cwd: root,
        env,
      });
    }
  };
  await Promise.all(Array.from({ length: Math.min(availableParallelism(), 4) }, one));
  execFileSync("em++", [...flags, ...link, ...work.map(({ object }) => object), "-o", output], {
    cwd: root,
    env,
    stdio: "inherit",
  });
  writeFileSync(listed, list);
  return readFileSync(join(objects, "core.wasm"));
}

async function bundle(entry, format = "iife") {
  const made = await build({
    entryPoints: [join(root, "viewer", "src", entry)],
    bundle: true,
    minify: true,
    write: false,
    format,
    target: "es2022",
    legalComments: "none",
    nodePaths: [objects],
    logLevel: "warning",
    external: ["fs", "path"],
  });
  return made.outputFiles[0].text;
}

const text = (file) => readFileSync(join(root, file), "utf8");
const in_script = (data) => data.replace(/<\/(script)/gi, "<\\/$1").replace(/<!--/g, "<\\!--");
// Formulas between dollars as MathML.
const with_formulas = (html) =>
  html.replace(/\$\$(.+?)\$\$|\$(.+?)\$/gs, (_, block, inline) =>
    temml.renderToString(block ?? inline, { displayMode: block !== undefined, throwOnError: true }),
  );
const in_json = (data) => JSON.stringify(data).replace(/</g, "\\u003c");

async function main() {
  const { values } = parseArgs({
    options: { boost: { type: "string", default: "/usr/include" }, hash: { type: "string" } },
  });
  if (!values.hash) throw new Error("--hash: give what tools/page_hash.py prints");
  const wasm = await compile_core(values.boost);
  const [main_script, worker] = await Promise.all([bundle("main.ts"), bundle("worker.ts")]);
  const scenes = JSON.parse(text("viewer/gallery.json")).map((entry) => {
    const file = [`examples/scenes/${entry.name}.json`, `viewer/gallery/${entry.name}.json`].find((of) =>
      existsSync(join(root, of)),
    );
    return { ...entry, text: text(file) };
  });
  for (const file of files("viewer/lessons"))
    scenes.push({
      name: file
        .split("/")
        .at(-1)
        .replace(/\.json$/, ""),
      text: text(file),
    });
  const script = in_script(main_script);
  const parts = {
    CSP:
      `default-src 'none'; script-src 'sha256-${createHash("sha256").update(script).digest("base64")}' 'wasm-unsafe-eval'; ` +
      "worker-src blob:; style-src 'unsafe-inline'; img-src data: blob:; connect-src 'none'; base-uri 'none'; form-action 'none'; " +
      "require-trusted-types-for 'script'; trusted-types worker drawing",
    HASH: values.hash,
    STYLE: text("viewer/src/style.css"),
    CORE: gzipSync(wasm, { level: 9 }).toString("base64"),
    WORKER: in_script(worker),
    GALLERY: in_json(scenes),
    LESSONS: with_formulas(text("viewer/src/lessons.html")),
    SCRIPT: script,
  };
  const html = text("viewer/src/index.html").replace(/\{\{(\w+)\}\}/g, (_, name) => parts[name]);
  if (Buffer.byteLength(html) > MOST)
    throw new Error(`the page has ${Buffer.byteLength(html)} bytes, more than ${MOST}`);
  mkdirSync(dirname(page), { recursive: true });
  writeFileSync(page, html);
  console.log(
    `${relative(root, page)}: ${(Buffer.byteLength(html) / 1e6).toFixed(2)} MB; core ${(parts.CORE.length / 1e6).toFixed(2)}, ` +
      `script ${(script.length / 1e6).toFixed(2)}, worker ${(worker.length / 1e6).toFixed(2)}`,
  );
}

await main();
