// Pages follow the theme of the editor, hold no scripts, and lead to lines of models.
import assert from "node:assert/strict";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import esbuild from "esbuild";
import { ColorThemeKind, opened, registered, shown, Uri, useTheme } from "./vscode.mjs";

const here = fileURLToPath(new URL(".", import.meta.url));
const made = mkdtempSync(join(tmpdir(), "nddlc-pages-"));
try {
  const outfile = join(made, "views.mjs");
  const editor = pathToFileURL(join(here, "vscode.mjs")).href;
  await esbuild.build({
    entryPoints: [join(here, "../src/views.ts")],
    bundle: true,
    format: "esm",
    platform: "node",
    outfile,
    plugins: [{ name: "editor", setup: (build) => build.onResolve({ filter: /^vscode$/ }, () => ({ path: editor, external: true })) }],
  });
  const { registerViews, showPage, showText } = await import(pathToFileURL(outfile).href);
  registerViews();

  const style = ":root { color-scheme: light dark } @media (prefers-color-scheme: dark) { p { color: #fff } }";
  const place = '<span class="at" data-file="gps/a&amp;b.nddl" data-line="5">gps/a&amp;b.nddl:5</span>';
  showPage("Report", `<!doctype html><html><head><style>${style}</style></head><body>${place}</body></html>`, Uri.file("/work"));
  const { webview, options } = shown.get("Report");
  assert.equal(options.enableScripts, false);
  assert.match(webview.html, /default-src 'none'/);
  assert.match(webview.html, /color-scheme: light }/);
  assert.match(webview.html, /@media not all {/);
  useTheme(ColorThemeKind.Dark);
  assert.match(webview.html, /color-scheme: dark }/);
  assert.match(webview.html, /@media all {/);

  const [, name, query] = webview.html.match(/href="command:([\w.]+)\?([^"]+)"/);
  assert.deepEqual(options.enableCommandUris, [name]);
  await registered.get(name)(...JSON.parse(decodeURIComponent(query)));
  await registered.get(name)("file:///work", "/elsewhere/c.nddl", 1);
  assert.deepEqual(opened, [["/work/gps/a&b.nddl", 4], ["/elsewhere/c.nddl", 0]]);

  showText("Failure", "a < b & <script>", Uri.file("/work"));
  assert.match(shown.get("Failure").webview.html, /a &lt; b &amp; &lt;script>/);
  showText("Failure", '  --> gps/"a".nddl:7\n   7 | int x;\n', Uri.file("/work"));
  const [, link, shownPlace] = shown.get("Failure").webview.html.match(/href="command:[\w.]+\?([^"]+)">([^<]*)</);
  assert.equal(shownPlace, "gps/&quot;a&quot;.nddl:7");
  assert.deepEqual(JSON.parse(decodeURIComponent(link)), ["file:///work", 'gps/"a".nddl', 7]);
  console.log("pages follow the theme and lead to their lines");
} finally {
  rmSync(made, { recursive: true });
}
