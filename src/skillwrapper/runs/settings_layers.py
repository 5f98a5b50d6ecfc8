"""Settings from several places, one over the other, with the place of every mistake."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Generic, TypeVar, get_args, get_origin

from pydantic import BaseModel, ValidationError

from skillwrapper.errors import ConfigurationError, UnknownNameError
from skillwrapper.files.mistakes import Location, first_mistake
from skillwrapper.files.yaml_documents import YamlDocument, parse_value
from skillwrapper.runs.settings_tree import Setting, list_settings

Model = TypeVar("Model", bound=BaseModel)


class SettingsLayers(Generic[Model]):
    """Values from several places, later ones over earlier ones.

    Args:
        model: the tree.
    """

    def __init__(self, model: type[Model]) -> None:
        self._model = model
        self._known = {s.name: s for s in list_settings(model)}
        self._values: dict[str, Any] = {}
        self._origins: dict[Location, str] = {}
        self._document: YamlDocument | None = None

    def add_file(self, document: YamlDocument) -> None:
        """Take the values of a YAML file, which may leave settings out.

        Raises:
            ConfigurationError: if it holds no keys and values.
        """
        if document.data is None:
            return
        if not isinstance(document.data, dict):
            raise ConfigurationError(
                f"{document.place(())}: expected settings with their values, e.g. 'seed: 3'"
            )
        self._document = document
        self._values = dict(document.data)

    def add(self, name: str, value: Any, origin: str) -> None:
        """Take one value.

        Args:
            name: of a setting; under a setting of keys and values also one of its keys.
            value: plain data.
            origin: where it comes from, for messages, e.g. ``--seed``.

        Raises:
            UnknownNameError: if there is no such setting.
        """
        self._check(name, origin)
        *path, last = name.split(".")
        place = self._values
        for key in path:
            inner = place.get(key)
            place[key] = dict(inner) if isinstance(inner, dict) else {}
            place = place[key]
        place[last] = value
        self._origins[(*path, last)] = origin

    def add_any(self, name: str, value: Any) -> None:
        """Take a value, or under the name of a whole part of the tree a mapping of values.

        Raises:
            UnknownNameError: if there is no such setting.
        """
        if name not in self._known and isinstance(value, Mapping):
            for key, inner in value.items():
                self.add_any(f"{name}.{key}", inner)
        else:
            self.add(name, value, name)

    def assign(self, text: str, origin: str = "--set") -> None:
        """Take a value written as ``learning.attempts=5``; values are written as in YAML.

        Raises:
            ConfigurationError: if it has another form.
            UnknownNameError: if there is no such setting.
        """
        name, equals, value = text.partition("=")
        name = name.strip()
        if not equals or not name:
            raise ConfigurationError(
                f"{origin}: expected NAME=VALUE, e.g. learning.attempts=5, got '{text}'"
            )
        self._check(name, origin)
        self.add(name, self._parse(name, value.strip(), origin), f"{origin} {name}")

    def build(self) -> Model:
        """The settings.

        Raises:
            ConfigurationError: for the first mistake, with its place, expected and got.
        """
        try:
            return self._model.model_validate(self._values)
        except ValidationError as error:
            mistake = first_mistake(error, self._model)
            where = self._origin(mistake.location)
            raise ConfigurationError(f"{where}{mistake.text}") from error

    def _check(self, name: str, origin: str) -> None:
        if name not in self._known and self._mapping_of(name) is None:
            raise UnknownNameError("setting", name, self._known, origin)

    def _parse(self, name: str, value: str, origin: str) -> Any:
        known = self._known.get(name) or self._mapping_of(name)
        if known is not None and _is_text(known.annotation) and value not in ("null", "~"):
            return value
        return parse_value(value, f"{origin} {name}")

    def _mapping_of(self, name: str) -> Setting | None:
        """The setting of keys and values that a name is a key of."""
        known = self._known.get(name.rpartition(".")[0])
        return known if known is not None and get_origin(known.annotation) is dict else None

    def _origin(self, location: Location) -> str:
        for length in range(len(location), 0, -1):
            if location[:length] in self._origins:
                return f"{self._origins[location[:length]]}: "
        return f"{self._document.place(location)}: " if self._document else ""


def _is_text(annotation: Any) -> bool:
    """Whether values are text, whatever they look like."""
    if get_origin(annotation) is dict:
        return get_args(annotation)[1] is str
    parts = {_bare(part) for part in get_args(annotation) or (annotation,)}
    return parts <= {str, Path, type(None)}


def _bare(annotation: Any) -> Any:
    return get_args(annotation)[0] if get_origin(annotation) is Annotated else annotation
