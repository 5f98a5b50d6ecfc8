"""Checking the model of a run in every state of its domain's scenes."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from enum import StrEnum

from skillwrapper.domains.discovery import find_domain
from skillwrapper.domains.package import DomainPackage
from skillwrapper.errors import ConfigurationError
from skillwrapper.evaluation.exact.exact_reader import ExactReader
from skillwrapper.evaluation.exact.exact_states import scene_states
from skillwrapper.evaluation.exact.labelled_states import (
    TRUTH_LAYOUT,
    LabelledStates,
    SceneStates,
)
from skillwrapper.evaluation.exact.learning_curves import (
    CurvePoint,
    learning_curve,
    read_stages,
    write_curve,
)
from skillwrapper.evaluation.exact.state_readers import PictureReader, StateReader, system_reader
from skillwrapper.evaluation.exact.verification import Verification, verify
from skillwrapper.grounding import UNKNOWN, AtomSpace
from skillwrapper.perception.truth_table import TruthTable
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.model_sessions import open_session
from skillwrapper.runs.models import EMBEDDED, open_model
from skillwrapper.runs.settings import RunSettings
from skillwrapper.symbols import AbstractModel
from skillwrapper.vlm.limits import CallBudget, CallLimits, LimitedModel
from skillwrapper.vlm.protocol import VisionLanguageModel
from skillwrapper.world.capabilities import Enumerable, Truthful, require, supports


class LabelSource(StrEnum):
    """Who labels the states (docs/semantics.md, D25)."""

    TRUE = "true"
    """Read without error: the learned model is judged, not the eyes."""
    MODEL = "model"
    """Read by the run's own model: both are judged."""


@dataclass(frozen=True)
class RunCheck:
    """What came of checking a run.

    Attributes:
        labels: who labelled the states.
        verification: of its final model.
        not_understood: predicates that got no label in any state, by their names.
        curve: of the model after every iteration; empty if it was not asked for.
    """

    labels: LabelSource
    verification: Verification
    not_understood: tuple[str, ...] = ()
    curve: tuple[CurvePoint, ...] = ()

    def to_json(self) -> dict[str, object]:
        """Plain data: the verification, and the curve if there is one."""
        curve = {"curve": [vars(point) for point in self.curve]} if self.curve else {}
        return {
            "labels": str(self.labels),
            **self.verification.to_json(),
            "not_understood": list(self.not_understood),
            **curve,
        }


@dataclass(frozen=True)
class CheckOptions:
    """How a run is checked.

    Attributes:
        labels: who labels the states; None for who can: without error where possible.
        scenes: names of scenes; none for all of the domain.
        layout: seed of the layout of the pictures.
        max_calls: of the run's model, at most; None for as many as the run's settings allow.
        curve: also check the model of every iteration, and keep the curve in the run's folder.
    """

    labels: LabelSource | None = None
    scenes: tuple[str, ...] = ()
    layout: int = TRUTH_LAYOUT
    max_calls: int | None = None
    curve: bool = False


def check_run(archive: RunArchive, options: CheckOptions) -> RunCheck:
    """Check the model of a run.

    Raises:
        ConfigurationError: if the states of the domain cannot be listed, or nobody labels them as
            is asked for.
        UnknownNameError: if there is no such scene.
        ProviderError: if the model does not answer, or calls run out.
    """
    started = time.monotonic()
    settings, model = archive.settings(), archive.latest().model
    package = find_domain(settings.domain)
    states = scene_states(package, options.scenes, options.layout)
    if not states:
        require(package.make_environment(), Enumerable, "exact verification")
    true_readers = _true_readers(package, model, states)
    labels = options.labels or (LabelSource.TRUE if true_readers else LabelSource.MODEL)
    with _labelled(archive, settings, options.max_calls, states, labels, true_readers) as scenes:
        found = verify(scenes, model)
        points: tuple[CurvePoint, ...] = ()
        if options.curve:
            points = learning_curve(read_stages(archive), scenes)
            write_curve(archive, points)
        blank = _without_labels(model, scenes)
    found = replace(found, seconds=time.monotonic() - started)
    return RunCheck(labels, found, blank, points)


def _true_readers(
    package: DomainPackage, model: AbstractModel, states: Sequence[SceneStates]
) -> tuple[StateReader, ...]:
    """For every scene who reads the model's predicates without error; none if nobody does."""
    reader = ExactReader.of(package)
    if reader is not None:
        return tuple(PictureReader(reader) for _ in states)
    known = package.system_predicates if package.has("system_predicates") else ()
    named = {(p.name, p.types) for p in known}
    told = all((p.name, p.types) in named for p in model.predicates)
    if told and all(supports(s.environment, Truthful) for s in states):
        return tuple(system_reader(require(s.environment, Truthful, "true labels")) for s in states)
    return ()


@contextmanager
def _labelled(
    archive: RunArchive,
    settings: RunSettings,
    max_calls: int | None,
    states: Sequence[SceneStates],
    labels: LabelSource,
    true_readers: Sequence[StateReader],
) -> Iterator[tuple[LabelledStates, ...]]:
    """The states with their labels."""
    if labels is LabelSource.TRUE:
        if not true_readers:
            raise ConfigurationError(
                f"{settings.domain}: --labels true needs a 'scene_reader' in its domain.yaml, or "
                "predicates of which the environment tells the truth; use --labels model"
            )
        pairs = zip(states, true_readers, strict=True)
        yield tuple(LabelledStates(s, reader) for s, reader in pairs)
        return
    if max_calls is not None:
        calls = settings.calls.model_copy(update={"max_calls": max_calls})
        settings = settings.model_copy(update={"calls": calls})
    model = _limited_stand_in(settings, max_calls)
    store = archive.layout.calls
    with open_session(settings, store, model=model, learning=False) as session:
        table = TruthTable(states[0].environment.domain, session.assistant)
        yield tuple(LabelledStates(s, PictureReader(table)) for s in states)


def _limited_stand_in(settings: RunSettings, max_calls: int | None) -> VisionLanguageModel | None:
    """The embedded model with the limit on it that others have from their session."""
    if max_calls is None or settings.model.name != EMBEDDED or settings.model.roles:
        return None
    made = open_model(EMBEDDED, settings.model, settings.seed, settings.domain)
    return LimitedModel(made, CallBudget(CallLimits(max_calls)))


def _without_labels(model: AbstractModel, scenes: Sequence[LabelledStates]) -> tuple[str, ...]:
    blank = []
    for predicate in model.predicates:
        labels = [s.labels(AtomSpace((predicate,), s.states.scene.objects)) for s in scenes]
        if all((found == UNKNOWN).all() for found in labels):
            blank.append(predicate.name)
    return tuple(blank)
