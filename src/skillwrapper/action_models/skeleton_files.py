"""Domain skeletons out of PDDL files; preconditions and effects there are not looked at."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from skillwrapper.action_models.lisp import Form, read_form
from skillwrapper.action_models.skeleton import ROOT, DomainSkeleton, Schema, TypedName
from skillwrapper.errors import ConfigurationError, FileError, UnknownNameError
from skillwrapper.files.json_documents import read_text
from skillwrapper.world.types import TypeHierarchy

_Items = Sequence[str | Form]


def read_skeleton(path: Path) -> DomainSkeleton:
    """Read types, constants, predicates and the parameters of actions.

    Args:
        path: a PDDL domain; its actions may lack preconditions and effects.

    Raises:
        UserError: if it cannot be read or says what cannot be; names file and line.
    """
    return parse_skeleton(read_text(path), str(path))


def parse_skeleton(text: str, name: str) -> DomainSkeleton:
    """As ``read_skeleton``, from the text of a file of some name."""
    return skeleton_of(read_form(text, name))


def skeleton_of(form: Form) -> DomainSkeleton:
    """As ``read_skeleton``, from a file that is read already."""
    if form.head != "define":
        raise FileError(f"{form.where}: expected a PDDL domain, '(define (domain NAME) ...)'")
    return _Reader(form).skeleton()


class _Reader:
    """Reads one domain.

    Args:
        form: the whole of it.
    """

    def __init__(self, form: Form) -> None:
        self._form = form
        self._types = self._read_types()

    def skeleton(self) -> DomainSkeleton:
        """The domain."""
        skeleton = DomainSkeleton(
            self._read_name(),
            self._types,
            tuple(t for f in self._sections(":constants") for t in self._typed(f, f.items[1:])),
            self._schemas((p, p.items) for f in self._sections(":predicates") for p in f.forms),
            self._schemas((a, self._signature(a)) for a in self._sections(":action")),
            frozenset(w for f in self._sections(":requirements") for w in f.words),
            tuple(str(item) for f in self._sections(":functions") for item in f.items[1:]),
        )
        if not skeleton.actions:
            raise FileError(f"{self._form.where}: expected at least one '(:action NAME ...)'")
        return skeleton

    def _sections(self, head: str) -> list[Form]:
        return [form for form in self._form.forms if form.head == head]

    def _read_name(self) -> str:
        for form in self._sections("domain"):
            if len(form.words) == 2:
                return form.words[1]
        raise FileError(f"{self._form.where}: expected '(domain NAME)'")

    def _read_types(self) -> TypeHierarchy:
        parents: dict[str, tuple[str, ...]] = {}
        for form in self._sections(":types"):
            for name, above in read_pairs(form, form.items[1:]):
                parents[name] = tuple(a for a in above if a != ROOT)
        parents.pop(ROOT, None)
        for above in tuple(parents.values()):
            parents.update({a: () for a in above if a not in parents})
        try:
            return TypeHierarchy(parents)
        except ConfigurationError as error:
            raise ConfigurationError(f"{self._form.where}: {error}") from error

    def _typed(self, form: Form, items: _Items) -> Iterator[TypedName]:
        for name, types in read_pairs(form, items):
            for type_name in types:
                if type_name != ROOT and type_name not in self._types.parents:
                    known = (ROOT, *self._types.names)
                    raise UnknownNameError("type", type_name, known, form.where)
            yield TypedName(name, types)

    def _schemas(self, found: Iterable[tuple[Form, _Items]]) -> dict[str, Schema]:
        schemas: dict[str, Schema] = {}
        for form, items in found:
            if not items or not isinstance(items[0], str):
                raise FileError(f"{form.where}: expected a name first")
            parameters = tuple(self._typed(form, items[1:]))
            names = [p.name for p in parameters]
            if len(set(names)) < len(names):
                raise FileError(f"{form.where}: two parameters of '{items[0]}' have the same name")
            if items[0] in schemas:
                raise FileError(f"{form.where}: '{items[0]}' is declared twice")
            schemas[items[0]] = Schema(items[0], parameters)
        return schemas

    def _signature(self, form: Form) -> _Items:
        """An action's name and its parameters with their types."""
        items = form.items[1:]
        if not items or not isinstance(items[0], str):
            raise FileError(f"{form.where}: expected a name after ':action'")
        for key, value in itertools.pairwise(items):
            if key == ":parameters" and isinstance(value, Form):
                return [items[0], *value.items]
        return items[:1]


def read_pairs(form: Form, items: Sequence[str | Form]) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Names with their types, of a list such as ``?a ?b - block ?c``."""
    waiting: list[str] = []
    rest = iter(items)
    for item in rest:
        if isinstance(item, Form):
            raise FileError(f"{item.where}: expected a name, got a list")
        if item != "-":
            waiting.append(item)
            continue
        kind = next(rest, None)
        if kind is None or not waiting:
            raise FileError(f"{form.where}: expected names before '-' and a type after it")
        types = (kind,) if isinstance(kind, str) else _alternatives(kind)
        yield from ((name, types) for name in waiting)
        waiting = []
    yield from ((name, (ROOT,)) for name in waiting)


def _alternatives(form: Form) -> tuple[str, ...]:
    words = form.words
    if len(words) < 2 or words[0] != "either":
        raise FileError(f"{form.where}: expected a type or '(either TYPE ...)'")
    return tuple(words[1:])
