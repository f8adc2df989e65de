// What scrolls sideways can be reached and scrolled with the keyboard: formulas, tables, listings, once they are set.
function reachable() {
  for (const box of document.querySelectorAll(".math, mjx-container, pre, .pst-scrollable-table-container, .output_area")) {
    if (box.scrollWidth > box.clientWidth) box.tabIndex = 0;
    else if (box.tabIndex === 0) box.removeAttribute("tabindex");
  }
}
window.addEventListener("load", () => setTimeout(reachable, 500));
window.addEventListener("resize", reachable);

// A formula keeps the Chinese mark behind it: no line begins with a comma.
function keepMarks() {
  for (const formula of document.querySelectorAll("span.math")) {
    const mark = /^[，。；：、！？）”》]+/.exec(formula.nextSibling?.data ?? "");
    if (!mark) continue;
    const box = document.createElement("span");
    box.className = "with-mark";
    formula.nextSibling.data = formula.nextSibling.data.slice(mark[0].length);
    formula.replaceWith(box);
    box.append(formula, mark[0]);
  }
}
document.addEventListener("DOMContentLoaded", keepMarks);

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
