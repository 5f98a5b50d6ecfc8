"""A new project: a domain with a fake robot, which runs as it is and is there to be changed."""

from __future__ import annotations

import json
import re
from pathlib import Path

import jinja2

from skillwrapper.errors import UserError
from skillwrapper.files.writing import explained, write_atomically
from skillwrapper.world.domain_file import domain_schema

_TEMPLATES = Path(__file__).parent / "starter"
SCHEMA_FILE = "domain.schema.json"


def start_project(folder: Path) -> tuple[Path, ...]:
    """Write a complete project into a new or empty folder.

    Returns:
        The files.

    Raises:
        UserError: if the folder holds anything, or is none; nothing is written then.
        FileError: if it cannot be written.
    """
    if folder.exists() and not folder.is_dir():
        raise UserError(f"{folder}: expected a new folder, got a file; choose another name")
    with explained(folder):
        if folder.exists() and any(folder.iterdir()):
            raise UserError(
                f"{folder}: expected a new or empty folder, got one with files; choose another "
                "name, nothing was changed"
            )
    contents = {**_rendered(_name_of(folder)), SCHEMA_FILE: schema_text()}
    for name, text in contents.items():
        write_atomically(folder / name, text)
    return tuple(folder / name for name in sorted(contents))


def schema_text() -> str:
    """The JSON Schema of ``domain.yaml``, for editors."""
    return json.dumps(domain_schema(), indent=1) + "\n"


def _rendered(name: str) -> dict[str, str]:
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(_TEMPLATES),
        undefined=jinja2.StrictUndefined,
        keep_trailing_newline=True,
        autoescape=False,
    )
    return {
        template.removesuffix(".j2"): environment.get_template(template).render(name=name)
        for template in environment.list_templates(extensions=["j2"])
    }


def _name_of(folder: Path) -> str:
    """A name that a domain may have, after that of the folder."""
    plain = re.sub(r"[^A-Za-z0-9_-]+", "_", folder.absolute().name).strip("_-")
    return plain if plain[:1].isalpha() and plain.isascii() else f"my_{plain or 'robot'}"
