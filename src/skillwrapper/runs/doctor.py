"""Trying out a model before a run: can it be reached, does it see, are its replies of use."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import closing

from skillwrapper.domains.discovery import bundled_domains, find_domain
from skillwrapper.domains.package import DomainPackage
from skillwrapper.errors import ConfigurationError, ProviderError, UserError
from skillwrapper.exploration.questions import ProposalQuestion
from skillwrapper.invention.questions import InventionQuestion
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.perception.questions import EvaluationQuestion
from skillwrapper.runs.consistency import OwnPictures, check_consistency
from skillwrapper.runs.findings import Finding, of_no_use
from skillwrapper.runs.models import GREETING, open_model, open_prompts
from skillwrapper.runs.settings import ModelSettings
from skillwrapper.runs.specimens import Specimen, read_specimen
from skillwrapper.symbols import Atom
from skillwrapper.vlm.assistant import Assistant
from skillwrapper.vlm.models import ModelSet
from skillwrapper.vlm.protocol import ModelRequest, Role, VisionLanguageModel
from skillwrapper.vlm.retrying import RetryingModel, RetryPolicy
from skillwrapper.vlm.settings import AskingSettings
from skillwrapper.world.observation import Observation
from skillwrapper.world.pictures import load_pictures

_ATTEMPTS = RetryPolicy(attempts=3, first_wait=0.5, longest_wait=2.0, longest_asked_wait=10.0)
_HOW = AskingSettings(reasks=0, unusable_reasks=1)
_TWICE = _HOW.model_copy(update={"votes": 2})
_GOOD = 0.75
"""The share of answers that must be right."""


def examine(
    settings: ModelSettings,
    domain: str | None = None,
    pictures: Sequence[str] = (),
) -> Iterator[Finding]:
    """Try a model; stops at the first check that makes the others pointless.

    Args:
        settings: which model, where, and with which templates.
        domain: whose pictures it is tried on; None for a bundled one's. Of one that brings none
            with known answers, what its robot sees at a start is shown.
        pictures: files of pictures of the domain, in place of all that.

    Raises:
        UserError: if the domain or a picture cannot be read, or there is nothing to show.
        RobotError: if the robot that is to look fails.
    """
    package = find_domain(domain) if domain else _bundled()
    knows = package.has("doctor") and not pictures
    specimen = read_specimen(package) if knows else _own_pictures(package, pictures)
    try:
        model = open_model(settings.name, settings, 0, domain)
    except (ProviderError, UserError) as error:
        yield Finding("name and key", False, str(error))
        return
    yield Finding("name and key", True, f"{settings.name} can be asked")
    try:
        prompts = open_prompts(settings)
    except UserError as error:
        yield Finding("prompt templates", False, str(error))
        return
    if settings.prompts:
        yield Finding("prompt templates", True, f"those in {settings.prompts} can be used")
    patient = RetryingModel(model, _ATTEMPTS)
    assistant = Assistant(ModelSet.of(patient), prompts, _HOW)
    checks: list[tuple[str, Callable[[], Iterable[Finding]]]] = [
        ("endpoint", lambda: [_answers(patient)])
    ]
    if isinstance(specimen, Specimen):
        checks += _known_answers(patient, assistant, specimen)
    else:
        twice = Assistant(ModelSet.of(patient), prompts, _TWICE)
        checks += _own_words(patient, assistant, twice, specimen)
    for name, check in checks:
        try:
            yield from check()
        except (ProviderError, UserError) as error:
            yield Finding(name, False, str(error))
            return


def _known_answers(
    model: VisionLanguageModel, assistant: Assistant, specimen: Specimen
) -> list[tuple[str, Callable[[], Iterable[Finding]]]]:
    return [
        ("pictures", lambda: [_accepts_pictures(model, specimen.success.before)]),
        ("proposing sequences", lambda: [_proposes(assistant, specimen)]),
        ("inventing predicates", lambda: [_invents(assistant, specimen)]),
        ("reading pictures", lambda: [_reads(assistant, specimen)]),
    ]


def _own_words(
    model: VisionLanguageModel, once: Assistant, twice: Assistant, own: OwnPictures
) -> list[tuple[str, Callable[[], Iterable[Finding]]]]:
    return [
        ("pictures", lambda: [_accepts_pictures(model, own.observations[0])]),
        ("consistency", lambda: check_consistency(once, twice, own)),
    ]


def _own_pictures(package: DomainPackage, files: Sequence[str]) -> OwnPictures:
    """The pictures that are given, or what the robot of a domain sees at a start."""
    if files:
        seen = tuple(load_pictures([file]) for file in files)
        return OwnPictures(package.domain, package.domain.scene(), seen)
    with closing(package.make_environment()) as environment:
        start = environment.reset(seed=0)
        return OwnPictures(package.domain, environment.scene, (start,))


def _bundled() -> DomainPackage:
    """A bundled domain that brings pictures for trying out a model."""
    found = next((package for package in bundled_domains() if package.has("doctor")), None)
    if found is None:
        raise ConfigurationError("no bundled domain brings pictures for this; name a domain")
    return found


def _answers(model: VisionLanguageModel) -> Finding:
    reply = model.complete(ModelRequest(Role.ACT, "", GREETING))
    return Finding("endpoint", True, f"it answers, in {reply.usage.seconds:.1f} s")


def _accepts_pictures(model: VisionLanguageModel, shown: Observation) -> Finding:
    prompt = "Say in one sentence what the picture shows."
    model.complete(ModelRequest(Role.ACT, "", prompt, shown.pictures))
    return Finding("pictures", True, "it accepts a picture")


def _proposes(assistant: Assistant, specimen: Specimen) -> Finding:
    skills = tuple(skill.name for skill in specimen.domain.skills)
    question = ProposalQuestion(
        specimen.domain, specimen.objects, specimen.success.before, (), (), (), skills, 2, 4
    )
    answer = assistant.propose_sequences(question)
    if answer.sequences:
        first = ", ".join(map(str, answer.sequences[0][:3]))
        return Finding("proposing sequences", True, f"e.g. {first} ...")
    return of_no_use("proposing sequences", answer.unusable)


def _invents(assistant: Assistant, specimen: Specimen) -> Finding:
    skill = specimen.domain.skill_by_name[specimen.success.instance.skill]
    question = InventionQuestion(
        domain=specimen.domain,
        skill=skill,
        kind=InconsistencyKind.PRECONDITION,
        first=specimen.success,
        second=specimen.failure,
        types=tuple(dict.fromkeys(p.type for p in skill.parameters)),
        unexplained=(),
        current=(),
        rejected=(),
        count=3,
    )
    answer = assistant.invent_predicates(question)
    if answer.predicates:
        predicate = answer.predicates[0]
        return Finding(
            "inventing predicates", True, f"e.g. {predicate.signature}: {predicate.semantics}"
        )
    return of_no_use("inventing predicates", answer.unusable)


def _reads(assistant: Assistant, specimen: Specimen) -> Finding:
    pictures = (specimen.success.before, specimen.success.after)
    answers = assistant.evaluate(
        [
            EvaluationQuestion(specimen.domain, specimen.objects, picture, specimen.predicates)
            for picture in pictures
        ]
    )
    labels = [answer.labels for answer in answers]
    if not any(label is not None for picture in labels for label in picture.values()):
        return of_no_use("reading pictures", ("no label in the whole reply",))
    return _judged(labels, specimen.truth)


def _judged(
    said: Sequence[Mapping[Atom, bool | None]], truth: Sequence[Mapping[Atom, bool]]
) -> Finding:
    """Compare labels with the truth: what is true, what is false, and what has changed.

    Each of the three counts for itself, so that neither a model that says the same of everything
    nor one that guesses without looking passes, however rare true atoms are.
    """
    asked = [(labels[atom], true) for labels, known in zip(said, truth, strict=True)
             for atom, true in known.items()]  # fmt: skip
    before, after = truth
    changed = [atom for atom in before if before[atom] != after[atom]]
    parts = (
        ("true", [label is True for label, true in asked if true]),
        ("false", [label is False for label, true in asked if not true]),
        ("changed", [
            all(labels[atom] == known[atom] for labels, known in zip(said, truth, strict=True))
            for atom in changed
        ]),
    )  # fmt: skip
    figures = ", ".join(f"{sum(right)} of {len(right)} {name}" for name, right in parts)
    if all(sum(right) >= _GOOD * len(right) for _, right in parts):
        return Finding("reading pictures", True, f"right about {figures}")
    detail = f"right about {figures} only; {_why(said, changed)}; choose another model"
    return Finding("reading pictures", False, detail)


def _why(said: Sequence[Mapping[Atom, bool | None]], changed: Sequence[Atom]) -> str:
    values = {label for labels in said for label in labels.values()}
    if len(values) == 1:
        return f"it says {str(values.pop()).lower()} of everything, whatever is shown and asked"
    if any(len(set(labels.values())) == 1 for labels in said):
        return "it says the same of all that is asked about a picture"
    if all(said[0][atom] == said[1][atom] for atom in changed):
        return "it says the same of different pictures: it does not seem to see them"
    return "it does not read these pictures well enough"
