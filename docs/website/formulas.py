"""The formulas of the pages, set when the site is built: by MathJax, in a headless Chromium, each of them once.

What stands in a page afterwards is MathJax's own SVG with its MathML for the blind, and the outlines of the glyphs that
the page uses; the script, 2.2 MB, is no longer loaded, and nothing moves while a page opens. Without Chromium the
pages stay as Sphinx wrote them, and MathJax sets them when they are read.
"""

from __future__ import annotations

import re
from html import unescape
from pathlib import Path

from . import browser

RAW = re.compile(
    r'<(span|div) class="math notranslate nohighlight"([^>]*)>\s*(\\[(\[].*?\\[)\]])\s*</\1>([，。；：、！？）》”]*)',
    re.DOTALL,
)
"""A formula, and the Chinese marks behind it: no line begins with a comma."""
SCRIPTS = re.compile(
    r"<script(?: [^>]*)?>window\.MathJax = .*?</script>\s*|<script [^>]*tex-svg-full\.js[^>]*></script>\s*"
)
USED = re.compile(r'xlink:href="#(MJX-[^"]+)"')
GLYPHS = '<svg class="glyphs" width="0" height="0" aria-hidden="true"><defs>{}</defs></svg>'

PAGE = """<!doctype html><meta charset="utf-8"><body style="font: 16px system-ui, sans-serif"><script>
window.MathJax = {{ options: {{ enableMenu: false }}, svg: {{ fontCache: "global" }}, startup: {{ typeset: false }} }};
</script><script src="{}"></script>"""
SET = """async (formulas) => {
  await MathJax.startup.promise;
  const set = [];
  for (const text of formulas) {
    const box = document.createElement("div");
    box.textContent = text;
    document.body.append(box);
    await MathJax.typesetPromise([box]);
    set.push(box.innerHTML);
  }
  const glyphs = [...document.querySelectorAll("#MJX-SVG-global-cache path")].map((path) => [path.id, path.outerHTML]);
  return [set, Object.fromEntries(glyphs), MathJax.svgStylesheet().textContent];
}"""


def unset(html: str) -> list[str]:
    """Return the formulas in a page that are still TeX, as MathJax reads them."""
    return [unescape(found[3]) for found in RAW.finditer(html)]


def with_formulas(html: str, done: dict[str, str], glyphs: dict[str, str], style: str) -> str:
    """Return a page with its formulas set, the glyphs that they use and MathJax's style, and without its script."""

    def with_mark(m: re.Match[str]) -> str:
        formula = f'<{m[1]} class="math notranslate nohighlight"{m[2]}>{done[unescape(m[3])]}</{m[1]}>'
        return f'<span class="with-mark">{formula}{m[4]}</span>' if m[4] else formula

    html = RAW.sub(with_mark, html)
    used = "".join(glyphs[name] for name in sorted(set(USED.findall(html))))
    html = SCRIPTS.sub("", html).replace("</head>", f"<style>{style}</style>\n</head>", 1)
    return re.sub(r"(<body[^>]*>)", lambda m: m[1] + GLYPHS.format(used), html, count=1)


def write_formulas(html: Path) -> None:
    """Set the formulas of all pages below a folder that have any; say so and do nothing where there is no Chromium."""
    if reason := browser.missing():
        print(f"{reason}; MathJax sets the formulas when a page is read")
        return
    pages = {path: text for path in sorted(html.rglob("*.html")) if unset(text := path.read_text(encoding="utf-8"))}
    formulas = sorted({formula for text in pages.values() for formula in unset(text)})
    script = next(html.rglob("tex-svg-full.js"))
    done, glyphs, style = _set(formulas, script)
    for path, text in pages.items():
        path.write_text(with_formulas(text, done, glyphs, style), encoding="utf-8", newline="\n")


def _set(formulas: list[str], script: Path) -> tuple[dict[str, str], dict[str, str], str]:
    """Return each formula as HTML, the glyphs by their names, and MathJax's style sheet."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as play:
        chromium = play.chromium.launch(executable_path=browser.chromium(), args=["--no-sandbox"])
        page = chromium.new_context(offline=True).new_page()
        start = script.parent / "formulas.html"
        start.write_text(PAGE.format(script.name), encoding="utf-8")
        page.goto(start.resolve().as_uri())
        done, glyphs, style = page.evaluate(SET, formulas)
        start.unlink()
        chromium.close()
    return dict(zip(formulas, done, strict=True)), glyphs, style
