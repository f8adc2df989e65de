// What scrolls can be reached and scrolled with the keyboard: formulas, tables, listings, once they are set.
function reachable() {
  for (const box of document.querySelectorAll(".math, mjx-container, pre, .pst-scrollable-table-container, .output_area")) {
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
