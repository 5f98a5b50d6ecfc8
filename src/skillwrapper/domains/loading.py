"""Code that a ``domain.yaml`` names: ``file.py:name`` beside it, or ``package.module:name``.

A file is loaded as a module of a package that exists for its folder alone, so that domains with
files of the same names do not meet. While it is loaded, it may import the files beside it by their
names alone, as a script would; nothing of this is left afterwards, except in these modules.
"""

from __future__ import annotations

import hashlib
import importlib
import importlib.abc
import importlib.util
import sys
import threading
import traceback
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from importlib.machinery import ModuleSpec
from pathlib import Path
from types import ModuleType
from typing import Any

from skillwrapper.errors import ConfigurationError, SkillWrapperError, UnknownNameError

_LOADING = threading.RLock()


def load_object(reference: str, folder: Path, where: str) -> Any:
    """What a reference names.

    Args:
        reference: ``file.py:name``, relative to the folder, or ``package.module:name``.
        folder: of the domain.
        where: ``file:line`` of the reference.

    Raises:
        ConfigurationError: if there is no such file or module, or it cannot be loaded.
        UnknownNameError: if it does not define the name.
    """
    source, colon, name = reference.rpartition(":")
    if not (colon and source and name):
        raise ConfigurationError(
            f"{where}: expected 'file.py:name' or 'package.module:name', got '{reference}'"
        )
    with _LOADING, blamed(folder, f"{where}: {reference}"):
        is_file = source.endswith(".py")
        module = _load_file(folder, source, where) if is_file else _load_module(source, where)
    if not hasattr(module, name):
        known = [n for n in vars(module) if not n.startswith("_")]
        raise UnknownNameError(f"name in {source}", name, known, where)
    return getattr(module, name)


@contextmanager
def blamed(folder: Path, otherwise: str) -> Iterator[None]:
    """Turn an error of a domain's own code into one that names its file and line.

    Args:
        folder: of the domain.
        otherwise: the place to name if the error did not pass through a file of the folder.

    Raises:
        ConfigurationError: instead of any error that the package does not raise on purpose.
    """
    try:
        yield
    except SkillWrapperError:
        raise
    except (Exception, SystemExit) as error:
        place = _place(error, folder) or otherwise
        message = error.msg if isinstance(error, SyntaxError) else error
        raise ConfigurationError(f"{place}: {type(error).__name__}: {message}") from error


def _place(error: BaseException, folder: Path) -> str | None:
    """The last line of the folder's files that an error passed through."""
    if isinstance(error, SyntaxError) and error.filename and Path(error.filename).is_file():
        return f"{error.filename}:{error.lineno}"
    for frame in reversed(traceback.extract_tb(error.__traceback__)):
        if Path(frame.filename).is_relative_to(folder):
            return f"{frame.filename}:{frame.lineno}"
    return None


def _load_module(name: str, where: str) -> ModuleType:
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name is None or not f"{name}.".startswith(f"{error.name}."):
            raise
        raise ConfigurationError(
            f"{where}: no module '{name}' is installed; install it, or put its folder on PYTHONPATH"
        ) from error


def _load_file(folder: Path, source: str, where: str) -> ModuleType:
    file = folder / source
    if not file.is_file():
        raise ConfigurationError(f"{where}: expected a file {file}, got none")
    parts = Path(source).with_suffix("").parts
    if not all(part.isidentifier() for part in parts):
        raise ConfigurationError(f"{where}: expected a file of Python beside it, got '{source}'")
    package = _package_of(folder)
    with _siblings_importable(folder, package):
        return importlib.import_module(".".join((package, *parts)))


def _package_of(folder: Path) -> str:
    """The package that exists for the folder alone."""
    name = f"skillwrapper_domain_{hashlib.sha256(str(folder).encode()).hexdigest()[:16]}"
    if name not in sys.modules:
        package = ModuleType(name, f"Files of {folder}.")
        package.__path__ = [str(folder)]
        sys.modules[name] = package
    return name


@contextmanager
def _siblings_importable(folder: Path, package: str) -> Iterator[None]:
    """Let ``import reader`` mean ``reader.py`` of the folder, and forget the short names again."""
    names = {p.stem for p in folder.glob("*.py")} | {p.parent.name for p in folder.glob("*/*.py")}
    names = {n for n in names if n.isidentifier()} - sys.stdlib_module_names - {"skillwrapper"}
    hidden = {name: sys.modules.pop(name) for name in names if name in sys.modules}
    finder = _SiblingFinder(names, package)
    sys.meta_path.insert(0, finder)
    try:
        yield
    finally:
        sys.meta_path.remove(finder)
        for name in names:
            sys.modules.pop(name, None)
        sys.modules.update(hidden)


class _SiblingFinder(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Finds the files of a folder by their names alone, as modules of its package."""

    def __init__(self, names: set[str], package: str) -> None:
        self._names, self._package = names, package

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        is_sibling = path is None and fullname in self._names
        return ModuleSpec(fullname, self) if is_sibling else None

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        module = importlib.import_module(f"{self._package}.{spec.name}")
        spec.loader_state = module.__spec__
        return module

    def exec_module(self, module: ModuleType) -> None:
        """The module is loaded already; it keeps the spec of its long name."""
        alias = module.__spec__
        if alias is not None:
            module.__spec__ = alias.loader_state
