// Builds the page into the package. Parts of the editor that the page never uses are left out.
import react from "@vitejs/plugin-react";
import { cpSync, writeFileSync } from "node:fs";
import { join } from "node:path";
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
  plugins: [withoutUnused, react(), withFontsAndHash],
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
