"""From a reference to a domain package: bundled, installed, a folder or something in a module."""

from __future__ import annotations

import importlib.metadata
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

from skillwrapper.domains.loading import load_object
from skillwrapper.domains.package import DOMAIN_FILE, DomainPackage
from skillwrapper.errors import ConfigurationError, UnknownNameError

ENTRY_POINTS = "skillwrapper.domains"
"""The group in which an installed package names its domains."""

_BUNDLED = Path(__file__).parent


def bundled_names() -> tuple[str, ...]:
    """Names of the domains that come with the package, sorted."""
    return tuple(sorted(file.parent.name for file in _BUNDLED.glob(f"*/{DOMAIN_FILE}")))


def plain_names() -> tuple[str, ...]:
    """Names of the bundled domains whose robots need no extra of the package, sorted."""
    return tuple(p.reference for p in bundled_domains() if p.entries.extra is None)


def domain_names() -> tuple[str, ...]:
    """Names of the bundled and the installed domains, sorted."""
    return tuple(sorted({*bundled_names(), *_entry_points()}))


def bundled_domains() -> tuple[DomainPackage, ...]:
    """The domains that come with the package."""
    return tuple(find_domain(name) for name in bundled_names())


def find_domain(reference: str) -> DomainPackage:
    """The package that a reference means.

    Args:
        reference: in this order: a bundled domain's name, the name of an installed one (entry
            point of the group ``skillwrapper.domains``), the path of a folder or of its
            ``domain.yaml``, or ``package.module:name`` of a path or ``DomainPackage``. With
            ``@NAME`` behind any of these, one of its drawings takes the place of its robot.

    Raises:
        ConfigurationError: if there is no such folder or module, or a mistake in the file.
        UnknownNameError: if a name is not known.
    """
    plain, at, drawing = reference.rpartition("@")
    if at and plain and not Path(reference).expanduser().exists():
        return find_domain(plain).drawn(drawing)
    if reference in bundled_names():
        return _bundled(reference)
    if reference in _entry_points():
        return _installed(reference)
    path = Path(reference).expanduser()
    if path.exists() or _looks_like_a_path(reference):
        return DomainPackage.read(path)
    if ":" in reference:
        return _as_package(load_object(reference, Path(), f"domain '{reference}'"), reference)
    names = (*domain_names(), "a folder with a domain.yaml")
    raise UnknownNameError("domain", reference, names)


@cache
def _bundled(name: str) -> DomainPackage:
    """A bundled domain: its files do not change while a process is at work."""
    return DomainPackage.read(_BUNDLED / name, name)


def _entry_points() -> Mapping[str, importlib.metadata.EntryPoint]:
    return {found.name: found for found in importlib.metadata.entry_points(group=ENTRY_POINTS)}


def _installed(name: str) -> DomainPackage:
    point = _entry_points()[name]
    try:
        return _as_package(point.load(), name)
    except (ImportError, AttributeError) as error:
        raise ConfigurationError(
            f"installed domain '{name}': {point.value} cannot be loaded ({error})"
        ) from error


def _as_package(found: Any, reference: str) -> DomainPackage:
    """The package that a module's attribute, or the module itself, stands for."""
    if isinstance(found, DomainPackage):
        return DomainPackage.read(found.file, reference)
    if isinstance(found, ModuleType) and found.__file__ is not None:
        return DomainPackage.read(Path(found.__file__).parent, reference)
    if isinstance(found, str | Path):
        return DomainPackage.read(Path(found), reference)
    raise ConfigurationError(
        f"{reference}: expected the path of a domain's folder, got a {type(found).__name__}"
    )


def _looks_like_a_path(reference: str) -> bool:
    return "/" in reference or reference.startswith((".", "~")) or reference.endswith(".yaml")
