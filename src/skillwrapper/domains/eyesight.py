"""What the embedded model needs to make out the pictures of domains, out of their packages."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Self

from skillwrapper.domains.discovery import bundled_domains, find_domain
from skillwrapper.domains.package import DomainPackage
from skillwrapper.embedded.sight import SceneReader
from skillwrapper.embedded.words import Words


@dataclass(frozen=True)
class Eyesight:
    """Scene readers, and the words that go with them.

    Attributes:
        readers: one of every domain that has one.
        words: of every domain that has some.
    """

    readers: tuple[SceneReader, ...]
    words: tuple[Words, ...]

    @classmethod
    def for_packages(cls, packages: Iterable[DomainPackage]) -> Self:
        """For the pictures of some domains."""
        several = tuple(packages)
        readers = (package.scene_reader for package in several)
        words = (package.words for package in several)
        return cls(
            tuple(reader for reader in readers if reader is not None),
            tuple(some for some in words if some is not None),
        )

    @classmethod
    def for_domain(cls, reference: str | None) -> Self:
        """For the pictures of one domain, or of all that are bundled.

        Raises:
            ConfigurationError: if the domain has no scene reader.
            UnknownNameError: if there is no such domain.
        """
        if reference is None:
            return cls.for_packages(bundled_domains())
        package = find_domain(reference)
        package.require("scene_reader", "the embedded model", "choose another --model, or add one")
        return cls.for_packages([package])
