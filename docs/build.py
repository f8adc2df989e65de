"""Build the site, in English and in Chinese, and check it.

usage:  python docs/build.py             the site, below build/site/html; open index.html there
        python docs/build.py --check     and every link in it, and pages of both languages in a headless Chromium
        python docs/build.py --draft en  for an author: one language, and notebooks as they were run before

Needs `pip install -e ".[docs]"`. Every warning is an error. The site works without a network, and is built without one,
but for Python in the page: what runs it is gathered once by docs/runtime.py, and where it cannot be had, the reason is
printed and the pages have no buttons. The first build runs the notebooks; later ones run only those of which something
has changed. The site that is there stays whole until the new one is done; build/site/twistwrench-site.zip is all of it
in one file.
"""

import argparse
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import runtime
import slides
from website import (
    beside,
    browser,
    cards,
    chapter,
    figures,
    formulas,
    hands,
    inpage,
    interface,
    links,
    notebooks,
    pages,
    pencil,
)

OUT = pages.ROOT / "build" / "site"


def stage(languages: Sequence[str], draft: bool, done: Callable[[str], None]) -> None:
    """Write what Sphinx reads: a tree of pages for each language, with the same names in all."""
    new = OUT / "new"
    shutil.rmtree(new, ignore_errors=True)
    trees = {language: new / language for language in languages}
    notebooks.write_notebooks(trees, OUT / "cache", draft)
    done("notebooks written")
    listings = {"studies": pages.studies(), "algorithms": beside.names()}
    listings["project"] = [name for name in ("readme", *pages.PROJECT) if name in pages.pages().values()]
    for language, tree in trees.items():
        figures.write_gallery(tree, notebooks.names(), language)
        pages.write_pages(tree, language)
        cards.write_map(tree, language)
        pages.write_texts(tree, language, listings)
        chapter.write_chapter(tree, language)
        interface.write_interface(tree, language)
        beside.write_algorithms(tree, language)
        hands.write_hands(tree, language)
        pencil.write_pencil(tree, language)
    pages.write(OUT / "static" / "mathjax" / slides.MATHJAX, slides.mathjax())
    for language, tree in trees.items():
        if pages.replace(OUT / "pages" / language, tree):  # a page is gone, and what was built from it goes too
            shutil.rmtree(OUT / "doctrees" / language, ignore_errors=True)
            if draft:  # which is written over the pages that are there
                shutil.rmtree(OUT / "html" / language, ignore_errors=True)
    shutil.rmtree(new)


def sphinx(language: str, html: Path, draft: bool) -> subprocess.Popen[bytes]:
    """Start Sphinx for a language; the other one is built at the same time.

    All pages are written, but for a draft: of those that are not, its search would lose the entries of the index.
    """
    command = [sys.executable, "-m", "sphinx", "--quiet", "--fail-on-warning", "--keep-going", "-c", "docs"]
    command += ["-d", f"{OUT}/doctrees/{language}", f"{OUT}/pages/{language}", f"{html}/{language}"]
    command += [] if draft else ["--write-all"]
    environment = os.environ | {"SITE_LANGUAGE": language, "SITE_STATIC": str(OUT / "static")}
    return subprocess.Popen(command, cwd=pages.ROOT, env=environment)


def write_door(html: Path) -> None:
    """Write the page at the top, which leads to the language that the reader's browser asks for."""
    pages.write(html / "index.html", (Path(__file__).parent / "website" / "door.html").read_text(encoding="utf-8"))


def gather_runtime() -> None:
    """Gather Python for the page, unless it is there; where it cannot be had, say why."""
    try:
        runtime.gather()
    except runtime.Unavailable as reason:
        print(f"Python in the page is left out: {reason}", flush=True)


def exchange(new: Path, html: Path) -> None:
    """Put the new site in the place of the one that is there, and all of it into one file beside it."""
    old = OUT / "old"
    shutil.rmtree(old, ignore_errors=True)
    if html.exists():
        html.rename(old)
    new.rename(html)
    shutil.rmtree(old, ignore_errors=True)
    archive = shutil.make_archive(str(OUT / "twistwrench-site"), "zip", html)
    print(f"{archive}: {Path(archive).stat().st_size / 1e6:.0f} MB", flush=True)


def main() -> int:
    """Build, and check if asked to."""
    parser = argparse.ArgumentParser(description="Build the site.")
    parser.add_argument("--check", action="store_true", help="check every link, and open pages in Chromium")
    parser.add_argument("--draft", choices=pages.LANGUAGES, help="one language alone, with the outputs that are there")
    given, start = parser.parse_args(), time.perf_counter()
    languages = [given.draft] if given.draft else pages.LANGUAGES

    def done(what: str) -> None:
        print(f"{what}: {time.perf_counter() - start:.0f} s", flush=True)

    if not given.draft:
        gather_runtime()
        done("Python for the page")
    stage(languages, bool(given.draft), done)
    done("pages written")
    html = OUT / ("html" if given.draft else "next")
    if not given.draft:
        shutil.rmtree(html, ignore_errors=True)
    runs = [sphinx(language, html, bool(given.draft)) for language in languages]
    if sum(run.wait() for run in runs):  # wait for both
        print("the site was not built: see the warnings above", file=sys.stderr)
        return 1
    done("HTML written")
    formulas.write_formulas(html)
    done("formulas set")
    write_door(html)
    inpage.write_runtime(html)
    inpage.write_downloads(html, languages, notebooks.names())
    slides.write_slides(html, languages)
    if not given.draft:
        exchange(html, OUT / "html")
    done(f"built {OUT / 'html' / 'index.html'}")
    if not given.check:
        return 0
    wrong = [*links.check(OUT / "html")]
    done("links checked")
    wrong += browser.check(OUT / "html")
    done("pages opened")
    print(*wrong, sep="\n")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
