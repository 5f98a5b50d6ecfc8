"""Reading YAML files so that every complaint names the file and the line."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import yaml
from pydantic import BaseModel, ValidationError

from skillwrapper.errors import ConfigurationError
from skillwrapper.files.mistakes import Location, first_mistake

Model = TypeVar("Model", bound=BaseModel)

_MOST_BYTES = 1_000_000
_MOST_NODES = 200_000
_DEEPEST = 100
_DATES = "tag:yaml.org,2002:timestamp"


@dataclass(frozen=True)
class YamlDocument:
    """A parsed YAML file that still knows where everything stood.

    Attributes:
        path: the file.
        data: plain Python data; dates stay text.
        root: YAML's own nodes, with line numbers.
    """

    path: Path
    data: Any
    root: yaml.Node | None

    @classmethod
    def read(cls, path: Path) -> YamlDocument:
        """Parse a file.

        Raises:
            ConfigurationError: if it is missing, too large, no YAML, or names a key twice; with
                file and line.
        """
        try:
            with path.open("rb") as file:
                content = file.read(_MOST_BYTES + 1)
            if len(content) > _MOST_BYTES:
                raise ConfigurationError(f"{path}: expected at most {_MOST_BYTES} bytes, got more")
            data, root = _load(_text(content, path))
            return cls(path, data, root)
        except OSError as error:
            raise ConfigurationError(f"{path}: cannot be read ({error.strerror})") from error
        except RecursionError as error:
            raise ConfigurationError(f"{path}: expected fewer levels of nesting") from error
        except yaml.YAMLError as error:
            raise ConfigurationError(f"{path}{_line(error)}: {_problem(error)}") from error

    def place(self, location: Location) -> str:
        """``file:line`` of a location such as ``("skills", "Pick")``, or of what encloses it."""
        node, line = self.root, self.root.start_mark.line if self.root else 0
        for key in location:
            found = _child(node, key)
            if found is None:
                break
            node, line = found
        return f"{self.path}:{line + 1}"

    def part(self, key: str) -> YamlDocument:
        """What stands under a key of the document; None as data if there is nothing."""
        data = self.data.get(key) if isinstance(self.data, dict) else None
        found = _child(self.root, key)
        return YamlDocument(self.path, data, found[0] if found else None)

    def validate(self, model: type[Model]) -> Model:
        """The data as a pydantic model.

        Raises:
            ConfigurationError: for the first mistake, with file, line, expected and got.
        """
        try:
            return model.model_validate(self.data)
        except ValidationError as error:
            mistake = first_mistake(error, model)
            raise ConfigurationError(f"{self.place(mistake.location)}: {mistake.text}") from error


def parse_value(text: str, where: str) -> Any:
    """A single value as it would stand in a YAML file.

    Raises:
        ConfigurationError: if it is no YAML.
    """
    try:
        return yaml.load(text, Loader=_Loader)
    except (yaml.YAMLError, RecursionError, ValueError) as error:
        raise ConfigurationError(f"{where}: expected a value as in YAML, got '{text}'") from error


def _text(content: bytes, path: Path) -> str:
    """The text of a file.

    Raises:
        ConfigurationError: for what no text in UTF-8 holds, with its line.
    """
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise ConfigurationError(f"{path}:{line}: expected UTF-8 text") from error
    if found := yaml.reader.Reader.NON_PRINTABLE.search(text):
        line = text.count("\n", 0, found.start()) + 1
        raise ConfigurationError(f"{path}:{line}: expected valid YAML (got {found[0]!r})")
    return text


def _load(text: str) -> tuple[Any, yaml.Node | None]:
    """The data of a text, and its nodes.

    Raises:
        yaml.YAMLError: if it is no YAML, or something in it holds itself.
    """
    try:
        return _load_with(_FastLoader(text))
    except yaml.YAMLError:
        # What C refuses is read again: complaints are the same wherever libyaml is missing or old.
        return _load_with(_Loader(text))


def _load_with(loader: _Loader | _FastLoader) -> tuple[Any, yaml.Node | None]:
    try:
        root = loader.get_single_node()
        if root is None:
            return None, None
        _count_nodes(root, {}, set())
        return loader.construct_document(root), root
    finally:
        loader.dispose()


def _count_nodes(node: yaml.Node, known: dict[int, int], enclosing: set[int]) -> int:
    """How many nodes there are with all aliases written out; refuses too many, and circles."""
    if id(node) in known:
        return known[id(node)]
    if id(node) in enclosing:
        raise _mistake("expected nothing that holds itself", node)
    inner = node.value if isinstance(node, yaml.CollectionNode) else []
    parts = [part for pair in inner for part in (pair if isinstance(pair, tuple) else (pair,))]
    enclosing.add(id(node))
    total = 1 + sum(_count_nodes(part, known, enclosing) for part in parts)
    enclosing.discard(id(node))
    if total > _MOST_NODES:
        raise _mistake(f"expected at most {_MOST_NODES} values with all aliases written out", node)
    known[id(node)] = total
    return total


def _mistake(problem: str, node: yaml.Node) -> yaml.YAMLError:
    return yaml.constructor.ConstructorError(None, None, problem, node.start_mark)


def compose(text: str) -> yaml.Node | None:
    """The nodes of a YAML text, with their lines; JSON is YAML too."""
    root: yaml.Node | None = yaml.compose(text, Loader=_Loader)
    return root


class _PlainLoader(
    yaml.composer.Composer, yaml.constructor.SafeConstructor, yaml.resolver.Resolver
):
    """Loads plain data only; refuses keys that are given twice, and keeps dates as text."""

    _depth = 0

    def compose_node(self, parent: yaml.Node | None, index: Any) -> yaml.Node | None:
        """The next node; refused where it stands too deep, long before Python gives up."""
        self._depth += 1
        if self._depth > _DEEPEST:
            mark = self.peek_event().start_mark  # type: ignore[attr-defined]
            problem = f"expected at most {_DEEPEST} levels of nesting"
            raise yaml.composer.ComposerError(None, None, problem, mark)
        node: yaml.Node | None = super().compose_node(parent, index)
        self._depth -= 1
        return node

    def construct_object(self, node: yaml.Node, deep: bool = False) -> Any:
        """The value of a node."""
        try:
            value = super().construct_object(node, deep)
        except ValueError as error:
            kind = node.tag.rpartition(":")[2]
            raise _mistake(f"expected a value of the kind {kind}", node) from error
        if isinstance(value, str) and _has_surrogate(value):
            raise _mistake("expected text, got half a character", node)
        return value

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Hashable, Any]:
        """The keys and values of a node."""
        seen: set[object] = set()
        for key_node, _ in node.value:
            if key_node.tag == "tag:yaml.org,2002:merge":
                continue
            key = self.construct_object(key_node, deep=True)
            if not isinstance(key, Hashable):
                raise _mistake("expected text as a key", key_node)
            if key in seen:
                raise _mistake(f"the key '{key}' is given twice", key_node)
            seen.add(key)
        return super().construct_mapping(node, deep)


_PlainLoader.yaml_implicit_resolvers = {
    first: [(tag, pattern) for tag, pattern in resolvers if tag != _DATES]
    for first, resolvers in yaml.SafeLoader.yaml_implicit_resolvers.items()
}


class _Loader(_PlainLoader, yaml.SafeLoader):
    """Reads in Python."""


class _FastLoader(_PlainLoader, getattr(yaml, "CSafeLoader", yaml.SafeLoader)):  # type: ignore[misc]
    """Scans and parses in C where PyYAML was built with libyaml: six times as fast."""

    def __init__(self, text: str) -> None:
        getattr(yaml, "CSafeLoader", yaml.SafeLoader).__init__(self, text)
        yaml.composer.Composer.__init__(self)  # of which the parser in C knows nothing


def _has_surrogate(text: str) -> bool:
    return any("\ud800" <= character <= "\udfff" for character in text)


def _line(error: yaml.YAMLError) -> str:
    mark = getattr(error, "problem_mark", None)
    return f":{mark.line + 1}" if mark else ""


def _problem(error: yaml.YAMLError) -> str:
    problem = getattr(error, "problem", None) or "not valid YAML"
    return f"expected valid YAML ({problem})"


def _child(node: yaml.Node | None, key: str | int) -> tuple[yaml.Node, int] | None:
    if isinstance(node, yaml.MappingNode):
        for key_node, value_node in node.value:
            if key_node.value == str(key):
                return value_node, key_node.start_mark.line
    if isinstance(node, yaml.SequenceNode) and isinstance(key, int) and key < len(node.value):
        return node.value[key], node.value[key].start_mark.line
    return None
