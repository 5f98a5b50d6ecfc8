"""Reading the folder of a run: every file as typed records, every damage as one sentence."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from skillwrapper.errors import FileError, RunFolderError, UserError
from skillwrapper.files.json_documents import read_json, read_records, read_text
from skillwrapper.files.writing import append_line, write_json
from skillwrapper.files.yaml_documents import YamlDocument
from skillwrapper.runs.archive.labels import RecordedLabels
from skillwrapper.runs.archive.layout import RunLayout
from skillwrapper.runs.archive.pictures import PictureStore
from skillwrapper.runs.archive.records import (
    FORMAT,
    CertificateRecord,
    CorrectionRecord,
    CurveFile,
    CurvePointRecord,
    DecisionRecord,
    DecisionsFile,
    DecodingRecord,
    EpisodeRecord,
    EventRecord,
    ExecutionRecord,
    InconsistencyRecord,
    SceneRecord,
    SummaryRecord,
    UnresolvedFile,
    to_plain,
)
from skillwrapper.runs.episodes import EpisodeSoFar
from skillwrapper.runs.provenance import Provenance
from skillwrapper.runs.settings import RunSettings
from skillwrapper.symbols import AbstractModel, Operator, Predicate
from skillwrapper.symbols.files import read_model
from skillwrapper.symbols.operators import Condition
from skillwrapper.vlm.store import CallStore
from skillwrapper.world.domain import Domain, load_domain
from skillwrapper.world.episode import Episode, Transition
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance


@dataclass(frozen=True)
class ArchivedIteration:
    """A finished iteration; every file is read when it is asked for.

    Attributes:
        number: from 1.
        folder: where its files are.
        domain: of the run.
    """

    number: int
    folder: Path
    domain: Domain

    @cached_property
    def model(self) -> AbstractModel:
        """What was learned by its end."""
        return read_model(self.folder / "model.json", self.domain)

    @cached_property
    def summary(self) -> SummaryRecord:
        """Figures at its end."""
        return read_json(self.folder / "summary.json", SummaryRecord)

    @property
    def episodes(self) -> int:
        """How many episodes there are up to its end: one an iteration where nothing is said."""
        return self.number if self.summary.episodes is None else self.summary.episodes

    @cached_property
    def certificate(self) -> CertificateRecord:
        """Lemma 1 and Theorem 1 on the recorded data."""
        return read_json(self.folder / "certificate.json", CertificateRecord)

    @cached_property
    def unresolved(self) -> tuple[InconsistencyRecord, ...]:
        """The inconsistencies that were left."""
        return read_json(self.folder / "unresolved.json", UnresolvedFile).root

    @cached_property
    def decisions(self) -> tuple[DecisionRecord, ...]:
        """What was decided of predicates, in order."""
        return read_json(self.folder / "decisions.json", DecisionsFile).root

    @cached_property
    def decoding(self) -> DecodingRecord | None:
        """Which readings were overruled; None if labels were taken as they were read."""
        path = self.folder / "decoding.json"
        return read_json(path, DecodingRecord) if path.exists() else None

    @cached_property
    def labels(self) -> RecordedLabels:
        """The labels of all pictures, over the vocabulary at its end."""
        return RecordedLabels.read(self.folder / "truth_table.csv")

    def agreement(self, predicate: Predicate) -> float | None:
        """The share of votes for the label, on average over all labels read of a predicate.

        None if labels were not voted on.
        """
        return self.summary.agreement.get(predicate.name)

    def open_conditions(self, operator: Operator) -> list[tuple[str, float]]:
        """What nothing recorded decides of an operator, with how likely it is needed."""
        chances = self.summary.needed.get(operator.name, {})
        open_ones = sorted(map(str, self.untested(operator)))
        return [(name, chances[name]) for name in open_ones if name in chances]

    def untested(self, operator: Operator) -> frozenset[Condition]:
        """The conditions of an operator of which nothing recorded shows that they matter."""
        known = set(self.summary.untested.get(operator.name, ()))
        return frozenset(c for c in operator.conditions if str(c) in known)


@dataclass(frozen=True)
class RunArchive:
    """The folder of one run.

    Attributes:
        path: where it is.
    """

    path: Path

    @classmethod
    def open(cls, path: Path) -> RunArchive:
        """The folder of an existing run.

        Raises:
            RunFolderError: if there is no run, or one of another format.
            ConfigurationError: if its ``config.yaml`` is damaged.
        """
        archive = cls(path)
        if not cls.is_one(path):
            raise RunFolderError(
                f"{path}: expected the folder of a run (with {archive.layout.config.name}); "
                "make one with: skillwrapper learn DOMAIN --out DIR"
            )
        archive._check_format()
        return archive

    @staticmethod
    def is_one(path: Path) -> bool:
        """Whether a path is the folder of a run."""
        return RunLayout(path).config.is_file()

    @property
    def layout(self) -> RunLayout:
        """Where everything stands."""
        return RunLayout(self.path)

    @property
    def pictures(self) -> PictureStore:
        """The pictures."""
        return PictureStore(self.layout.images)

    def settings(self) -> RunSettings:
        """What the run was asked to do.

        Raises:
            ConfigurationError: if the file is damaged; names the line.
        """
        return self._config().part("run").validate(RunSettings)

    def made_with(self) -> Provenance:
        """Which code made the run.

        Raises:
            ConfigurationError: if the file is damaged; names the line.
        """
        return self._config().part("made_with").validate(Provenance)

    def config_text(self) -> str:
        """The whole ``config.yaml``."""
        return read_text(self.layout.config)

    def domain(self) -> Domain:
        """The domain as it was when the run started.

        Raises:
            ConfigurationError: if the file is missing or damaged.
        """
        return self._domain

    @cached_property
    def _domain(self) -> Domain:
        return load_domain(self.layout.domain)

    def episode(self, number: int) -> EpisodeSoFar | None:
        """What is recorded of an episode, from 1; None if nothing is.

        Raises:
            FileError: if the record or a picture is damaged.
            ConfigurationError: if the domain is.
        """
        path = self.layout.episode(number)
        header = read_records(path, EpisodeRecord, last=1)
        if not header:
            return None
        domain = self.domain()
        scene = _scene(header[0].scene, domain, f"{path}:1")
        start = self.pictures.load(header[0].start)
        done = EpisodeSoFar(scene, header[0].seed, start, given=bool(header[0].given))
        for line, step in enumerate(read_records(path, ExecutionRecord, first=2), start=2):
            instance = SkillInstance(step.skill, step.arguments)
            _check_instance(instance, scene, domain, f"{path}:{line}")
            done.transitions.append(
                Transition(
                    before=self.pictures.load(step.before) if step.before else done.observation,
                    instance=instance,
                    success=step.success,
                    after=self.pictures.load(step.after),
                    changed=step.changed,
                )
            )
        return done

    def episodes(self) -> tuple[Episode, ...]:
        """The episodes of all finished iterations.

        Raises:
            FileError: if one is missing or damaged.
        """
        finished = self.iterations()
        numbers = range(1, (finished[-1].episodes if finished else 0) + 1)
        return tuple(self._finished_episode(number) for number in numbers)

    def iterations(self) -> tuple[ArchivedIteration, ...]:
        """All finished iterations, in order.

        Raises:
            ConfigurationError: if the domain is damaged.
        """
        domain = self.domain()
        numbers = range(1, self.layout.finished_iterations() + 1)
        return tuple(ArchivedIteration(n, self.layout.iteration(n), domain) for n in numbers)

    def latest(self) -> ArchivedIteration:
        """The last finished iteration.

        Raises:
            RunFolderError: if none is finished yet.
        """
        found = self.iterations()
        if not found:
            raise RunFolderError(
                f"{self.path}: no iteration is finished yet; "
                "run the same learn command again to go on"
            )
        return found[-1]

    def events(self) -> list[EventRecord]:
        """The log, in order; empty if there is none."""
        return read_records(self.layout.events, EventRecord)

    def corrections(self) -> list[CorrectionRecord]:
        """What people have corrected, in order; empty if nothing."""
        return read_records(self.layout.corrections, CorrectionRecord)

    def correct(self, correction: CorrectionRecord) -> None:
        """Add a correction; it is on the disk when this returns."""
        append_line(self.layout.corrections, to_plain(correction))

    def curve(self) -> tuple[CurvePointRecord, ...]:
        """How true the model was after each iteration; empty if nobody has measured it."""
        if not self.layout.curve.exists():
            return ()
        return read_json(self.layout.curve, CurveFile).root

    def write_curve(self, points: Sequence[CurvePointRecord]) -> None:
        """Keep how true the model was after each iteration."""
        write_json(self.layout.curve, [to_plain(point) for point in points])

    @contextmanager
    def open_calls(self) -> Iterator[CallStore | None]:
        """The recorded model calls, for reading; None if there are none.

        Raises:
            RunFolderError: if the store is damaged.
        """
        if not self.layout.calls.is_file():
            yield None
            return
        with CallStore(self.layout.calls, read_only=True) as store:
            yield store

    def _finished_episode(self, number: int) -> Episode:
        found = self.episode(number)
        if found is None:
            path = self.layout.episode(number)
            raise FileError(f"{path}: expected a recorded episode, got none")
        return found.to_episode()

    def _config(self) -> YamlDocument:
        return YamlDocument.read(self.layout.config)

    def _check_format(self) -> None:
        document = self._config()
        found = document.data.get("format") if isinstance(document.data, dict) else None
        if found == FORMAT:
            return
        if isinstance(found, int) and found > FORMAT:
            version = document.part("made_with").part("skillwrapper").data or "a newer one"
            raise RunFolderError(
                f"{self.path}: the run has format {found}, and this version of skillwrapper reads "
                f"format {FORMAT}; use the version that made it ({version})"
            )
        raise RunFolderError(
            f"{document.place(('format',))}: expected 'format: {FORMAT}', got {found!r}; the run "
            "was made by an older version, or the file is damaged"
        )


def _scene(record: SceneRecord, domain: Domain, where: str) -> Scene:
    unknown = sorted(set(record.objects) - set(domain.object_by_name))
    if unknown:
        raise FileError(f"{where}: expected objects of the domain, got '{unknown[0]}'")
    return Scene.of(record.name, record.objects, domain.objects)


def _check_instance(instance: SkillInstance, scene: Scene, domain: Domain, where: str) -> None:
    try:
        domain.check_instance(instance, scene)
    except UserError as error:
        raise FileError(f"{where}: {error}") from error
