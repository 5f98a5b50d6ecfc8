"""Reducing the meshes of a model, so that pictures take little time without a graphics card."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from skillwrapper.domains.tabletop.extra import mesh_reduction, mujoco
from skillwrapper.domains.tabletop.poses import rotation_of

_FEWEST_FACES: Final = 200
"""Meshes of no more faces stay as they are."""
_STL = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def reduce_meshes(source: Path, folder: Path, kept: float) -> None:
    """Write a copy of a model with fewer faces.

    Args:
        source: the file of the model.
        folder: where ``model.xml`` and its meshes are written.
        kept: share of the faces that is kept.

    Raises:
        MissingDependencyError: if MuJoCo or mesh reduction is missing.
        OSError: if a file cannot be read or written.
    """
    spec = mujoco().MjSpec.from_file(str(source))
    model = spec.compile()
    folder.mkdir(parents=True)
    for mesh in spec.meshes:
        vertices, faces = _mesh_of(model, model.mesh(mesh.name).id)
        if len(faces) > _FEWEST_FACES:
            vertices, faces = _reduced(vertices, faces, max(kept, _FEWEST_FACES / len(faces)))
        file = f"{mesh.name}.stl"
        _write_stl(folder / file, vertices, faces)
        mesh.file, mesh.scale = file, [1, 1, 1]
        mesh.inertia = mujoco().mjtMeshInertia.mjMESH_INERTIA_CONVEX
    spec.meshdir = str(folder)
    # Writing compiles, so it wants the folder; whoever reads looks beside the file.
    xml = spec.to_xml().replace(f'meshdir="{folder}"', 'meshdir="."')
    (folder / "model.xml").write_text(xml, encoding="utf-8")


def _mesh_of(model: Any, number: int) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Vertices and faces as they were before the compiler centred them; each vertex once."""
    first, count = model.mesh_vertadr[number], model.mesh_vertnum[number]
    vertices = model.mesh_vert[first : first + count].astype(float)
    first, count = model.mesh_faceadr[number], model.mesh_facenum[number]
    faces = model.mesh_face[first : first + count]
    vertices = vertices @ rotation_of(model.mesh_quat[number]).T + model.mesh_pos[number]
    unique, place = np.unique(vertices.round(5), axis=0, return_inverse=True)
    return unique, place.ravel()[faces]


def _reduced(
    vertices: NDArray[np.float64], faces: NDArray[np.int64], kept: float
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    reduced, corners = mesh_reduction().simplify(
        vertices.astype(np.float32), faces.astype(np.int32), target_reduction=1 - kept, agg=7
    )
    return np.asarray(reduced, float), np.asarray(corners, np.int64)


def _write_stl(file: Path, vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> None:
    triangles = np.zeros(len(faces), dtype=_STL)
    triangles["corners"] = vertices[faces]
    file.write_bytes(b"\0" * 80 + len(faces).to_bytes(4, "little") + triangles.tobytes())
