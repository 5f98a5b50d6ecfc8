"""Making the folder of a run, keeping others out of it, and giving it up again."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import yaml

from skillwrapper.errors import RunFolderError, UserError
from skillwrapper.files.locking import locked
from skillwrapper.files.writing import (
    explained,
    is_leftover,
    remove_leftovers,
    write_atomically,
)
from skillwrapper.runs.archive.archive import RunArchive
from skillwrapper.runs.archive.layout import RunLayout
from skillwrapper.runs.archive.records import FORMAT
from skillwrapper.runs.provenance import provenance
from skillwrapper.runs.settings import RunSettings
from skillwrapper.world.domain import Domain, domain_to_yaml


def make_archive(path: Path, settings: RunSettings, domain: Domain) -> RunArchive:
    """A new folder, or the folder of a run with the same settings.

    Args:
        path: of the folder.
        settings: what is asked for.
        domain: what is learned in.

    Raises:
        RunFolderError: if the path holds something else, a run with other settings or of another
            domain.
        FileError: if it cannot be written.
    """
    layout = RunLayout(path)
    if path.exists() and not path.is_dir():
        raise RunFolderError(f"{path}: expected a folder, got a file; choose another --out")
    if layout.config.exists():
        archive = RunArchive.open(path)
        _check_settings(archive, settings)
        _keep_domain(archive, domain)
        remove_leftovers(path)
        return archive
    if path.exists() and not all(map(is_leftover, path.iterdir())):
        raise RunFolderError(
            f"{path} is not empty and holds no run; choose another --out, nothing was changed"
        )
    remove_leftovers(path)
    # First what makes the folder a run: one that was stopped right here can be resumed.
    _write_settings(layout, settings)
    write_atomically(layout.domain, domain_to_yaml(domain))
    return RunArchive(path)


def restate_settings(archive: RunArchive, settings: RunSettings) -> None:
    """Change what a run is asked to do that has episodes, but nothing was learned from them yet."""
    if archive.layout.finished_iterations() == 0 and archive.settings().difference(settings):
        _write_settings(archive.layout, settings)


def _write_settings(layout: RunLayout, settings: RunSettings) -> None:
    entries = {
        "format": FORMAT,
        "run": settings.model_dump(mode="json"),
        "made_with": provenance().model_dump(mode="json"),
    }
    write_atomically(layout.config, yaml.safe_dump(entries, sort_keys=False))


def discard_beginning(archive: RunArchive) -> None:
    """Remove what making the folder and a start without any result have written."""
    layout = archive.layout
    stores = layout.root.glob(f"{layout.calls.name}*")
    for path in (layout.config, layout.domain, layout.events, *stores):
        path.unlink(missing_ok=True)


@contextmanager
def reserved(path: Path) -> Iterator[None]:
    """Keep other runs out of a folder; one that is made for it and stays empty is removed.

    The operating system lets go of the folder when the process ends, however it ends.

    Raises:
        RunFolderError: if another run is at work in it, or it is a file.
        FileError: if it cannot be made.
    """
    if path.exists() and not path.is_dir():
        raise RunFolderError(f"{path}: expected a folder, got a file; choose another --out")
    is_new = not path.exists()
    with explained(path):
        path.mkdir(parents=True, exist_ok=True)
    busy = (
        f"{path}: another process is learning in this folder; wait until it ends, or choose "
        "another --out"
    )
    try:
        with locked(path, busy):
            yield
    finally:
        if is_new and not any(path.iterdir()):
            path.rmdir()


def _check_settings(archive: RunArchive, settings: RunSettings) -> None:
    difference = archive.settings().difference(settings)
    if difference:
        raise RunFolderError(
            f"{archive.path} holds a run with other settings ({difference}); "
            "give the same settings to resume it, or choose another --out"
        )


def _keep_domain(archive: RunArchive, domain: Domain) -> None:
    """Keep the domain as it was when the run started; write it again if it was damaged."""
    text = domain_to_yaml(domain)
    try:
        known = domain_to_yaml(archive.domain())
    except UserError:
        write_atomically(archive.layout.domain, text)
        return
    if known != text:
        raise RunFolderError(
            f"{archive.path}: the domain '{domain.name}' is not what it was when the run started "
            f"({archive.layout.domain}); choose another --out"
        )
