"""Sphinx: the settings of the site, for both languages. docs/build.py writes what it reads and starts it."""

import os
import sys
from importlib import metadata
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import runtime
from website import (
    beside,
    cards,
    chinese,
    crosslinks,
    folds,
    hands,
    inpage,
    interface,
    keywords,
    notebooks,
    prose,
    tables,
    terms,
    units,
)

CHINESE = os.environ.get("SITE_LANGUAGE", "en") == "zh"

project = "twistwrench"
DESCRIPTION = (
    "用纯 NumPy 写成、可对照教材阅读的机器人动力学：twist、wrench、RNEA、ABA、CRBA、浮动基座与质心动量。"
    if CHINESE
    else "Robot dynamics in plain NumPy, to be read beside the chapter: twists, wrenches, RNEA, ABA, CRBA, "
    "the floating base and centroidal momentum."
)
author = "The twistwrench authors"
language = "zh_CN" if CHINESE else "en"
version = release = metadata.version("twistwrench")
copyright = f"The twistwrench authors, BSD-3-Clause, version {version}"

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.mathjax",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
]
templates_path = ["website/templates"]
html_extra_path: list[str] = []
exclude_patterns = ["files/**"]
smartquotes_action = "D" if CHINESE else "qDe"
smartquotes_excludes = {"builders": ["man", "text"]}  # and no language: -- is a dash in Chinese, too
suppress_warnings = ["ref.python"]  # a `Motion` in a docstring may be one of several: the first will do

# ---- pages
myst_enable_extensions = ["amsmath", "colon_fence", "dollarmath"]
myst_heading_anchors = 4
myst_html_meta = {"description": DESCRIPTION}
nb_execution_mode = "off"  # docs/build.py has run them: once for both languages
nb_merge_streams = True
nb_code_prompt_show = "显示代码" if CHINESE else "Show the code"
nb_code_prompt_hide = "收起代码" if CHINESE else "Hide the code"

# ---- the interface, from the docstrings
default_role = "py:obj"
autodoc_member_order = "bysource"
autodoc_typehints = "none"  # the docstrings say more: shape, unit, frame
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_use_ivar = True
add_module_names = False
viewcode_line_numbers = True

# ---- how it looks
html_theme = "pydata_sphinx_theme"
html_title = f"twistwrench {version}"
html_favicon = "website/static/mark.svg"
MARK = "_static/mark.svg"
html_static_path = ["website/static", os.environ.get("SITE_STATIC", "website/static")]
html_css_files = ["site.css"]
html_js_files = ["site.js"]
html_show_sourcelink = False
html_use_index = html_domain_indices = False  # api/index has every name, with what it gives
html_copy_source = False
html_show_search_summary = False  # it would have to fetch the pages, which the file system does not allow
html_sidebars = {"**": ["sidebar-nav-bs"], "index": []} | {f"algorithms/{name}": [] for name in beside.names()}
html_sidebars |= {f"hands/{name}": [] for name in hands.names()}
html_context = {
    "default_mode": "auto",
    "other_language": "en" if CHINESE else "zh",
    "other_language_name": "English" if CHINESE else "中文",
    "other_language_code": "en" if CHINESE else "zh-CN",
    "runs_in_page": runtime.is_complete(),  # where that changes, all pages are written anew
    "other_language_title": "This page in English" if CHINESE else "本页的中文版",
}
html_theme_options = {
    "logo": {"text": "twistwrench", "alt_text": "", "image_light": MARK, "image_dark": MARK},
    "navbar_end": ["theme-switcher"],
    "navbar_persistent": ["search-button-field", "language-switch"],
    "header_links_before_dropdown": 7,
    "navigation_with_keys": False,
    "show_toc_level": 2,
    "footer_start": ["copyright"],
    "footer_end": ["theme-version"],
    "secondary_sidebar_items": ["page-toc"],
    "search_bar_text": "搜索……" if CHINESE else "Search …",
}
mathjax_path = "mathjax/tex-svg-full.js"  # of the site itself: it is read without a network
mathjax3_config = {"options": {"enableMenu": False}, "svg": {"fontCache": "global"}}


def setup(app):
    """Connect what adds formulas to the docstrings, what a page is looked for by, and the links that pages show."""
    app.add_transform(keywords.Keywords)
    tables.connect(app)
    prose.connect(app)
    units.connect(app)
    terms.connect(app)
    crosslinks.connect(app)
    cards.connect(app)
    app.add_search_language(chinese.PairsOfCharacters)
    interface.connect(app, "zh" if CHINESE else "en")
    inpage.connect(app, "zh" if CHINESE else "en", notebooks.names())
    hands.connect(app, "zh" if CHINESE else "en")
    folds.connect(app, "zh" if CHINESE else "en")
