"""The report of a run as one HTML file that needs nothing else."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from skillwrapper.files.writing import write_atomically
from skillwrapper.report.contents import ReportContents
from skillwrapper.report.pictures import PictureBook
from skillwrapper.runs.archive import RunArchive

_TEMPLATES = "report/templates"


@dataclass(frozen=True)
class ReportSettings:
    """How much a report shows.

    Attributes:
        picture_width: of the pictures in the page, in pixels.
        episodes: how many episodes are shown with their pictures, at most; the richest ones.
    """

    picture_width: int = 224
    episodes: int = 12


def render_report(archive: RunArchive, settings: ReportSettings | None = None) -> str:
    """The page; equal folders give equal pages.

    Raises:
        UserError: if no iteration is finished, or a file is damaged.
    """
    settings = settings or ReportSettings()
    pictures = PictureBook(archive.pictures, settings.picture_width)
    environment = page_environment()
    environment.globals["picture_uri"] = pictures.uri
    contents = ReportContents.gather(archive, settings.episodes)
    return environment.get_template("report.html.j2").render(run=contents)


def write_report(
    archive: RunArchive, out: Path | None = None, settings: ReportSettings | None = None
) -> Path:
    """Write the page, by default as ``report.html`` into the run's folder; returns where.

    Raises:
        UserError: if no iteration is finished, or a file is damaged.
    """
    target = out or archive.path / "report.html"
    write_atomically(target, render_report(archive, settings))
    return target


@cache
def page_environment() -> Environment:
    """What renders the templates of reports; each of them is compiled once."""
    environment = Environment(
        loader=PackageLoader("skillwrapper", _TEMPLATES),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=StrictUndefined,
    )
    environment.globals["style"] = partial(_read_style, environment)
    return environment


def _read_style(environment: Environment) -> Markup:
    """The style sheet, which is ours and needs no escaping."""
    return Markup(environment.get_template("report.css").render())
