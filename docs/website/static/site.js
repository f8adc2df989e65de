// What scrolls can be reached and scrolled with the keyboard: formulas, tables, listings, once they are set.
function reachable() {
  for (const box of document.querySelectorAll(".math, mjx-container, pre, .pst-scrollable-table-container, .output_area, .digits")) {
    if (box.scrollWidth > box.clientWidth || box.scrollHeight > box.clientHeight + 1) box.tabIndex = 0;
    else if (box.tabIndex === 0) box.removeAttribute("tabindex");
  }
}
window.addEventListener("load", () => setTimeout(reachable, 500));
window.addEventListener("resize", reachable);

// What opens a part of the list of pages bears the name of that part.
function nameToggles() {
  for (const toggle of document.querySelectorAll("nav li > details > summary")) {
    toggle.setAttribute("aria-label", toggle.closest("li").querySelector("a").textContent.trim());
  }
}
document.addEventListener("DOMContentLoaded", nameToggles);

// What a button is called is what it shows: the words on it, not others.
function nameByWords() {
  for (const shown of document.querySelectorAll("details.hide > summary[aria-label]")) shown.removeAttribute("aria-label");
  for (const search of document.querySelectorAll(".search-button-field")) {
    search.setAttribute("aria-label", search.textContent.replace(/\s+/g, " ").trim());
  }
}
document.addEventListener("DOMContentLoaded", nameByWords);

// A box that finds entries of a long list by words; an entry, or the part that has it, opens where a link leads to it.
function find(box) {
  const field = box.querySelector("input"), status = box.querySelector("span");
  const entries = [...document.querySelectorAll(box.dataset.entries)], folds = [...document.querySelectorAll(".entry")];
  const texts = entries.map((entry) => entry.textContent.toLowerCase());
  const button = document.createElement("button");
  button.type = "button";
  const turn = (open) => {
    folds.forEach((fold) => (fold.open = open));
    button.textContent = open ? box.dataset.none : box.dataset.all;
  };
  button.onclick = () => turn(!folds.every((fold) => fold.open));
  field.oninput = () => {
    const words = field.value.toLowerCase().split(/\s+/).filter(Boolean);
    entries.forEach((entry, k) => (entry.hidden = !words.every((word) => texts[k].includes(word))));
    for (const section of box.parentElement.querySelectorAll("section")) {
      const inside = entries.filter((entry) => section.contains(entry));
      section.hidden = words.length > 0 && !inside.some((entry) => !entry.hidden);
    }
    const left = entries.filter((entry) => !entry.hidden).length;
    if (entries[0] !== folds[0]) folds.forEach((fold) => (fold.open = words.length > 0));
    status.textContent = words.length ? box.dataset.count.replace("{}", left).replace("{}", entries.length) : "";
  };
  box.append(button);
  turn(false);
  box.hidden = false;
}
function unfold() {
  const goal = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  for (const fold of [goal?.closest(".entry"), goal?.querySelector(":scope > .entry")]) if (fold) fold.open = true;
  if (goal?.closest("section")?.querySelector(".entry")) goal.scrollIntoView();
}
document.addEventListener("DOMContentLoaded", () => {
  document.querySelectorAll(".find").forEach(find);
  unfold();
});
window.addEventListener("hashchange", unfold);
