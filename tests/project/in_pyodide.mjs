// Run pytest in Pyodide: node in_pyodide.mjs FOLDER_OF_PYODIDE CHECKOUT.zip WHEEL... -- ARGUMENTS_OF_PYTEST...
import fs from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";

const [folder, checkout, ...rest] = process.argv.slice(2);
const wheels = rest.slice(0, rest.indexOf("--"));
const asked = rest.slice(rest.indexOf("--") + 1);
const bytes = (file) => new Uint8Array(fs.readFileSync(file));

async function main() {
  const { loadPyodide } = await import(pathToFileURL(path.join(folder, "pyodide.mjs")));
  const python = await loadPyodide({ indexURL: folder, env: { HOME: "/home", MPLBACKEND: "svg", PYTHONDONTWRITEBYTECODE: "1", CI: "1" } });
  const unpack = (file, extractDir) => python.unpackArchive(bytes(file), "zip", { extractDir });
  for (const wheel of wheels) unpack(wheel, python.runPython("import site; site.getsitepackages()[0]"));
  unpack(checkout, "/checkout");
  python.globals.set("asked", python.toPy(asked));
  return python.runPython(`
import importlib, os, sys
sys.path.insert(0, "/checkout/src")
os.chdir("/checkout")
importlib.invalidate_caches()
import pytest
int(pytest.main(list(asked)))
`);
}

main().then(
  (code) => (process.exitCode = code),
  (error) => {
    console.error(error.message); // without the line of the interpreter, which is a megabyte
    process.exitCode = 70;
  },
);
