"""A review of one run: its page, its pictures, and what is done with a correction."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from skillwrapper.errors import ConfigurationError, UnknownNameError
from skillwrapper.redaction import without_secrets
from skillwrapper.report.page import page_environment
from skillwrapper.review.doubts import review_pictures
from skillwrapper.runs.archive import RunArchive, reserved
from skillwrapper.runs.archive.records import (
    CorrectionRecord,
    LabelCorrection,
    Rejection,
    Renaming,
    Rewording,
)
from skillwrapper.runs.corrections import Corrections
from skillwrapper.runs.imported_model import imported_note
from skillwrapper.runs.relearning import relearn
from skillwrapper.symbols import Predicate
from skillwrapper.symbols.describe import describe_model

_VALUES: Mapping[str, bool | None] = {"true": True, "false": False, "unsure": None}
_PAGE = 20
"""Pictures on a page."""


@dataclass(frozen=True)
class Review:
    """A person's work on a run.

    Attributes:
        archive: the run.
    """

    archive: RunArchive

    def page(self, number: int = 1, *, token: str = "", problem: str = "") -> str:
        """The page in HTML; pictures with most doubt are on the first.

        Args:
            number: from 1.
            token: goes into all its links.
            problem: what was wrong with the last correction.
        """
        latest, pictures = self.archive.latest(), review_pictures(self.archive)
        pages = max(1, -(-len(pictures) // _PAGE))
        number = min(max(1, number), pages)
        template = page_environment().get_template("review.html.j2")
        return template.render(
            name=latest.domain.name,
            token=token,
            problem=problem,
            predicates=latest.model.predicates,
            operators=describe_model(latest.model),
            imported=imported_note(self.archive),
            summary=latest.summary,
            certificate=latest.certificate,
            corrections=len(self.archive.corrections()),
            doubtful=sum(bool(picture.doubts) for picture in pictures),
            pictures=pictures[(number - 1) * _PAGE : number * _PAGE],
            number=number,
            pages=pages,
        )

    def picture(self, sha256: str) -> bytes | None:
        """A picture of the run; None if there is none."""
        if len(sha256) != 64 or not set(sha256) <= set("0123456789abcdef"):
            return None
        return self.archive.pictures.find(sha256)

    def correct(self, form: Mapping[str, str]) -> None:
        """Record a correction, and learn anew with it.

        Args:
            form: what the page sends: ``kind``, and what belongs to it.

        Raises:
            UserError: if it is no correction of this run, or somebody else is at work in it;
                nothing is recorded then.
        """
        with reserved(self.archive.path):
            self.archive.correct(CorrectionRecord(self._read(form)))
            relearn(self.archive)

    def _read(self, form: Mapping[str, str]) -> Any:
        match form.get("kind", ""):
            case "label":
                return self._read_label(form)
            case "rename":
                return self._read_renaming(self._known(form), form.get("to", "").strip())
            case "reword":
                meaning = without_secrets(" ".join(form.get("semantics", "").split()))
                if not meaning:
                    raise ConfigurationError(
                        "expected a sentence that says what it means, got none"
                    )
                return _reworded(self._known(form), meaning)
            case "reject":
                return Rejection(predicate=self._known(form).name)
            case kind:
                raise UnknownNameError("correction", kind, ("label", "rename", "reword", "reject"))

    def _read_label(self, form: Mapping[str, str]) -> LabelCorrection:
        key, atom, value = (form.get(name, "") for name in ("observation", "atom", "value"))
        labels = self.archive.latest().labels.of(key)
        if not labels:
            raise UnknownNameError("picture", key[:12], ())
        if atom not in labels:
            raise UnknownNameError("label", atom, labels)
        if value not in _VALUES:
            raise UnknownNameError("value", value, _VALUES)
        return LabelCorrection(observation=key, atom=atom, value=_VALUES[value], read=labels[atom])

    def _read_renaming(self, predicate: Predicate, to: str) -> Renaming:
        Predicate(to, predicate.types)  # raises if that is no name
        taken = {p.name for p in self.archive.latest().model.predicates}
        if to in taken or Corrections.of(self.archive.corrections()).uses(to):
            raise ConfigurationError(
                f"expected a name that no predicate has or had, got '{to}'; choose another"
            )
        return Renaming(
            predicate=predicate.name,
            to=to,
            types=predicate.types,
            semantics=predicate.semantics,
        )

    def _known(self, form: Mapping[str, str]) -> Predicate:
        known = self.archive.latest().model.predicate_by_name
        name = form.get("predicate", "")
        if name not in known:
            raise UnknownNameError("predicate", name, known)
        return known[name]


def _reworded(predicate: Predicate, meaning: str) -> Rewording:
    return Rewording(predicate=predicate.name, types=predicate.types, semantics=meaning)
