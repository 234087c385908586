// Bundles the page: node build.mjs SOURCE_FOLDER PAGE. Script and style go into page.html, which then needs no other file.
import { readFileSync, writeFileSync, renameSync } from "node:fs";
import { join } from "node:path";
import { createRequire } from "node:module";

const esbuild = createRequire(join(process.cwd(), "build.mjs"))("esbuild");
const [source, page] = process.argv.slice(2);

async function bundle(entry) {
  const result = await esbuild.build({
    entryPoints: [join(source, entry)],
    bundle: true,
    minify: true,
    write: false,
    format: "iife",
    target: ["chrome100", "firefox113", "safari16.4"],
    legalComments: "inline", // the licences of three.js and uPlot stay in the page
    nodePaths: [join(process.cwd(), "node_modules")],
    logLevel: "warning",
  });
  return result.outputFiles[0].text;
}

const style = await bundle("style.css");
const script = await bundle("main.js");
// A function as replacement: `$` in the bundle means nothing.
const html = readFileSync(join(source, "page.html"), "utf8")
  .replace("@@STYLE@@", () => style.replaceAll("</style", "<\\/style"))
  .replace("@@SCRIPT@@", () => script.replaceAll("</script", "<\\/script"));
writeFileSync(page + ".part", html);
renameSync(page + ".part", page);
