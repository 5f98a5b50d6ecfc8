"""Labels of all states are read once, whoever asks."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.expert import expert_atoms, expert_model
from skillwrapper.domains.burger.states import BurgerState
from skillwrapper.domains.discovery import find_domain
from skillwrapper.evaluation.exact.exact_reader import ExactReader
from skillwrapper.evaluation.exact.labelled_states import LabelledStates, SceneStates
from skillwrapper.evaluation.exact.state_readers import AtomReader, PictureReader
from skillwrapper.grounding import AtomSpace


class FewStates(BurgerEnvironment):
    """A kitchen whose robot does nothing but pick."""

    def reachable_states(self, start: BurgerState | None = None) -> tuple[BurgerState, ...]:
        places = ("hand", "table", "table", "table")
        return (BurgerState(), *(BurgerState(tuple(np.roll(places, n))) for n in range(4)))

    def successor(self, state: BurgerState, instance: object) -> tuple[bool, BurgerState]:
        return False, state


def labelled(folder: Path | None = None) -> LabelledStates:
    reader = ExactReader.of(find_domain("burger"))
    assert reader is not None
    return LabelledStates(SceneStates(FewStates()), PictureReader(reader), folder)


def test_read_rightly_and_only_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    model = expert_model()
    atoms = AtomSpace(model.predicates, model.domain.objects)
    truth = labelled(tmp_path)
    labels = truth.labels(atoms)
    expected = AtomReader(expert_atoms).read(atoms, truth.states.situations)
    assert (labels == expected).all()
    assert len(list(tmp_path.glob("*.npy"))) == len(model.predicates)

    def refuse(self: object, space: object, observations: object) -> None:
        pytest.fail("read again")

    monkeypatch.setattr("skillwrapper.evaluation.exact.exact_reader.ExactReader.labels", refuse)
    some = AtomSpace(model.predicates[2:4], model.domain.objects)
    columns = [atoms.column[atom] for atom in some.atoms]
    assert (truth.labels(some) == expected[:, columns]).all()
    assert (labelled(tmp_path).labels(atoms) == expected).all()


def test_no_predicates() -> None:
    truth = labelled()
    assert truth.labels(AtomSpace((), truth.states.scene.objects)).shape == (5, 0)
