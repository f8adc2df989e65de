// What scrolls sideways can be reached and scrolled with the keyboard: formulas, tables, listings, once they are set.
function reachable() {
  for (const box of document.querySelectorAll("div.math, mjx-container, pre, .pst-scrollable-table-container, .output_area")) {
    if (box.scrollWidth > box.clientWidth) box.tabIndex = 0;
    else if (box.tabIndex === 0) box.removeAttribute("tabindex");
  }
}
window.addEventListener("load", () => setTimeout(reachable, 500));
window.addEventListener("resize", reachable);
