"""Build the site, in English and in Chinese, and check it.

usage:  python docs/build.py             the site, below build/site/html; open index.html there
        python docs/build.py --check     and every link in it, and pages of both languages in a headless Chromium
        python docs/build.py --draft en  for an author: one language, and notebooks as they were run before

Needs `pip install -e ".[docs]"`. Every warning is an error. Nothing is fetched: the site, and building it, work without
a network. The first build runs the notebooks; later ones run only those of which something has changed. Where
docs/runtime.py has gathered Python for the page, notebooks and exercises can be run in it.
"""

import argparse
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from importlib.metadata import files
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

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
)

OUT = pages.ROOT / "build" / "site"
MATHJAX = "tex-svg-full.js"


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
    mathjax = next(f for f in files("sphinx-mathjax-offline") or [] if f.name == MATHJAX)
    target = OUT / "static" / "mathjax" / MATHJAX
    pages.write(target, mathjax.read_text(encoding="utf-8"))
    for language, tree in trees.items():
        if pages.replace(OUT / "pages" / language, tree):  # a page is gone, and what was built from it goes too
            shutil.rmtree(OUT / "html" / language, ignore_errors=True)
            shutil.rmtree(OUT / "doctrees" / language, ignore_errors=True)
    shutil.rmtree(new)


def sphinx(language: str, draft: bool) -> subprocess.Popen[bytes]:
    """Start Sphinx for a language; the other one is built at the same time.

    All pages are written, but for a draft: of those that are not, its search would lose the entries of the index.
    """
    command = [sys.executable, "-m", "sphinx", "--quiet", "--fail-on-warning", "--keep-going", "-c", "docs"]
    command += ["-d", f"{OUT}/doctrees/{language}", f"{OUT}/pages/{language}", f"{OUT}/html/{language}"]
    command += [] if draft else ["--write-all"]
    environment = os.environ | {"SITE_LANGUAGE": language, "SITE_STATIC": str(OUT / "static")}
    return subprocess.Popen(command, cwd=pages.ROOT, env=environment)


def write_door(html: Path) -> None:
    """Write the page at the top, which leads to the language that the reader's browser asks for."""
    pages.write(html / "index.html", (Path(__file__).parent / "website" / "door.html").read_text(encoding="utf-8"))


def main() -> int:
    """Build, and check if asked to."""
    parser = argparse.ArgumentParser(description="Build the site.")
    parser.add_argument("--check", action="store_true", help="check every link, and open pages in Chromium")
    parser.add_argument("--draft", choices=pages.LANGUAGES, help="one language alone, with the outputs that are there")
    given, start = parser.parse_args(), time.perf_counter()
    languages = [given.draft] if given.draft else pages.LANGUAGES

    def done(what: str) -> None:
        print(f"{what}: {time.perf_counter() - start:.0f} s", flush=True)

    stage(languages, bool(given.draft), done)
    done("pages written")
    runs = [sphinx(language, bool(given.draft)) for language in languages]
    if sum(run.wait() for run in runs):  # wait for both
        print("the site was not built: see the warnings above", file=sys.stderr)
        return 1
    done("HTML written")
    formulas.write_formulas(OUT / "html")
    done("formulas set")
    write_door(OUT / "html")
    inpage.write_runtime(OUT / "html")
    inpage.write_downloads(OUT / "html", languages, notebooks.names())
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
