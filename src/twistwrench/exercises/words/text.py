"""A text in two languages."""

from __future__ import annotations

import os
from typing import Literal, NamedTuple

__all__ = ["Language", "Text", "default_language"]

Language = Literal["en", "zh"]


class Text(NamedTuple):
    """A text in English and in Simplified Chinese."""

    en: str
    zh: str

    def of(self, language: Language) -> str:
        """Return the text in one language."""
        return self.zh if language == "zh" else self.en

    def fill(self, **values: object) -> Text:
        """Fill the braces; a value that is itself a `Text` goes to each language in that language."""
        en, zh = ({k: v.of(code) if isinstance(v, Text) else v for k, v in values.items()} for code in ("en", "zh"))
        return Text(self.en.format(**en), self.zh.format(**zh))


def default_language() -> Language:
    """Return the language of the environment; English unless it is Chinese."""
    asked = next((os.environ[k] for k in ("LC_ALL", "LC_MESSAGES", "LANG") if os.environ.get(k)), "")
    return "zh" if asked.lower().startswith("zh") else "en"
