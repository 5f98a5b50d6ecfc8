"""The site is built without a warning, and is read without a network."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from outside_links import parse

import skillwrapper

pytest.importorskip("mkdocs", reason="the extra docs is not installed")
pytest.importorskip("material", reason="the extra docs is not installed")

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The site, but for the docstrings of the reference, which take most of the time."""
    from mkdocs.commands.build import build  # noqa: PLC0415
    from mkdocs.config import load_config  # noqa: PLC0415

    folder = tmp_path_factory.mktemp("site")
    changed = {"site_dir": str(folder), "strict": True, "plugins": ["search"]}
    build(load_config(str(ROOT / "mkdocs.yml"), **changed))
    return folder


def test_pages_of_the_repository_are_all_there(site: Path) -> None:
    """Strict: a page outside the navigation, or a link to nothing, has ended the build."""
    pages = {path.relative_to(site).with_suffix(".md") for path in site.rglob("*.html")}
    docs = {path.relative_to(ROOT / "docs") for path in (ROOT / "docs").rglob("*.md")}
    docs = {Path(str(path).replace("README", "index")) for path in docs}
    assert docs <= pages
    assert {Path("index.md"), Path("contributing.md"), Path("changelog.md")} <= pages


def test_nothing_is_loaded_from_elsewhere(site: Path) -> None:
    for path in site.rglob("*.html"):
        found = parse(path.read_text("utf-8")).found
        loaded = [f for f in found if not f.startswith("<a ") and "//" in f]
        assert not loaded, path
    for path in site.rglob("*.css"):
        style = path.read_text("utf-8")
        assert "@import" not in style
        assert "url(http" not in style


def test_links_out_of_the_docs_stay_true(site: Path) -> None:
    page = (site / "domains.html").read_text("utf-8")
    assert "examples/greenhouse" in page  # as text: the site does not hold it
    assert '="../examples' not in page
    assert 'href="guide.html"' in (site / "index.html").read_text("utf-8")


def test_reference_has_every_public_name() -> None:
    page = (ROOT / "docs" / "reference.md").read_text("utf-8")
    homes = {f"skillwrapper.{home}.{name}" for name, home in skillwrapper._HOMES.items()}
    assert set(re.findall(r"^::: (\S+)$", page, re.MULTILINE)) == homes
