"""Everything a report says, gathered from the folder of a run."""

from __future__ import annotations

import datetime
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import yaml

from skillwrapper.evaluation.exact.learning_curves import EXACT_CURVE
from skillwrapper.files.json_documents import read_lines
from skillwrapper.report.account import CallAccount, read_account
from skillwrapper.report.charts import LineChart
from skillwrapper.report.curves import learning_charts
from skillwrapper.report.history import Decision, RunHistory
from skillwrapper.report.labels import RecordedLabels
from skillwrapper.report.strips import EpisodeStrips, lay_out
from skillwrapper.report.views import (
    PredicateView,
    SkillView,
    ViolationView,
    view_skills,
    view_violations,
)
from skillwrapper.runs.folder import CONFIG, RunFolder
from skillwrapper.runs.learned import LearnedRun
from skillwrapper.runs.settings import RunSettings
from skillwrapper.symbols import AbstractModel
from skillwrapper.symbols.pddl import print_domain

EMBEDDED = "embedded"


@dataclass(frozen=True)
class ReportContents:
    """What a report says.

    Attributes:
        config: what the run was asked to do.
        settings: the same as it was written down, as plain data.
        made_with: versions and commit, as plain data.
        config_text: the whole ``config.yaml``.
        started: when the run began, in UTC; None if there is no log.
        finished: when its last finished iteration ended, in UTC; None if there is no log.
        history: what happened.
        summary: figures at the end.
        predicates: the vocabulary.
        set_aside: the last decision on every predicate that was in and is not any more.
        skills: the skills with their operators.
        pddl: the whole domain.
        certificate: as plain data.
        violations: what breaks it.
        unresolved: inconsistencies that are left, as plain data.
        charts: the learning curve.
        account: model calls; None if none were recorded.
        episodes: strips of episodes, the richest ones, in order of time.
        opened: number of the episode that is shown unfolded; None if there is none.
    """

    config: RunSettings
    settings: dict[str, Any]
    made_with: dict[str, Any]
    config_text: str
    started: datetime.datetime | None
    finished: datetime.datetime | None
    history: RunHistory
    summary: dict[str, Any]
    predicates: tuple[PredicateView, ...]
    set_aside: tuple[Decision, ...]
    skills: tuple[SkillView, ...]
    pddl: str
    certificate: dict[str, Any]
    violations: tuple[ViolationView, ...]
    unresolved: list[dict[str, Any]]
    charts: tuple[LineChart, ...]
    account: CallAccount | None
    episodes: tuple[EpisodeStrips, ...]
    opened: int | None

    @property
    def is_complete(self) -> bool:
        """Whether all iterations that were asked for are finished."""
        return len(self.history.iterations) >= self.config.iterations

    @property
    def period(self) -> str:
        """When the run was made, in words; empty if there is no log."""
        if self.started is None or self.finished is None:
            return ""
        day, end = _day(self.started), _day(self.finished)
        if day != end:
            return f"{day} to {end}"
        minutes = dict.fromkeys(f"{moment:%H:%M}" for moment in (self.started, self.finished))
        return f"{day}, {' to '.join(minutes)} UTC"

    @property
    def embedded_roles(self) -> tuple[str, ...]:
        """Roles that the embedded model played; ``("every role",)`` if it played all."""
        model = self.config.model
        others = {str(role) for role, name in model.roles.items() if name != EMBEDDED}
        own = {str(role) for role, name in model.roles.items() if name == EMBEDDED}
        if model.name == EMBEDDED:
            return (f"every role but {', '.join(sorted(others))}" if others else "every role",)
        return tuple(sorted(own))

    @classmethod
    def gather(cls, folder: RunFolder, most_episodes: int) -> ReportContents:
        """Read a run.

        Raises:
            RunFolderError: if no iteration is finished, or a file is damaged.
        """
        learned, history = LearnedRun.read(folder), RunHistory.read(folder)
        last = len(history.iterations)
        labels = RecordedLabels.read(folder.iteration(last) / "truth_table.csv")
        strips = [lay_out(i.number, i.episode, labels) for i in history.iterations]
        richest = sorted(strips, key=lambda s: (-s.changes, s.number))[:most_episodes]
        config_text = (folder.path / CONFIG).read_text(encoding="utf-8")
        written = yaml.safe_load(config_text)
        times = [entry["time"] for entry in read_lines(folder.events) if "time" in entry]
        return cls(
            config=folder.config(),
            settings=written.get("run") or {},
            made_with=written.get("made_with") or {},
            config_text=config_text,
            started=_moment(times[0]) if times else None,
            finished=_moment(times[-1]) if times else None,
            history=history,
            summary=learned.summary,
            predicates=tuple(
                PredicateView.of(p, history, labels) for p in learned.model.predicates
            ),
            set_aside=tuple(_set_aside(history, learned.model)),
            skills=view_skills(learned.model, history),
            pddl=print_domain(learned.model),
            certificate=learned.certificate,
            violations=tuple(view_violations(learned.certificate, history)),
            unresolved=learned.unresolved,
            charts=learning_charts(history, folder.path / EXACT_CURVE),
            account=read_account(folder),
            episodes=tuple(sorted(richest, key=lambda s: s.number)),
            opened=richest[0].number if richest else None,
        )


def _set_aside(history: RunHistory, model: AbstractModel) -> Iterator[Decision]:
    """The last decision on predicates that were taken in and are no longer active."""
    active = set(model.predicate_by_name)
    last = {d.name: d for d in history.decisions() if d.verdict in ("dormant", "retracted")}
    return (decision for name, decision in last.items() if name not in active)


def _day(moment: datetime.datetime) -> str:
    return f"{moment.day} {moment:%B %Y}"


def _moment(seconds: float) -> datetime.datetime:
    return datetime.datetime.fromtimestamp(seconds, tz=datetime.UTC)
