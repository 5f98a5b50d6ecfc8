"""Finds everything in a page that a browser would have to fetch."""

import re
from html.parser import HTMLParser

_LOADED = {"src", "srcset", "href", "xlink:href", "data", "poster", "action", "background"}
_IN_STYLE = re.compile(r"""url\(\s*['"]?(?!data:|#)|@import""", re.IGNORECASE)


class OutsideLinks(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.found: list[str] = []
        self.tags: dict[str, int] = {}
        self.texts: list[str] = []
        self.ids: set[str] = set()
        self.targets: set[str] = set()
        self._open: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags[tag] = self.tags.get(tag, 0) + 1
        self._open.append(tag)
        for name, value in attrs:
            text = value or ""
            if name in _LOADED and not text.startswith(("data:", "#")):
                self.found.append(f"<{tag} {name}={text!r}>")
            if name == "style" and _IN_STYLE.search(text):
                self.found.append(text)
            if name == "id":
                self.ids.add(text)
            if name == "href" and text.startswith("#"):
                self.targets.add(text[1:])

    def handle_data(self, data: str) -> None:
        self.texts.append(data)
        if self._open and self._open[-1] == "style" and _IN_STYLE.search(data):
            self.found.append(data)


def parse(page: str) -> OutsideLinks:
    parser = OutsideLinks()
    parser.feed(page)
    parser.close()
    return parser
