"""Open pages of both languages in a headless Chromium, from the file system and without a network, wide and narrow.

Asked of each: formulas set and figures shown, nothing that jumps, nothing on the console, nothing wider than a phone,
the language switch reached with Tab and its focus seen. And of the search: the page that is looked for is found first.
What axe-core can judge of WCAG 2.1 A and AA, and its best practice, is asked of the English pages, wide and light, and
of the Chinese ones, narrow and dark; in the long page of errata not of the code, whose colours are those of the other
pages. Where Python is in the page, an exercise is answered there, and the verdict has to name the slip.

Each run opens the first page of each language and some others, drawn anew; TWISTWRENCH_DRAW=all takes all of them.
"""

from __future__ import annotations

import os
import random
import shutil
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any
from urllib.parse import quote

from .pages import LANGUAGES

PAGES = ("index", "chapter/49_06_rnea", "algorithms/rnea", "api/algorithms/rnea", "errata", "conventions")
PAGES += ("hands/frames", "hands/feet", "map", "algorithms/index", "chapter/index", "gallery", "trade", "pencil/49_07")
WIDE, NARROW = {"width": 1280, "height": 900}, {"width": 390, "height": 844}
SOUGHT = {
    "en": {"mass matrix": "49_08_crba", "errata": "errata", "aba": "49_07_aba", "Jacobian frame": "kinematics"},
    "zh": {"质量矩阵": "49_08_crba", "勘误": "errata", "雅可比": "kinematics"},
}
"""What is looked up, and the page that has to be found first."""
AXE = (("en", "light"), ("zh", "dark"))
DRAWN_BY = "TWISTWRENCH_DRAW"
"""The variable that draws what a run looks at, as in tests/sampling.py; `all` leaves nothing out."""
PAGES_DRAWN = 3
"""Of each language, beside the first page."""
MOST_TABS = 40
SLIP = {"en": "Kind of slip: sign.", "zh": "错误类型：符号。"}
MOST_TO_START = 180_000
"""Milliseconds until Python answers in a page, on a machine that does other things too."""
RULES = {"runOnly": {"type": "tag", "values": ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "best-practice"]}}

FORMULAS = """async () => {
  if (window.MathJax) await MathJax.startup.promise;
  const left = [...document.querySelectorAll(".math")].filter((e) => !e.querySelector("mjx-container svg"));
  return [left.length, document.querySelectorAll("mjx-merror, [data-mjx-error]").length];
}"""
HIDDEN = """async () => {
  const images = [...document.images], done = (i) => new Promise((go) => (i.onload = i.onerror = go));
  images.forEach((i) => (i.loading = "eager"));  // those further down as well
  await Promise.all(images.filter((i) => !i.complete).map(done));
  return images.filter((i) => !i.naturalWidth).map((i) => i.getAttribute("src"));
}"""
SHIFT = """() => new Promise((done) => {
  let sum = 0;
  new PerformanceObserver((list) => list.getEntries().forEach((entry) => (sum += entry.value)))
    .observe({ type: "layout-shift", buffered: true });
  setTimeout(() => done(sum), 100);
})"""
MOST_SHIFT = 0.1
"""Of the layout while a page opens, as browsers measure it: more is felt as a jump."""
TOO_WIDE = "() => document.scrollingElement.scrollWidth - window.innerWidth"
FOCUS = """() => {
  const e = document.activeElement, style = getComputedStyle(e);
  const seen = (style.outlineStyle !== "none" && parseFloat(style.outlineWidth) > 0) || style.boxShadow !== "none";
  return [e.classList.contains("language-switch"), seen];
}"""


def chromium() -> str | None:
    """Return where the Chromium of this machine is; $CHROMIUM names another."""
    return os.environ.get("CHROMIUM") or shutil.which("chromium") or shutil.which("chromium-browser")


def missing() -> str | None:
    """Return why no page can be opened here, or None."""
    try:
        import axe_playwright_python  # noqa: F401
        import playwright  # noqa: F401
    except ImportError as error:
        return f"{error.name} is not installed: no page is opened"
    return None if chromium() else "no chromium on the PATH, and $CHROMIUM is not set: no page is opened"


def drawn(items: Iterable[Any], count: int, name: str) -> list[Any]:
    """Return so many items, others for another name and in another run; all where TWISTWRENCH_DRAW=all."""
    seed, items = os.environ[DRAWN_BY], list(items)
    return items if seed == "all" else random.Random(seed + name).sample(items, min(count, len(items)))


def check(html: Path) -> list[str]:
    """Return what is wrong with the pages; says so and returns nothing where there is no Chromium."""
    if reason := missing():
        print(reason)
        return []
    seed = os.environ.setdefault(DRAWN_BY, str(random.randrange(1000)))
    print(f"pages to open are drawn: {DRAWN_BY}={seed} (all: {DRAWN_BY}=all)", flush=True)
    with ThreadPoolExecutor(len(LANGUAGES)) as pool:
        wrong = [line for lines in pool.map(partial(_language, html), LANGUAGES) for line in lines]
    if (html / "runtime").exists():
        wrong += [line for language in drawn(LANGUAGES, 1, "runs") for line in runs(html, language)]
    else:
        print("Python in the page was not gathered (docs/runtime.py): no page is run")
    return wrong


def _language(html: Path, language: str) -> list[str]:
    """Return what is wrong with the pages of one language, with a browser of its own."""
    from playwright.sync_api import sync_playwright

    wrong, names = [], [PAGES[0], *drawn(PAGES[1:], PAGES_DRAWN, language)]
    with sync_playwright() as play:
        browser = play.chromium.launch(executable_path=chromium(), args=["--no-sandbox"])
        for size, scheme in ((WIDE, "light"), (NARROW, "dark")):
            context = browser.new_context(viewport=size, color_scheme=scheme, offline=True)
            for name in names:
                page = context.new_page()
                found = [*looks(page, html / language / f"{name}.html"), *reach(page)]
                if (language, scheme) in AXE:
                    found += accessible(page, name)
                wrong += [f"{language}/{name} at {size['width']} px, {scheme}: {what}" for what in found]
                page.close()
            sought = dict(drawn(SOUGHT[language].items(), 1, f"{language} {scheme}"))
            results = search(context, html / language, sought)
            wrong += [f"{language}/search at {size['width']} px: {what}" for what in results]
            context.close()
        browser.close()
    return wrong


def looks(page: Any, file: Path) -> Iterator[str]:
    """Open a page, and yield what can be seen to be wrong, and what it says on the console."""
    said: list[str] = []
    page.on("console", lambda message: said.append(message.text) if message.type in ("error", "warning") else None)
    page.on("pageerror", lambda error: said.append(str(error)))
    page.on("request", lambda request: None if request.url.startswith(("file:", "data:")) else said.append(request.url))
    page.goto(file.resolve().as_uri(), wait_until="load")
    unset, broken = page.evaluate(FORMULAS)
    if unset or broken:
        yield f"{unset} formulas not set, {broken} in error"
    page.wait_for_timeout(700)  # site.js looks at what scrolls half a second after loading
    if (shift := page.evaluate(SHIFT)) > MOST_SHIFT:
        yield f"the page jumps while it opens, by {shift:.2f}"
    if hidden := page.evaluate(HIDDEN):
        yield f"figures not shown: {hidden}"
    if (excess := page.evaluate(TOO_WIDE)) > 0:
        yield f"{excess} px wider than the window"
    yield from dict.fromkeys(f"on the console: {line}" for line in said)


def search(context: Any, html: Path, sought: dict[str, str]) -> Iterator[str]:
    """Look things up, and yield what is wrong with what was found."""
    from playwright.sync_api import TimeoutError as NothingFound

    for query, wanted in sought.items():
        page = context.new_page()
        page.goto(f"{(html / 'search.html').resolve().as_uri()}?q={quote(query)}")
        found = page.locator("#search-results li a").first
        try:
            found.wait_for(timeout=10_000)
            page.wait_for_timeout(300)  # the results come one after the other
        except NothingFound:
            yield f"nothing found for {query}"
        else:
            if wanted not in (first := found.get_attribute("href") or ""):
                yield f"{query}: {first} is found first, not {wanted}"
        page.close()


def runs(html: Path, language: str) -> Iterator[str]:
    """Answer an exercise wrongly in its page, have it checked, and yield what is wrong with the verdict."""
    from playwright.sync_api import Error, sync_playwright

    with sync_playwright() as play:
        browser = play.chromium.launch(executable_path=chromium(), args=["--no-sandbox"])
        page = browser.new_context(viewport=NARROW, offline=True).new_page()
        page.goto((html / language / "chapter" / "exercises.html").resolve().as_uri())
        place = page.locator(".exercise").first
        place.locator("summary").click()
        place.locator("pre").first.click()
        page.keyboard.press("Control+a")
        page.keyboard.insert_text("def skew(w):\n    return -tw.skew(w)\n")
        place.locator(".run-tools button").nth(1).click()
        try:
            place.locator(".tw-wrong").wait_for(timeout=MOST_TO_START)
        except Error:
            yield f"{language}: no verdict on an exercise, but {page.locator('.run-dock').inner_text()!r}"
        else:
            if SLIP[language] not in place.locator(".tw-wrong").inner_text():
                yield f"{language}: the kind of slip is not named: {place.locator('.tw-wrong').inner_text()}"
        browser.close()


def reach(page: Any) -> Iterator[str]:
    """Tab from the top to the language switch."""
    for _ in range(MOST_TABS):
        page.keyboard.press("Tab")
        there, seen = page.evaluate(FOCUS)
        if there:
            if not seen:
                yield "the focus on the language switch cannot be seen"
            return
    yield f"the language switch is not reached with {MOST_TABS} tabs"


def accessible(page: Any, name: str) -> Iterator[str]:
    """Ask axe-core, and yield the rules that are broken and where."""
    from axe_playwright_python.sync_playwright import Axe

    context = {"exclude": [["pre"]]} if name == "errata" else None
    for rule in Axe().run(page, context=context, options=RULES).response["violations"]:
        places = [node["target"][0] for node in rule["nodes"]]
        yield f"{rule['id']} ({rule['help']}): {len(places)} places, {places[:3]}"
