// The questions of a section are printed as a sheet, with or without their answers.
function printSheet(withAnswers) {
  const open = [...document.querySelectorAll(":is(.pencil, .order) details")].map((fold) => [fold, fold.open]);
  for (const [fold] of open) fold.open = withAnswers && fold.matches(".answer, .right, .order details");
  document.documentElement.classList.toggle("with-answers", withAnswers);
  window.print();
  for (const [fold, was] of open) fold.open = was;
}

// The lines of a recursion: a line may stand where all that it needs stands above it.
function firstWrong(order, after) {
  for (let k = 0; k < order.length; k++) {
    const missing = after[order[k]].find((line) => !order.slice(0, k).includes(line));
    if (missing !== undefined) return [k, missing];
  }
  return null;
}

function orderLines(box) {
  const { after, words } = JSON.parse(box.dataset.order), list = box.querySelector("ol");
  const line = (item) => item.querySelector("code").textContent.trim();
  const say = document.createElement("p"), check = document.createElement("button"), keys = document.createElement("p");
  say.setAttribute("role", "status");
  check.type = "button";
  check.textContent = words.check;
  keys.textContent = words.keys;
  const move = (item, by, button) => {
    const other = by < 0 ? item.previousElementSibling : item.nextElementSibling;
    if (!other) return;
    if (by < 0) other.before(item);
    else other.after(item);
    button.focus();
    say.textContent = "";
    box.classList.remove("is-right");
  };
  for (const item of list.children) {
    for (const [word, sign, by] of [["up", "↑", -1], ["down", "↓", 1]]) {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = sign;
      button.setAttribute("aria-label", `${words[word]}: ${line(item)}`);
      button.onclick = () => move(item, by, button);
      button.onkeydown = (event) => {
        const way = { ArrowUp: -1, ArrowDown: 1 }[event.key];
        if (!way) return;
        event.preventDefault();
        move(item, way, button);
      };
      item.append(button);
    }
  }
  check.onclick = () => {
    const items = [...list.children], order = items.map((item) => +item.dataset.line), wrong = firstWrong(order, after);
    const text = (k) => line(items.find((item) => +item.dataset.line === k));
    box.classList.toggle("is-right", !wrong);
    say.textContent = wrong
      ? [wrong[0] + 1, line(items[wrong[0]]), text(wrong[1])].reduce((said, word) => said.replace("{}", word), words.needs)
      : words.done;
  };
  list.before(keys);
  list.after(check, say);
}

if (typeof document !== "undefined") {
  for (const button of document.querySelectorAll("[data-print]")) {
    button.onclick = () => printSheet(button.dataset.print === "answers");
  }
  document.querySelectorAll(".order").forEach(orderLines);
}
