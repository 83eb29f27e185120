// Builds the page: node build.mjs MODULE.wasm OUT.html
//
// The page is one file: script, style, the compressed module, and the licenses of the packages. It needs no server. Its
// security policy allows only its own script, and forbids every connection.
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync, existsSync, readdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const [modulePath, outPath] = process.argv.slice(2);
if (!modulePath || !outPath) {
  console.error("usage: node build.mjs MODULE.wasm OUT.html");
  process.exit(2);
}

/** Bundles one entry file into one classic script; returns its text and the folders of the packages in it. */
async function bundle(entry, define = {}) {
  const result = await build({
    entryPoints: [join(here, "source", entry)],
    absWorkingDir: here,
    bundle: true,
    minify: true,
    write: false,
    metafile: true,
    format: "iife",
    target: "es2022",
    charset: "utf8",
    legalComments: "none",
    define,
  });
  const packages = Object.keys(result.metafile.inputs)
    .map((path) => path.match(/^(node_modules\/(?:@[^/]+\/)?[^/]+)\//)?.[1])
    .filter(Boolean);
  return { text: result.outputFiles[0].text, packages };
}

/** Returns the name, version and license text of each package. */
function licenses(folders) {
  return [...new Set(folders)].sort().map((folder) => {
    const { name, version } = JSON.parse(readFileSync(join(here, folder, "package.json"), "utf8"));
    const file = readdirSync(join(here, folder)).find((entry) => /^licen[cs]e/i.test(entry));
    if (!file) throw new Error(`the package ${name} has no license file`);
    return `${name} ${version}\n\n${readFileSync(join(here, folder, file), "utf8").trim()}`;
  });
}

/** Leaves out the custom sections of a module: names of functions and the like, which no code reads. */
function withoutNames(module) {
  const kept = [module.subarray(0, 8)];
  for (let at = 8; at < module.length; ) {
    const start = at;
    const isCustom = module[at++] === 0;
    let size = 0;
    let bits = 0;
    do {
      size += (module[at] & 127) * 2 ** bits;
      bits += 7;
    } while (module[at++] & 128);
    at += size;
    if (!isCustom) kept.push(module.subarray(start, at));
  }
  return Buffer.concat(kept);
}

/** Makes text safe inside a script element. */
const inScript = (text) => text.replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");
const escaped = (text) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;");

if (!existsSync(modulePath)) {
  console.error(`there is no module ${modulePath}`);
  process.exit(1);
}
const worker = await bundle("worker.js");
const page = await bundle("main.js", { WORKER_TEXT: JSON.stringify(worker.text) });
const style = await build({ entryPoints: [join(here, "source/style.css")], minify: true, write: false });
const script = inScript(page.text);
const hash = createHash("sha256").update(script).digest("base64");
const policy = [
  "default-src 'none'",
  `script-src 'sha256-${hash}' 'wasm-unsafe-eval' blob:`,
  "worker-src blob:",
  "style-src 'unsafe-inline'",
  "img-src data: blob:",
  "base-uri 'none'",
  "form-action 'none'",
].join("; ");
const parts = {
  POLICY: policy,
  STYLE: style.outputFiles[0].text.trim(),
  SCRIPT: script,
  MODULE: gzipSync(withoutNames(readFileSync(modulePath)), { level: 9 }).toString("base64"),
  LICENSES: escaped(licenses([...page.packages, ...worker.packages]).join("\n\n----\n\n")),
};
const template = readFileSync(join(here, "source/index.html"), "utf8");
const html = template.replace(/%([A-Z]+)%/g, (all, name) => parts[name] ?? all);
writeFileSync(outPath, html);
const size = (bytes) => `${(bytes / 1e6).toFixed(2)} MB`;
console.log(`${outPath}: ${size(Buffer.byteLength(html))}, compressed ${size(gzipSync(html, { level: 9 }).length)}`);
