// Python, beside the page: loads Pyodide from files that the page hands over, and runs what the page asks for.
const files = new Map(); // name: bytes
const waiting = new Map(); // what the page was asked for: how to go on when it comes
let python, classroom;

// Pyodide declines a classic worker, which it knows by this function; a module worker cannot come from a page of the
// file system. What Pyodide needs of a module worker, `import()`, is here too.
self.importScripts = () => { throw new TypeError("not used"); };

const decoded = (text) => Uint8Array.fromBase64?.(text) ?? Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

async function keep(name, text) {
  let bytes = decoded(text);
  if (name.endsWith(".gz")) {
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  }
  files.set(name.replace(/\.gz$/, ""), bytes);
}

// Nothing is fetched: what Pyodide asks for is here.
self.fetch = async (url) => {
  const name = String(url.url ?? url).split("/").pop();
  if (!files.has(name)) return new Response(null, { status: 404, statusText: `${name} is not among the files` });
  return new Response(files.get(name), { headers: { "Content-Type": name.endsWith("wasm") ? "application/wasm" : "" } });
};

const imported = (name) => import(URL.createObjectURL(new Blob([files.get(name)], { type: "text/javascript" })));

async function boot() {
  const [{ loadPyodide }, { default: createPyodideModule }] = await Promise.all(
    ["pyodide.mjs", "pyodide.asm.mjs"].map(imported),
  );
  python = await loadPyodide({
    indexURL: "memory:/",
    createPyodideModule,
    lockFileContents: new TextDecoder().decode(files.get("lock.json")),
    packageBaseUrl: "memory:/",
    env: { HOME: "/home", MPLBACKEND: "svg", PYTHONDONTWRITEBYTECODE: "1" },
  });
}

function unpack(group) {
  const place = python.runPython("import site; site.getsitepackages()[0]");
  for (const name of group) {
    python.unpackArchive(files.get(name), "zip", { extractDir: place });
    files.delete(name);
  }
  python.runPython("import importlib; importlib.invalidate_caches()");
}

// Ask the page for a group of files, and go on when they are here.
function need(group) {
  return new Promise((resolve) => {
    waiting.set(group, resolve);
    postMessage({ need: group });
  });
}

async function start() {
  unpack(await need("core").then(boot).then(() => need("base")));
  classroom = python.pyimport("classroom");
}
let ready;

async function answer({ id, call, given }) {
  await (ready ??= start());
  for (;;) {
    const outputs = classroom[call](...given.map((value) => python.toPy(value)));
    const result = outputs?.toJs?.() ?? outputs;
    if (result?.[0]?.[0] !== "needs") return postMessage({ id, result, state: classroom.remembered() });
    const group = result[0][1] === "matplotlib" ? "matplotlib" : "sympy";
    unpack(await need(group));
  }
}

let queue = Promise.resolve();
onmessage = async ({ data }) => {
  if (data.group) {
    for (const [name, text] of data.files) await keep(name, text);
    waiting.get(data.group)(data.files.map(([name]) => name.replace(/\.gz$/, "")));
  } else {
    queue = queue.then(() => answer(data)).catch((error) => postMessage({ id: data.id, failed: error.message }));
  }
};
