import { readFileSync } from "node:fs";
import { defineConfig } from "vite";

const BUNDLED = ["three", "meshoptimizer"];

/** The licenses of what the bundle contains, beside it. */
const licenses = {
  name: "licenses",
  generateBundle() {
    const texts = BUNDLED.map((name) => {
      const folder = new URL(`./node_modules/${name}/`, import.meta.url);
      const { version } = JSON.parse(readFileSync(new URL("package.json", folder), "utf-8"));
      const file = name === "three" ? "LICENSE" : "LICENSE.md";
      return `${name} ${version}\n\n${readFileSync(new URL(file, folder), "utf-8").trim()}\n`;
    });
    this.emitFile({ type: "asset", fileName: "licenses.txt", source: texts.join("\n---\n\n") });
  },
};

export default defineConfig({
  base: "./",
  plugins: [licenses],
  build: {
    outDir: "../page",
    emptyOutDir: true,
    target: "es2022",
    modulePreload: false,
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 900,
    // names without hashes, so that a rebuild changes the bytes that the sources changed and no names
    rollupOptions: {
      input: { index: "index.html", draw: "draw.html", trace: "trace.html" },
      output: {
        entryFileNames: ({ name }) => (name === "index" ? "viewer.js" : "[name].js"),
        chunkFileNames: "[name].js",
        assetFileNames: "[name][extname]",
      },
    },
  },
});
