"""Trying out a model before a run: can it be reached, does it see, are its replies of use."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import dataclass

from skillwrapper.domains.discovery import find_domain
from skillwrapper.errors import ProviderError, UserError
from skillwrapper.exploration.questions import ProposalQuestion
from skillwrapper.invention.questions import InventionQuestion
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.perception.questions import EvaluationQuestion
from skillwrapper.runs.models import open_model, open_prompts
from skillwrapper.runs.settings import ModelSettings
from skillwrapper.symbols import Predicate
from skillwrapper.vlm.assistant import Assistant
from skillwrapper.vlm.models import ModelSet
from skillwrapper.vlm.protocol import ModelRequest, Role, VisionLanguageModel
from skillwrapper.vlm.retrying import RetryingModel, RetryPolicy
from skillwrapper.vlm.settings import AskingSettings
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Transition
from skillwrapper.world.observation import Observation
from skillwrapper.world.skills import SkillInstance
from skillwrapper.world.types import Object

_ATTEMPTS = RetryPolicy(attempts=3, first_wait=0.5, longest_wait=2.0, longest_asked_wait=10.0)
_HOW = AskingSettings(reasks=0, unusable_reasks=1)
_CHOOSE_ANOTHER = "reword its template (learn --prompts), or choose another model"


@dataclass(frozen=True)
class Finding:
    """What one check showed.

    Attributes:
        check: what was tried.
        passed: whether it went well.
        detail: what was seen; if it did not go well, also what to do.
    """

    check: str
    passed: bool
    detail: str


@dataclass(frozen=True)
class _Specimen:
    """A picture of the bundled kitchen, and two skills that were tried in it."""

    domain: Domain
    objects: tuple[Object, ...]
    start: Observation
    success: Transition
    failure: Transition


def examine(settings: ModelSettings) -> Iterator[Finding]:
    """Try a model; stops at the first check that makes the others pointless.

    Args:
        settings: which model, where, and with which templates.
    """
    try:
        model = open_model(settings.name, settings, 0)
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
    specimen = _specimen()
    assistant = Assistant(ModelSet.of(patient), prompts, _HOW)
    checks: tuple[tuple[str, Callable[[], Finding]], ...] = (
        ("endpoint", lambda: _answers(patient)),
        ("pictures", lambda: _accepts_pictures(patient, specimen)),
        ("proposing sequences", lambda: _proposes(assistant, specimen)),
        ("inventing predicates", lambda: _invents(assistant, specimen)),
        ("reading pictures", lambda: _reads(assistant, specimen)),
    )
    for name, check in checks:
        try:
            yield check()
        except (ProviderError, UserError) as error:
            yield Finding(name, False, str(error))
            return


def _answers(model: VisionLanguageModel) -> Finding:
    reply = model.complete(ModelRequest(Role.ACT, "", "Reply with the word: ready"))
    return Finding("endpoint", True, f"it answers, in {reply.usage.seconds:.1f} s")


def _accepts_pictures(model: VisionLanguageModel, specimen: _Specimen) -> Finding:
    prompt = "Say in one sentence what the picture shows."
    model.complete(ModelRequest(Role.ACT, "", prompt, specimen.start.pictures))
    return Finding("pictures", True, "it accepts a picture")


def _proposes(assistant: Assistant, specimen: _Specimen) -> Finding:
    skills = tuple(skill.name for skill in specimen.domain.skills)
    question = ProposalQuestion(
        specimen.domain, specimen.objects, specimen.start, (), (), (), skills, 2, 4
    )
    answer = assistant.propose_sequences(question)
    if answer.sequences:
        first = ", ".join(map(str, answer.sequences[0][:3]))
        return Finding("proposing sequences", True, f"e.g. {first} ...")
    return _of_no_use("proposing sequences", answer.unusable)


def _invents(assistant: Assistant, specimen: _Specimen) -> Finding:
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
    return _of_no_use("inventing predicates", answer.unusable)


def _reads(assistant: Assistant, specimen: _Specimen) -> Finding:
    skill = specimen.domain.skill_by_name[specimen.success.instance.skill]
    types = tuple(parameter.type for parameter in skill.parameters)
    holds = Predicate("holding", types, "the robot holds the object in its gripper.")
    pictures = (specimen.success.before, specimen.success.after)
    answers = assistant.evaluate(
        [EvaluationQuestion(specimen.domain, specimen.objects, p, (holds,)) for p in pictures]
    )
    labels = [label for answer in answers for label in answer.labels.values()]
    known = [label for label in labels if label is not None]
    if not known:
        return _of_no_use("reading pictures", ("no label in the whole reply",))
    terms = specimen.success.instance.arguments
    of_picked = [v for answer in answers for a, v in answer.labels.items() if a.terms == terms]
    right = of_picked == [False, True]
    seen = "and saw what was picked" if right else "but did not see that something was picked"
    return Finding("reading pictures", True, f"{len(known)} of {len(labels)} labels, {seen}")


def _of_no_use(check: str, unusable: tuple[str, ...]) -> Finding:
    why = unusable[0] if unusable else "nothing in it was of use"
    return Finding(check, False, f"the replies cannot be used ({why}); {_CHOOSE_ANOTHER}")


def _specimen() -> _Specimen:
    picked = SkillInstance("Pick", ("robot", "patty"))
    in_vain = SkillInstance("Pick", ("robot", "lettuce"))
    with closing(find_domain("burger").make_environment()) as kitchen:
        start = kitchen.reset(seed=0)
        first = kitchen.execute(picked)
        second = kitchen.execute(in_vain)
        return _Specimen(
            kitchen.domain,
            kitchen.scene.objects,
            start,
            Transition(start, picked, first.success, first.observation),
            Transition(first.observation, in_vain, second.success, second.observation),
        )
