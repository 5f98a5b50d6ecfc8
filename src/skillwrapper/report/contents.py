"""Everything a report says, gathered from the folder of a run."""

from __future__ import annotations

import datetime
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from skillwrapper.report.account import CallAccount, read_account
from skillwrapper.report.beyond_readings import beyond_readings
from skillwrapper.report.charts import LineChart
from skillwrapper.report.curves import learning_charts
from skillwrapper.report.history import DatedDecision, RunHistory
from skillwrapper.report.strips import EpisodeStrips, lay_out
from skillwrapper.report.views import (
    PredicateView,
    SkillView,
    ViolationView,
    view_skills,
    view_violations,
)
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.archive.records import (
    CertificateRecord,
    InconsistencyRecord,
    SummaryRecord,
)
from skillwrapper.runs.provenance import Provenance
from skillwrapper.runs.settings import RunSettings
from skillwrapper.symbols import AbstractModel
from skillwrapper.symbols.pddl import print_domain

EMBEDDED = "embedded"


@dataclass(frozen=True)
class ReportContents:
    """What a report says.

    Attributes:
        settings: what the run was asked to do.
        settings_data: the same as plain data.
        made_with: which code made the run.
        config_text: the whole ``config.yaml``.
        started: when the run began, in UTC; None if there is no log.
        finished: when its last finished iteration ended, in UTC; None if there is no log.
        history: what happened.
        summary: figures at the end.
        predicates: the vocabulary.
        set_aside: the last decision on every predicate that was in and is not any more.
        skills: the skills with their operators.
        pddl: the whole domain.
        certificate: Lemma 1 and Theorem 1 on the recorded data.
        violations: what breaks it.
        unresolved: inconsistencies that are left.
        charts: the learning curve.
        account: model calls; None if none were recorded.
        episodes: strips of episodes, the richest ones, in order of time.
        opened: number of the episode that is shown unfolded; None if there is none.
        decodes: whether labels are decoded.
        knows_truth: whether the true labels of the pictures are known.
    """

    settings: RunSettings
    settings_data: dict[str, Any]
    made_with: Provenance
    config_text: str
    started: datetime.datetime | None
    finished: datetime.datetime | None
    history: RunHistory
    summary: SummaryRecord
    predicates: tuple[PredicateView, ...]
    set_aside: tuple[DatedDecision, ...]
    skills: tuple[SkillView, ...]
    pddl: str
    certificate: CertificateRecord
    violations: tuple[ViolationView, ...]
    unresolved: tuple[InconsistencyRecord, ...]
    charts: tuple[LineChart, ...]
    account: CallAccount | None
    episodes: tuple[EpisodeStrips, ...]
    opened: int | None
    decodes: bool = False
    knows_truth: bool = False

    @property
    def is_complete(self) -> bool:
        """Whether all iterations that were asked for are finished."""
        return len(self.history.iterations) >= self.settings.iterations

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
        model = self.settings.model
        others = {str(role) for role, name in model.roles.items() if name != EMBEDDED}
        own = {str(role) for role, name in model.roles.items() if name == EMBEDDED}
        if model.name == EMBEDDED:
            return (f"every role but {', '.join(sorted(others))}" if others else "every role",)
        return tuple(sorted(own))

    @classmethod
    def gather(cls, archive: RunArchive, most_episodes: int) -> ReportContents:
        """Read a run.

        Raises:
            UserError: if no iteration is finished, or a file is damaged.
        """
        latest, history = archive.latest(), RunHistory.read(archive)
        settings, model, labels = archive.settings(), latest.model, latest.labels
        beyond = beyond_readings(settings.domain, latest, history.episodes)
        strips = [
            lay_out(number, episode, labels, beyond)
            for number, episode in enumerate(history.episodes, start=1)
        ]
        richest = sorted(strips, key=lambda s: (-s.changes, s.number))[:most_episodes]
        times = [event.time for event in archive.events()]
        return cls(
            settings=settings,
            settings_data=settings.model_dump(mode="json"),
            made_with=archive.made_with(),
            config_text=archive.config_text(),
            started=_moment(times[0]) if times else None,
            finished=_moment(times[-1]) if times else None,
            history=history,
            summary=latest.summary,
            predicates=tuple(
                PredicateView.of(p, history, labels, latest.decoding) for p in model.predicates
            ),
            set_aside=tuple(_set_aside(history, model)),
            skills=view_skills(model, history),
            pddl=print_domain(model),
            certificate=latest.certificate,
            violations=tuple(view_violations(latest.certificate, history)),
            unresolved=latest.unresolved,
            charts=learning_charts(history, archive.curve()),
            account=read_account(archive),
            episodes=tuple(sorted(richest, key=lambda s: s.number)),
            opened=richest[0].number if richest else None,
            decodes=latest.decoding is not None,
            knows_truth=beyond.truth is not None,
        )


def _set_aside(history: RunHistory, model: AbstractModel) -> Iterator[DatedDecision]:
    """The last decision on predicates that were taken in and are no longer active."""
    active = set(model.predicate_by_name)
    last = {
        d.record.name: d
        for d in history.decisions()
        if d.record.verdict in ("dormant", "retracted")
    }
    return (decision for name, decision in last.items() if name not in active)


def _day(moment: datetime.datetime) -> str:
    return f"{moment.day} {moment:%B %Y}"


def _moment(seconds: float) -> datetime.datetime:
    return datetime.datetime.fromtimestamp(seconds, tz=datetime.UTC)
