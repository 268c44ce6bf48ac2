// Prints the hash of all that the build of the page depends on; `check-build.sh` compares it with the packed one.
import { createHash } from "node:crypto";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";

const SINGLE = ["index.html", "package.json", "tsconfig.json", "vite.config.mjs", "hash-sources.mjs"];

export function hashOfSources(folder) {
  const sources = readdirSync(join(folder, "src"), { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => join(entry.parentPath, entry.name).slice(folder.length + 1));
  const hash = createHash("sha256");
  for (const name of [...SINGLE, ...sources].sort()) {
    hash.update(`${name}\0`);
    hash.update(readFileSync(join(folder, name)));
  }
  return hash.digest("hex");
}

if (process.argv[1] === import.meta.filename) console.log(hashOfSources(import.meta.dirname));
