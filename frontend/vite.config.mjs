// Builds the page into the package. Parts of the editor that the page never uses are left out.
import react from "@vitejs/plugin-react";
import { cpSync, existsSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { defineConfig } from "vite";
import { hashOfSources } from "./hash-sources.mjs";

const here = import.meta.dirname;
const target = join(here, "..", "src", "pilotage", "web", "static");
const editor = join(here, "node_modules", "@excalidraw", "excalidraw", "dist", "prod");

// Other languages, diagrams from text, subsetting of fonts for export, resizing of pasted pictures.
const UNUSED = /\/locales\/|mermaid-to-excalidraw|subset-(shared|worker)|image-blob-reduce|^pica$|canvas-roundrect-polyfill/;
const FONTS = ["Excalifont"];

const withoutUnused = {
  name: "without-unused",
  enforce: "pre",
  resolveId: (id, importer) => (UNUSED.test(id) && importer?.includes("excalidraw") ? "\0unused" : null),
  load: (id) => (id === "\0unused" ? "export default {}; export const WorkerUrl = undefined;" : null),
  transform: (code, id) =>
    id.includes("excalidraw/dist/prod") ? code.replaceAll("https://esm.sh/", "${location.origin}/assets/") : null,
};

// The licences of all that is packed ask to be packed too.
const withLicences = {
  name: "with-licences",
  generateBundle(_, bundle) {
    const modules = Object.values(bundle).flatMap((chunk) => Object.keys(chunk.modules ?? {}));
    const folders = new Set(modules.map((id) => /^.*node_modules\/(@[^/]+\/)?[^/]+/.exec(id.replace(/^\0/, ""))?.[0]).filter(Boolean));
    const source = [...folders].sort().map(licenceOf).join("\n\n");
    this.emitFile({ type: "asset", fileName: "assets/licences.txt", source: `${source}\n\nExcalifont, Assistant: SIL Open Font License 1.1\n` });
  },
};

function licenceOf(folder) {
  const { name, version, license } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
  const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
  const above = existsSync(join(dirname(folder), "LICENSE")) ? join(dirname(folder), "LICENSE") : null;
  const text = file ? readFileSync(join(folder, file), "utf8").trim() : above ? readFileSync(above, "utf8").trim() : "";
  return `${name} ${version}: ${license}\n\n${text}`.trim();
}

const withFontsAndHash = {
  name: "with-fonts-and-hash",
  closeBundle() {
    for (const font of FONTS) cpSync(join(editor, "fonts", font), join(target, "assets", "fonts", font), { recursive: true });
    writeFileSync(join(target, "sources.sha256"), `${hashOfSources(here)}\n`);
  },
};

export default defineConfig({
  root: here,
  base: "/",
  publicDir: false,
  plugins: [withoutUnused, react(), withLicences, withFontsAndHash],
  define: { "process.env.IS_PREACT": '"false"' },
  build: {
    outDir: target,
    emptyOutDir: true,
    assetsDir: "assets",
    assetsInlineLimit: 0,
    target: "es2022",
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 4000,
    rollupOptions: {
      output: {
        entryFileNames: "assets/[name].js",
        chunkFileNames: "assets/[name].js",
        assetFileNames: "assets/[name][extname]",
      },
    },
  },
});
