"""The bundled domains by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

from skillwrapper.errors import UnknownNameError
from skillwrapper.world.environment import Environment


def _make_burger() -> Environment:
    from skillwrapper.domains.burger.environment import BurgerEnvironment  # noqa: PLC0415

    return BurgerEnvironment()


# Each factory imports its simulator itself, so that a domain whose packages are not installed
# does not keep the others from being used.
_FACTORIES: Mapping[str, Callable[[], Environment]] = MappingProxyType({"burger": _make_burger})


def domain_names() -> tuple[str, ...]:
    """Names of the bundled domains, sorted."""
    return tuple(sorted(_FACTORIES))


def make_environment(name: str) -> Environment:
    """A new environment of a bundled domain.

    Raises:
        UnknownNameError: if there is no such domain.
    """
    return _FACTORIES[_checked(name)]()


def domain_file(name: str) -> Path:
    """The ``domain.yaml`` of a bundled domain.

    Raises:
        UnknownNameError: if there is no such domain.
    """
    return Path(__file__).parent / _checked(name) / "domain.yaml"


def _checked(name: str) -> str:
    if name not in _FACTORIES:
        raise UnknownNameError("domain", name, _FACTORIES)
    return name
