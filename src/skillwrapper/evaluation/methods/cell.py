"""A cell of an experiment: one method, one domain, one seed, one noise."""

from __future__ import annotations

import hashlib
import re
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Cell:
    """One method on one domain with one seed and one noise.

    Attributes:
        method: name of the method.
        domain: reference to the domain.
        seed: decides everything left to chance.
        noise: name of a noise profile of the embedded model, or a rate.
    """

    method: str
    domain: str
    seed: int
    noise: str

    @property
    def name(self) -> str:
        """Unique in an experiment; also the name of its folder."""
        return f"{self.method}-{domain_key(self.domain)}-s{self.seed}-{self.noise}"


def domain_key(reference: str) -> str:
    """A name for the domain of a reference that can be part of a file's name.

    A bundled or installed name stays as it is; a path gives the name of its folder and a digest.
    """
    if re.fullmatch(r"[\w.-]+", reference):
        return reference
    return f"{domain_title(reference)}-{hashlib.sha256(reference.encode()).hexdigest()[:8]}"


def domain_title(reference: str) -> str:
    """What tables call the domain of a reference."""
    path = Path(reference.partition(":")[0])
    name = path.parent.name if path.suffix in {".yaml", ".yml"} else path.name
    return re.sub(r"[^\w.-]+", "_", name) or "domain"
