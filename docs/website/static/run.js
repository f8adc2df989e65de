// Run this page: cells and exercises are edited, run and checked where they stand, by Python in a worker.
// Nothing is loaded before the first click. It comes as scripts, since a page of the file system may not fetch.
(() => {
  const RUNTIME = new URL("../../runtime/", document.currentScript.src);
  const MATHJAX = new URL("mathjax/tex-svg-full.js", document.currentScript.src);
  const CHINESE = document.documentElement.lang.startsWith("zh");
  const LANGUAGE = CHINESE ? "zh" : "en";
  const PAGE = location.pathname.split("/").pop().replace(".html", "");
  const SAY = CHINESE
    ? {
        run: "运行", all: "运行全部", check: "检查", hint: "提示", reset: "还原", stop: "停止", save: "下载我的答案",
        open: "读入答案", running: "正在运行……", loading: "正在载入 Python：", starting: "正在启动 Python……",
        stopped: "已停止；变量已清空。", failed: "未能载入：", code: "代码，可以编辑；Esc 之后 Tab 离开",
        above: "先运行上面的单元", figure: "运行所得的图", took: (s) => `用时 ${s} 秒`, read: (n) => `读入了 ${n} 题的答案。`,
      }
    : {
        run: "Run", all: "Run all", check: "Check", hint: "Hint", reset: "Reset", stop: "Stop", save: "Download my answers",
        open: "Open answers", running: "running …", loading: "loading Python: ", starting: "starting Python …",
        stopped: "Stopped; what was defined is gone.", failed: "Could not be loaded: ",
        code: "code, to be edited; Escape and then Tab leaves it", above: "with the cells above",
        figure: "the figure that the cell draws", took: (s) => `${s} s`, read: (n) => `Read the answers to ${n} exercises.`,
      };
  const MB = (bytes) => (bytes / 1e6).toFixed(1);

  // ---------------------------------------------------------------- what is kept in this browser
  const kept = (key) => JSON.parse(localStorage.getItem(`twistwrench/${key}`) ?? "null");
  const keep = (key, value) =>
    value === null ? localStorage.removeItem(`twistwrench/${key}`) : localStorage.setItem(`twistwrench/${key}`, JSON.stringify(value));
  const answers = () => {
    const found = Object.keys(localStorage).filter((key) => key.startsWith("twistwrench/answer/"));
    return Object.fromEntries(found.map((key) => [key.split("/").pop(), JSON.parse(localStorage.getItem(key)).now]));
  };

  // ---------------------------------------------------------------- the runtime, and the worker
  const received = new Map(), loading = {}; // name: base64, and group: its files
  let groups, worker, count = 0, pending = new Map(), toLoad = 0, loaded = 0;
  window.twistwrenchFile = (name, text) => received.set(name, text);
  window.twistwrenchGroups = (value) => (groups = value);

  const script = (name) =>
    new Promise((resolve, reject) => {
      const element = document.createElement("script");
      element.src = new URL(name, RUNTIME);
      element.onload = () => { element.remove(); resolve(); };
      element.onerror = () => reject(new Error(SAY.failed + element.src));
      document.head.append(element);
    });

  // The formulas of the page were set when the site was built: MathJax is loaded for those of a result.
  const mathjax = () => (loading.mathjax ??= window.MathJax?.typesetPromise ? Promise.resolve() : startMathJax());

  function startMathJax() {
    const done = new Promise((ready) => {
      window.MathJax = { options: { enableMenu: false }, startup: { typeset: false, ready: () => (MathJax.startup.defaultReady(), ready()) } };
    });
    return script(MATHJAX).then(() => done);
  }

  const load = (group) => (loading[group] ??= loadGroup(group));

  async function loadGroup(group) {
    groups ?? (await script("groups.js"));
    toLoad += groups[group].reduce((sum, [, size]) => sum + size, 0);
    const one = async ([name, size]) => {
      await script(`${name}.js`);
      loaded += size;
      progress();
      return [name, received.get(name)];
    };
    return Promise.all(groups[group].map(one));
  }

  function progress() {
    bar.progress.hidden = loaded >= toLoad;
    [bar.progress.max, bar.progress.value] = [toLoad, loaded];
    say(loaded < toLoad ? `${SAY.loading}${MB(loaded)} / ${MB(toLoad)} MB` : SAY.starting);
  }

  async function begin() {
    const [[, text]] = await load("worker");
    worker = new Worker(URL.createObjectURL(new Blob([atob(text)], { type: "text/javascript" })));
    worker.onerror = (event) => say(SAY.failed + event.message);
    worker.onmessage = async ({ data }) => {
      if (data.need) {
        load(data.need).then((files) => worker.postMessage({ group: data.need, files }), (error) => say(error.message));
      } else {
        const { resolve, reject } = pending.get(data.id);
        pending.delete(data.id);
        if (data.state) keep("state", data.state);
        if (!data.failed) return resolve(data.result);
        reject(new Error(`${data.failed} ${SAY.stopped}`)); // Python itself has ended, as after an endless recursion
        stop();
      }
    };
    for (const group of ["core", "base", ...alsoNeeded()]) load(group).catch((error) => say(error.message)); // all at once
  }
  const alsoNeeded = () => ["matplotlib", "sympy"].filter((name) => cells.some((cell) => cell.code().includes(`import ${name}`)));
  let begun;

  async function ask(call, ...given) {
    await (begun ??= begin());
    bar.stop.hidden = false;
    const start = performance.now(), id = ++count;
    const result = new Promise((resolve, reject) => pending.set(id, { resolve, reject }));
    if (bar.progress.hidden) say(SAY.running);
    worker.postMessage({ id, call, given });
    try {
      return await result;
    } finally {
      if (!pending.size) {
        bar.stop.hidden = true;
        const took = SAY.took(((performance.now() - start) / 1000).toFixed(1));
        say(took);
        setTimeout(() => bar.status.textContent === took && say(""), 4000);
      }
    }
  }

  function stop() {
    worker?.terminate();
    begun = worker = undefined;
    for (const { reject } of pending.values()) reject(new Error(SAY.stopped));
    pending.clear();
    for (const cell of cells) cell.done = false;
  }

  // ---------------------------------------------------------------- what is shown
  const element = (tag, properties = {}, ...inside) => {
    const made = Object.assign(document.createElement(tag), properties);
    made.append(...inside);
    return made;
  };
  const button = (text, act, title = "") => element("button", { type: "button", className: "run-button", textContent: text, onclick: act, title });
  const say = (text) => { bar.status.textContent = text; bar.dock.hidden = !text; };

  const SHOW = {
    out: (text) => element("pre", { textContent: text }),
    err: (text) => element("pre", { className: "run-err", textContent: text }),
    error: (text) => element("pre", { className: "run-error", textContent: text }),
    hint: (text) => element("pre", { className: "run-hint", textContent: text }),
    html: (text) => element("div", { innerHTML: text }),
    latex: (text) => element("div", { className: "math", textContent: text }),
    right: (text) => element("div", { innerHTML: text }),
    wrong: (text) => element("div", { innerHTML: text }),
    figure: (text) => element("img", { src: URL.createObjectURL(new Blob([text], { type: "image/svg+xml" })), alt: SAY.figure }),
  };

  function show(box, outputs) {
    box.replaceChildren(...outputs.map(([kind, text]) => SHOW[kind](text)));
    box.classList.remove("run-waiting");
    if (outputs.some(([kind]) => kind === "latex")) mathjax().then(() => MathJax.typesetPromise([box]));
  }

  // ---------------------------------------------------------------- a listing that can be edited
  const WORDS = "and as assert break class continue def del elif else except False finally for from if import in is lambda None not or pass raise return True try while with yield";
  const STRING = String.raw`[rbfu]?("""|''')[\s\S]*?\3|[rbfu]?(?:"[^"\n]*"|'[^'\n]*')`;
  const TOKEN = new RegExp(`(?<c1>#.*)|(?<s1>${STRING})|(?<k>\\b(?:${WORDS.replaceAll(" ", "|")})\\b)|(?<mi>\\b\\d[\\w.]*)`, "g");

  // Colour a listing as Pygments does, as far as comments, strings, keywords and numbers.
  function paint(pre, text) {
    let at = 0;
    const pieces = [];
    for (const match of text.matchAll(TOKEN)) {
      const [kind] = Object.entries(match.groups).find(([, found]) => found !== undefined);
      pieces.push(text.slice(at, match.index), element("span", { className: kind, textContent: match[0] }));
      at = match.index + match[0].length;
    }
    pre.replaceChildren(...pieces, text.slice(at));
  }

  function editable(pre, key) {
    const flat = (copy) => { // a browser may write a line's end as <br>
      for (const end of copy.querySelectorAll("br")) end.replaceWith("\n");
      return copy.textContent;
    };
    const text = () => flat(pre.cloneNode(true));
    const original = text(), html = pre.innerHTML, saved = kept(key);
    pre.contentEditable = "true";
    try { pre.contentEditable = "plaintext-only"; } catch { /* an older Firefox */ }
    Object.assign(pre, { spellcheck: false, role: "textbox", ariaMultiLine: "true", ariaLabel: SAY.code });
    if (saved && (saved.was === original || key.startsWith("answer/"))) paint(pre, saved.now); // an answer outlives its skeleton
    const code = () => text().replace(/\n+$/, "");
    pre.addEventListener("input", () => keep(key, text() === original ? null : { was: original, now: code() }));
    pre.addEventListener("keydown", (event) => {
      const insert = (text) => { event.preventDefault(); document.execCommand("insertText", false, text); };
      if (event.key === "Tab" && !event.shiftKey && !event.ctrlKey && !event.altKey) insert("    ");
      if (event.key === "Enter" && !event.shiftKey && !event.ctrlKey) {
        const range = getSelection().getRangeAt(0).cloneRange();
        range.setStart(pre, 0);
        const line = flat(range.cloneContents()).split("\n").pop();
        insert("\n" + /^ */.exec(line)[0] + (line.trimEnd().endsWith(":") ? "    " : ""));
      }
      if (event.key === "Escape") pre.blur();
    });
    pre.addEventListener("blur", () => text() === original || paint(pre, text()));
    const reset = () => { pre.innerHTML = html; keep(key, null); };
    return { code, reset, original, isChanged: () => kept(key) !== null };
  }

  // ---------------------------------------------------------------- cells of a notebook
  const cells = [], places = {};

  async function runTo(last) {
    for (const cell of cells.slice(0, last + 1)) if (!cell.done || cell === cells[last]) await runCell(cell);
  }

  async function runCell(cell) {
    cell.box.classList.add("run-waiting");
    const code = cell.code();
    try {
      const outputs = await ask("run", code, PAGE, `cell ${cell.number + 1}`);
      show(cell.box, outputs);
      if (outputs.some(([kind]) => kind === "error")) throw new Error(outputs.find(([kind]) => kind === "error")[1].trim().split("\n").pop());
      cell.done = true;
    } catch (error) {
      cell.box.classList.remove("run-waiting");
      say(error.message);
      throw error;
    }
  }

  function addCell(box, number) {
    const cell = Object.assign(editable(box.querySelector(".cell_input pre"), `cell/${PAGE}/${number}`), { number, done: false });
    const fold = box.querySelector(":scope.tag_hide-cell > details") ?? box; // its outputs are folded away with it
    cell.box = fold.querySelector(":scope > .cell_output") ?? fold.appendChild(element("div", { className: "cell_output docutils container" }));
    const before = [...cell.box.childNodes], act = () => runTo(number).catch(() => {});
    const back = () => { cell.reset(); cell.done = false; cell.box.replaceChildren(...before); };
    const tools = element("div", { className: "run-tools" }, button(`▶ ${SAY.run}`, act, number ? SAY.above : ""), button(SAY.reset, back));
    cell.box.ariaLive = "polite";
    box.querySelector(".cell_input").append(tools);
    box.addEventListener("input", () => (cell.done = false));
    box.addEventListener("keydown", (event) => { if (event.key === "Enter" && (event.shiftKey || event.ctrlKey)) { event.preventDefault(); act(); } });
    cells.push(cell);
  }

  // ---------------------------------------------------------------- exercises
  function addExercise(place) {
    const number = place.dataset.number, key = `answer/${number}`;
    const answer = editable(place.querySelector("pre"), key);
    const [box, hints] = [1, 2].map(() => element("div", { className: "run-output", ariaLive: "polite" }));
    const act = (call) => async () => {
      box.classList.add("run-waiting");
      const all = { ...answers(), [number]: answer.code() };
      try {
        const outputs = await ask(call, number, all, kept("state") ?? "", LANGUAGE);
        if (call === "hint") {
          const news = outputs.filter(([, text]) => text !== hints.lastChild?.textContent);  // the solution comes again
          hints.append(...news.map(([kind, text]) => SHOW[kind](text)));
          box.classList.remove("run-waiting");
        } else show(box, outputs);
        if (call === "check") mark(outputs.some(([kind]) => kind === "right"));
      } catch (error) {
        say(error.message);
        box.classList.remove("run-waiting");
      }
    };
    const mark = (right) => { keep(`right/${number}`, right); place.classList.toggle("is-right", right); };
    const back = () => { answer.reset(); box.replaceChildren(); hints.replaceChildren(); mark(false); };
    const tools = [button(`▶ ${SAY.run}`, act("try_out")), button(SAY.check, act("check")), button(SAY.hint, act("hint")), button(SAY.reset, back)];
    place.append(element("div", { className: "run-tools" }, ...tools), box, hints);
    place.addEventListener("keydown", (event) => { if (event.key === "Enter" && (event.shiftKey || event.ctrlKey)) { event.preventDefault(); act("check")(); } });
    places[number] = { original: answer.original, pre: place.querySelector("pre"), box: place };
    place.classList.toggle("is-right", kept(`right/${number}`) === true);
    if (answer.isChanged()) place.open = true;
  }

  async function download() {
    const content = await ask("archive", answers(), kept("state") ?? "", LANGUAGE);
    element("a", { href: `data:application/zip;base64,${content}`, download: "answers.zip" }).click();
  }

  // The files of a folder of answers, put into the page: each answer that differs from its skeleton.
  async function open(chosen) {
    const texts = await Promise.all([...chosen].map(async (file) => [file.name, await file.text()]));
    const found = await ask("answers", Object.fromEntries(texts));
    for (const [number, now] of found) {
      const place = places[number];
      keep(`answer/${number}`, { was: place.original, now });
      paint(place.pre, now);
      place.box.open = true;
    }
    const state = texts.find(([name]) => name.endsWith(".json"));
    if (state) keep("state", state[1]);
    say(SAY.read(found.length));
  }

  // ---------------------------------------------------------------- the bar under the title, and what stands at the foot of the window
  const bar = { status: element("span", { role: "status" }), progress: element("progress", { hidden: true, ariaLabel: SAY.loading }), stop: button(SAY.stop, stop) };
  bar.dock = element("div", { className: "run-dock", hidden: true }, bar.progress, bar.status, bar.stop);
  document.addEventListener("DOMContentLoaded", () => {
    const place = document.querySelector(".run-bar");
    if (!place) return;
    bar.stop.hidden = true;
    document.querySelectorAll("div.cell:has(> .cell_input), div.cell:has(.cell_input)").forEach(addCell);
    document.querySelectorAll(".exercise[data-number]").forEach(addExercise);
    const fails = (error) => say(error.message);
    const files = element("input", { type: "file", multiple: true, hidden: true, onchange: () => open(files.files).catch(fails) });
    const tools = cells.length
      ? [button(`▶ ${SAY.all}`, () => runTo(cells.length - 1).catch(() => {}))]
      : [button(SAY.save, () => download().catch(fails)), button(SAY.open, () => files.click()), files];
    place.append(...tools);
    document.body.append(bar.dock);
  });
})();
