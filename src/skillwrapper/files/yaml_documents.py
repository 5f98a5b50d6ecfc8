"""Reading YAML files so that every complaint names the file and the line."""

from __future__ import annotations

import difflib
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import yaml
from pydantic import BaseModel, ValidationError

from skillwrapper.errors import ConfigurationError

Model = TypeVar("Model", bound=BaseModel)


@dataclass(frozen=True)
class YamlDocument:
    """A parsed YAML file that still knows where everything stood.

    Attributes:
        path: the file.
        data: plain Python data.
        root: YAML's own nodes, with line numbers.
    """

    path: Path
    data: Any
    root: yaml.Node | None

    @classmethod
    def read(cls, path: Path) -> YamlDocument:
        """Parse a file.

        Raises:
            ConfigurationError: if it is missing or no YAML; names file and line.
        """
        try:
            text = path.read_text(encoding="utf-8")
            return cls(path, yaml.safe_load(text), yaml.compose(text, Loader=yaml.SafeLoader))
        except OSError as error:
            raise ConfigurationError(f"{path}: cannot be read ({error.strerror})") from error
        except UnicodeDecodeError as error:
            raise ConfigurationError(f"{path}: expected UTF-8 text") from error
        except yaml.YAMLError as error:
            mark = getattr(error, "problem_mark", None)
            line = f":{mark.line + 1}" if mark else ""
            problem = getattr(error, "problem", None) or "not valid YAML"
            raise ConfigurationError(f"{path}{line}: expected valid YAML ({problem})") from error

    def place(self, location: tuple[str | int, ...]) -> str:
        """``file:line`` of a location such as ``("skills", "Pick")``, or of what encloses it."""
        node, line = self.root, self.root.start_mark.line if self.root else 0
        for key in location:
            found = _child(node, key)
            if found is None:
                break
            node, line = found
        return f"{self.path}:{line + 1}"

    def validate(self, model: type[Model]) -> Model:
        """The data as a pydantic model.

        Raises:
            ConfigurationError: for the first mistake, with file, line, expected and got.
        """
        try:
            return model.model_validate(self.data)
        except ValidationError as error:
            raise ConfigurationError(self._describe(error, model)) from error

    def _describe(self, error: ValidationError, model: type[BaseModel]) -> str:
        # A misspelt key is an unknown one and a missing one: the unknown one says more.
        mistakes = error.errors()
        unknown = (mistake for mistake in mistakes if mistake["type"] == "extra_forbidden")
        first = next(unknown, mistakes[0])
        location = first["loc"]
        name = ".".join(str(part) for part in location) or "the file"
        if first["type"] == "extra_forbidden":
            near = _nearest_field(model, location)
            return f"{self.place(location)}: unknown key '{name}'{near}"
        if first["type"] == "missing":
            return f"{self.place(location)}: expected a value for '{name}', got none"
        got = repr(first.get("input"))
        got = got if len(got) < 60 else got[:57] + "..."
        return f"{self.place(location)}: '{name}': {first['msg']}, got {got}"


def _child(node: yaml.Node | None, key: str | int) -> tuple[yaml.Node, int] | None:
    if isinstance(node, yaml.MappingNode):
        for key_node, value_node in node.value:
            if key_node.value == str(key):
                return value_node, key_node.start_mark.line
    if isinstance(node, yaml.SequenceNode) and isinstance(key, int) and key < len(node.value):
        return node.value[key], node.value[key].start_mark.line
    return None


def _nearest_field(model: type[BaseModel], location: tuple[str | int, ...]) -> str:
    """A hint naming the valid key nearest to an unknown one."""
    fields = _fields_at(model, location[:-1])
    near = difflib.get_close_matches(str(location[-1]), fields, n=1, cutoff=0.4)
    if near:
        return f"; did you mean '{near[0]}'?"
    return f"; expected one of: {', '.join(fields)}" if fields else ""


def _fields_at(model: type[BaseModel], path: tuple[str | int, ...]) -> list[str]:
    """Names of the fields of the model nested at a path; empty if it cannot be told."""
    models = [model]
    for part in path:
        inner: list[type[BaseModel]] = []
        for candidate in models:
            if isinstance(part, str) and part in candidate.model_fields:
                inner += _models_in(candidate.model_fields[part].annotation)
        models = inner or models
    return sorted({name for candidate in models for name in candidate.model_fields})


def _models_in(annotation: Any) -> list[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    arguments = getattr(annotation, "__args__", ())
    return [model for argument in arguments for model in _models_in(argument)]
