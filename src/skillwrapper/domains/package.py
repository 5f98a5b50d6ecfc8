"""A domain package: a folder with ``domain.yaml`` and everything else that is of one domain.

================= ================================================================================
key               what it names
================= ================================================================================
robot             a ``Robot`` or ``Environment``, or a function that makes one
drawings          the same with pictures drawn in other ways, by name, for studies
scene_reader      a function from the bytes of a picture to a ``SceneGraph``, for the embedded model
words             a file of words that the embedded model lacks
expert            ``model``: a file of predicates and operators written by hand, ``atoms``: a
                  function from a state to the true atoms of its predicates
system_predicates the predicates of which ``Truthful.true_atoms`` tells what is true
problems          a file of test problems
structure         a function from a state to a text; problems are spread over its values
impossibility     an ``Impossibility``: why some states cannot be reached
pairs             a file of contrastive pairs for the study of invention
published         a file of published figures, to stand beside those of experiments
doctor            a file of pictures for trying out a model
================= ================================================================================

Files are named relative to the folder; code by a reference (``skillwrapper.domains.loading``). All
but ``robot`` may be missing, and so may that, for learning from recordings alone.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from skillwrapper.domains.loading import blamed, load_object
from skillwrapper.embedded.sight import SceneReader
from skillwrapper.embedded.words import Words, read_words
from skillwrapper.errors import ConfigurationError, UnknownNameError
from skillwrapper.files.yaml_documents import YamlDocument
from skillwrapper.symbols import AbstractModel, Atom, Predicate
from skillwrapper.symbols.files import read_model
from skillwrapper.world.domain import Domain, build_domain
from skillwrapper.world.domain_file import DomainFile
from skillwrapper.world.environment import Environment
from skillwrapper.world.robot import Robot, RobotEnvironment

DOMAIN_FILE = "domain.yaml"
_METHODS = ("reset", "execute", "observe", "close")
_ATTRIBUTES = ("domain", "scene")


@dataclass(frozen=True)
class Expert:
    """A model of a domain written by hand: a baseline, and the truth that studies compare with.

    Attributes:
        model: predicates and operators.
        atoms: the atoms of its predicates that are true in a state.
    """

    model: AbstractModel
    atoms: Callable[[Any], Iterable[Atom]]


@dataclass(frozen=True)
class Impossibility:
    """Why some states cannot be reached from others; for choosing test problems only.

    Attributes:
        kinds: names of the known reasons.
        explain: kind and reason, from start and goal; None where no reason is known.
    """

    kinds: tuple[str, ...]
    explain: Callable[[Any, Any], tuple[str, str] | None]


@dataclass(frozen=True)
class DomainPackage:
    """A domain with its robot and its other parts, each loaded when it is asked for.

    Attributes:
        reference: how the package is found again; written into runs.
        document: its ``domain.yaml``.
        domain: types, objects, skills and scenes.
        entries: what the file says.
    """

    reference: str
    document: YamlDocument = field(repr=False)
    domain: Domain = field(repr=False)
    entries: DomainFile = field(repr=False)

    @classmethod
    def read(cls, path: Path, reference: str | None = None) -> DomainPackage:
        """The package of a folder, or of a ``domain.yaml`` of any name.

        Args:
            path: folder or file.
            reference: how it is found again; None for its absolute path.

        Raises:
            ConfigurationError: if there is no such folder or file, or a mistake in it; names file
                and line.
        """
        path = path.expanduser().absolute()
        file = path / DOMAIN_FILE if path.is_dir() else path
        if not file.exists():
            raise ConfigurationError(f"{path}: {_what_is_missing(path)}")
        document = YamlDocument.read(file)
        domain = build_domain(document)
        return cls(reference or str(path), document, domain, document.validate(DomainFile))

    @property
    def file(self) -> Path:
        """Its ``domain.yaml``."""
        return self.document.path

    @property
    def folder(self) -> Path:
        """Where its files are."""
        return self.file.parent

    def has(self, part: str) -> bool:
        """Whether a key of the file names something."""
        return bool(getattr(self.entries, part))

    def require(self, part: str, purpose: str, otherwise: str = "") -> None:
        """Make sure that a key of the file names something.

        Args:
            part: the key.
            purpose: what it is needed for.
            otherwise: what can be done instead.

        Raises:
            ConfigurationError: if it does not.
        """
        if not self.has(part):
            raise self._missing(part, purpose, otherwise)

    def make_environment(self, drawing: str | None = None) -> Environment:
        """A new environment.

        Args:
            drawing: name of one of the drawings; None for the usual one.

        Raises:
            ConfigurationError: if there is none, it cannot be made, or lacks a method; names file
                and line.
            UnknownNameError: if there is no such drawing, or the class does not exist.
        """
        if drawing is None:
            return self._make(self._named("robot", "executing skills"), ("robot",))
        if drawing not in self.entries.drawings:
            raise UnknownNameError("drawing", drawing, self.entries.drawings)
        return self._make(self.entries.drawings[drawing], ("drawings", drawing))

    def drawn(self, drawing: str) -> DomainPackage:
        """The same package with one of its drawings for its robot.

        Raises:
            UnknownNameError: if there is no such drawing.
        """
        if drawing not in self.entries.drawings:
            raise UnknownNameError("drawing", drawing, self.entries.drawings, self.reference)
        entries = self.entries.model_copy(update={"robot": self.entries.drawings[drawing]})
        return replace(self, reference=f"{self.reference}@{drawing}", entries=entries)

    @property
    def scene_reader(self) -> SceneReader | None:
        """Reads pictures for the embedded model; None if there is none."""
        reader: SceneReader | None = self._optional("scene_reader")
        return reader

    @property
    def words(self) -> Words | None:
        """The words that the embedded model lacks; None if there are none."""
        return read_words(self._file("words", "the embedded model")) if self.has("words") else None

    @property
    def expert(self) -> Expert:
        """The model written by hand.

        Raises:
            ConfigurationError: if there is none.
        """
        entry = self.entries.expert
        if entry is None:
            raise self._missing("expert", "comparing with an expert's model")
        atoms = self._load(entry.atoms, ("expert", "atoms"))
        return Expert(read_model(self.folder / entry.model, self.domain), atoms)

    @property
    def system_predicates(self) -> tuple[Predicate, ...]:
        """The predicates in which the simulator describes its states.

        Raises:
            ConfigurationError: if there are none.
        """
        purpose = "learning with the simulator's own predicates"
        return tuple(self._load(self._named("system_predicates", purpose), ("system_predicates",)))

    @property
    def problems(self) -> Path:
        """The file of test problems.

        Raises:
            ConfigurationError: if there is none.
        """
        return self._file("problems", "test problems")

    @property
    def structure(self) -> Callable[[Any], str]:
        """What is alike of states, as text; by default all are alike."""
        return self._optional("structure") or _all_alike

    @property
    def impossibility(self) -> Impossibility:
        """Why some states cannot be reached; by default only that it was found by search.

        Raises:
            ConfigurationError: if the key names something else.
        """
        found = self._optional("impossibility")
        if found is None:
            return Impossibility(("unreachable",), _found_by_search)
        if not isinstance(found, Impossibility):
            raise self._unexpected(("impossibility",), "an Impossibility", found)
        return found

    @property
    def pairs(self) -> Path:
        """The file of contrastive pairs.

        Raises:
            ConfigurationError: if there is none.
        """
        return self._file("pairs", "the study of invention")

    @property
    def published(self) -> Path:
        """The file of published figures.

        Raises:
            ConfigurationError: if there is none.
        """
        return self._file("published", "published figures")

    @property
    def doctor(self) -> Path:
        """The file of pictures for trying out a model.

        Raises:
            ConfigurationError: if there is none.
        """
        return self._file("doctor", "trying out a model")

    def _make(self, reference: str, location: tuple[str, ...]) -> Environment:
        where = self._place(location)
        maker = self._load(reference, location)
        if not callable(maker):
            raise self._unexpected(location, "a class or a function", maker)
        if inspect.isclass(maker):
            _check_members(maker, _METHODS, f"{where}: {reference}")
        with blamed(self.folder, f"{where}: {reference}"):
            made = maker(**({"domain": self.domain} if _takes_domain(maker) else {}))
        if isinstance(made, Robot):
            return RobotEnvironment(made, self.domain)
        _check_members(made, (*_METHODS, *_ATTRIBUTES), f"{where}: {reference}")
        environment: Environment = made
        if environment.domain != self.domain:
            raise ConfigurationError(
                f"{where}: expected {reference} to have the domain of this file, got another"
            )
        return environment

    def _optional(self, part: str) -> Any:
        reference = getattr(self.entries, part)
        return None if reference is None else self._load(reference, (part,))

    def _named(self, part: str, purpose: str) -> str:
        named: str | None = getattr(self.entries, part)
        if named is None:
            raise self._missing(part, purpose)
        return named

    def _missing(self, part: str, purpose: str, otherwise: str = "") -> ConfigurationError:
        hint = f"; {otherwise}" if otherwise else ""
        return ConfigurationError(
            f"{self.file}: expected a key '{part}' for {purpose}, got none{hint}"
        )

    def _unexpected(self, location: Sequence[str], wanted: str, got: object) -> ConfigurationError:
        kind = type(got).__name__
        return ConfigurationError(f"{self._place(location)}: expected {wanted}, got a {kind}")

    def _load(self, reference: str, location: Sequence[str]) -> Any:
        return load_object(reference, self.folder, self._place(location))

    def _file(self, part: str, purpose: str) -> Path:
        file = self.folder / self._named(part, purpose)
        if not file.is_file():
            raise ConfigurationError(f"{self._place((part,))}: expected a file {file}, got none")
        return file

    def _place(self, location: Sequence[str]) -> str:
        return self.document.place(tuple(location))


def _what_is_missing(path: Path) -> str:
    if path.is_dir():
        return f"expected a {DOMAIN_FILE} in the folder of a domain, got none"
    return (
        f"no such file or folder; expected a folder with a {DOMAIN_FILE} (a run finds its domain "
        "by 'domain' in its config.yaml)"
    )


def _check_members(thing: object, members: Iterable[str], what: str) -> None:
    """A class has what its base class leaves open, and else all of the protocol."""
    lacking = sorted(getattr(thing, "__abstractmethods__", ()))
    if not lacking and not (inspect.isclass(thing) and issubclass(thing, Robot)):
        lacking = [name for name in members if not hasattr(thing, name)]
    if lacking:
        raise ConfigurationError(
            f"{what} lacks {', '.join(lacking)}; expected a Robot, a Simulator or an Environment"
        )


def _takes_domain(maker: Callable[..., Any]) -> bool:
    try:
        return "domain" in inspect.signature(maker).parameters
    except (TypeError, ValueError):
        return False


def _found_by_search(_: object, __: object) -> tuple[str, str]:
    return "unreachable", "no sequence of skills leads there"


def _all_alike(_: object) -> str:
    return ""
