"""What the site has beside docs/: pages of the repository's root, and links that stay true there.

On a code host, the links of a page lead through the repository. On the site, those to pages lead to
pages; those to other files of the repository become their text, as the site does not hold them. A
link to nothing is left as it is, and ends a strict build.
"""

from __future__ import annotations

import posixpath
import re
from pathlib import Path

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

ROOT = Path(__file__).parents[2]
OF_ROOT = {
    "README.md": "index.md",
    "CONTRIBUTING.md": "contributing.md",
    "CHANGELOG.md": "changelog.md",
}
"""Pages of the repository's root, with their places on the site."""

_LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)#\s]+)(#[^)\s]*)?\)")
_ELSEWHERE = re.compile(r"[a-z]+:|/")


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the pages of the root."""
    for name, place in OF_ROOT.items():
        files.append(File.generated(config, place, content=(ROOT / name).read_text("utf-8")))
    return files


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Turn the links of the repository into those of the site."""
    place = page.file.src_uri
    own = next((name for name, there in OF_ROOT.items() if there == place), f"docs/{place}")
    return _LINK.sub(lambda link: _on_site(link, posixpath.dirname(own), place), markdown)


def _on_site(link: re.Match[str], folder: str, place: str) -> str:
    mark, text, target, anchor = link.groups()
    if _ELSEWHERE.match(target):
        return link[0]
    path = posixpath.normpath(posixpath.join(folder, target))
    there = OF_ROOT.get(path) or path.removeprefix("docs/")
    if path in OF_ROOT or path.startswith("docs/"):
        return f"{mark}[{text}]({posixpath.relpath(there, posixpath.dirname(place))}{anchor or ''})"
    return text if (ROOT / path).exists() else link[0]
