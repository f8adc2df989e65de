"""The search of the Chinese pages: without a dictionary, by every two characters that stand side by side.

Sphinx's own needs a dictionary of 20 MB (jieba), and without it finds no Chinese word; that of Sphinx 9.0 stops at an
error of its own (sphinx-doc/sphinx#14229).
"""

from __future__ import annotations

import re

from sphinx.search import SearchLanguage

HAN = "\u4e00-\u9fff"
SPLIT = """
function splitQuery(query) {
  const found = query.match(/[\\u4e00-\\u9fff]+|[\\p{L}\\p{N}_]+/gu) || [];
  return found.flatMap((run) => {
    if (!/[\\u4e00-\\u9fff]/.test(run) || run.length < 3) return [run];
    return [...run].slice(1).map((after, k) => run[k] + after);
  });
}
"""


class PairsOfCharacters(SearchLanguage):
    """Chinese by pairs of characters, everything else by words."""

    lang = "zh"
    language_name = "Chinese"
    js_splitter_code = SPLIT

    def split(self, text: str) -> list[str]:
        """Return the words of a text: 质量矩阵 is 质量, 量矩 and 矩阵."""
        words = []
        for run in re.findall(rf"[{HAN}]+|[^\W{HAN}]+", text):
            pairs = [run[k : k + 2] for k in range(len(run) - 1)] if re.match(rf"[{HAN}]", run) else []
            words += pairs or [run]
        return words

    def stem(self, word: str) -> str:
        """Return a word as it is looked up."""
        return word.lower()

    def word_filter(self, word: str) -> bool:
        """Return whether a word is worth looking up."""
        return len(word) > 1
