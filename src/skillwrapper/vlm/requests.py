"""From a question to the request a model gets: the prompt filled in, the pictures attached."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from skillwrapper.exploration.questions import ProposalQuestion
from skillwrapper.invention.questions import (
    BatchInventionQuestion,
    InventionQuestion,
    RephrasingQuestion,
)
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.perception.questions import EvaluationQuestion
from skillwrapper.planning.questions import ActionQuestion
from skillwrapper.symbols.predicates import Atom, Predicate
from skillwrapper.vlm.prompt_library import PromptKind, PromptLibrary
from skillwrapper.vlm.protocol import ModelRequest, Role
from skillwrapper.world.domain import Domain
from skillwrapper.world.observation import Observation, Picture

_INVENTION_PROMPTS = {
    InconsistencyKind.PRECONDITION: PromptKind.INVENT_PRECONDITION,
    InconsistencyKind.EFFECT: PromptKind.INVENT_EFFECT,
    InconsistencyKind.DETERMINISM: PromptKind.INVENT_DETERMINISM,
    InconsistencyKind.UNEXPLAINED: PromptKind.INVENT_UNEXPLAINED,
    InconsistencyKind.UNNOTICED: PromptKind.INVENT_UNNOTICED,
}


@dataclass(frozen=True, order=True)
class Slot:
    """A type that parameters of a new predicate may have.

    Attributes:
        type: the type.
        times: how many parameters may have it, 1 or 2.
    """

    type: str
    times: int


def allowed_slots(question: InventionQuestion) -> tuple[Slot, ...]:
    """How often a new predicate may use each allowed type.

    For a change of other objects any two of the types will do; for all other kinds the parameters
    are among the skill's own (docs/semantics.md D1), so a type counts as often as the skill has it.
    """
    if question.wide or question.kind is InconsistencyKind.UNEXPLAINED:
        return tuple(Slot(name, 2) for name in dict.fromkeys(question.types))
    own = Counter(p.type for p in question.skill.parameters)
    named = Counter(question.types)
    return tuple(
        Slot(name, max(1, min(2, max(own[name], named[name]))))
        for name in dict.fromkeys(question.types)
    )


def slots_of(types: Sequence[str]) -> tuple[Slot, ...]:
    """Exactly these parameters."""
    return tuple(Slot(name, times) for name, times in Counter(types).items())


def batch_slots(domain: Domain) -> tuple[Slot, ...]:
    """When a whole vocabulary is invented, every type may be used."""
    return tuple(Slot(name, 2) for name in domain.types.names)


class RequestBuilder:
    """Renders questions into model requests.

    Args:
        prompts: the templates.
    """

    def __init__(self, prompts: PromptLibrary) -> None:
        self._prompts = prompts

    def proposal(self, question: ProposalQuestion) -> ModelRequest:
        """Ask for skill sequences."""
        captions, pictures = _album([("the scene now", question.observation)])
        prompt = self._prompts.render(
            PromptKind.PROPOSE_SEQUENCES,
            domain=question.domain,
            objects=question.objects,
            captions=captions,
            predicates=question.predicates,
            operators=question.operators,
            least_explored=[f"{a} then {b}" for a, b in question.least_explored],
            scarce_skills=question.scarce_skills,
            count=question.count,
            length=question.length,
        )
        return self._request(Role.PROPOSE, question.domain, prompt, pictures)

    def invention(self, question: InventionQuestion) -> ModelRequest:
        """Ask for the predicate that is missing."""
        captions, pictures = _album(_witness_views(question))
        variables = {
            "domain": question.domain,
            "skill": question.skill,
            "executions": [t for t in (question.first, question.second) if t is not None],
            "captions": captions,
            "objects": question.domain.objects,
            "slots": allowed_slots(question),
            "current": question.current,
            "rejected": question.rejected,
            "count": question.count,
            "attempt": question.attempt,
        }
        if question.kind is InconsistencyKind.UNEXPLAINED:
            variables["unexplained"] = question.unexplained
        if question.kind is InconsistencyKind.UNNOTICED:
            variables |= {"wide": question.wide, "long": question.long}
        prompt = self._prompts.render(_INVENTION_PROMPTS[question.kind], **variables)
        return self._request(Role.INVENT, question.domain, prompt, pictures)

    def rephrasing(self, question: RephrasingQuestion) -> ModelRequest:
        """Ask for a candidate in general terms."""
        prompt = self._prompts.render(
            PromptKind.REPHRASE,
            domain=question.domain,
            candidate=question.candidate,
            slots=slots_of(question.types),
            wanted=question.types,
        )
        return self._request(Role.INVENT, question.domain, prompt, ())

    def batch_invention(self, question: BatchInventionQuestion) -> ModelRequest:
        """Ask for a whole vocabulary."""
        captions, pictures = _album(
            (f"situation {number}", observation)
            for number, observation in enumerate(question.observations, start=1)
        )
        prompt = self._prompts.render(
            PromptKind.INVENT_BATCH,
            domain=question.domain,
            objects=question.domain.objects,
            captions=captions,
            slots=batch_slots(question.domain),
            count=question.count,
        )
        return self._request(Role.INVENT, question.domain, prompt, pictures)

    def evaluation(self, question: EvaluationQuestion, atoms: Sequence[Atom]) -> ModelRequest:
        """First stage: ask for a description and free judgements of some of the groundings."""
        captions, pictures = _album([("the scene", question.observation)])
        prompt = self._prompts.render(
            PromptKind.EVALUATE,
            domain=question.domain,
            objects=question.objects,
            captions=captions,
            predicates=_predicates_of(atoms, question.predicates),
            atoms=atoms,
        )
        return self._request(Role.EVALUATE, question.domain, prompt, pictures)

    def summary(
        self, question: EvaluationQuestion, atoms: Sequence[Atom], response: str
    ) -> ModelRequest:
        """Second stage: ask for one label a grounding, from the first reply alone."""
        prompt = self._prompts.render(
            PromptKind.SUMMARISE,
            domain=question.domain,
            objects=question.objects,
            predicates=_predicates_of(atoms, question.predicates),
            atoms=atoms,
            response=response,
        )
        return self._request(Role.SUMMARISE, question.domain, prompt, ())

    def next_action(self, question: ActionQuestion) -> ModelRequest:
        """Ask for a plan from the present picture to the goal picture."""
        captions, pictures = _album([("now", question.observation), ("the goal", question.goal)])
        prompt = self._prompts.render(
            PromptKind.NEXT_ACTION,
            domain=question.domain,
            objects=question.objects,
            captions=captions,
            history=[
                f"{instance} {'succeeded' if success else 'failed'}"
                for instance, success in question.history
            ],
        )
        return self._request(Role.ACT, question.domain, prompt, pictures)

    def again(self, request: ModelRequest, problem: str, time: int) -> ModelRequest:
        """The same request once more, saying what was wrong with the last reply."""
        note = self._prompts.render(PromptKind.ASK_AGAIN, problem=problem, time=time + 1)
        return replace(request, prompt=f"{request.prompt}\n\n{note}")

    def _request(
        self, role: Role, domain: Domain, prompt: str, pictures: tuple[Picture, ...]
    ) -> ModelRequest:
        system = self._prompts.render(PromptKind.SYSTEM, domain=domain)
        return ModelRequest(role, system, prompt, pictures)


def _witness_views(question: InventionQuestion) -> list[tuple[str, Observation]]:
    """The moments a question shows: only those before where what comes after decides nothing."""
    before_only = {InconsistencyKind.PRECONDITION, InconsistencyKind.DETERMINISM}
    with_after = question.kind not in before_only
    views = []
    for number, transition in enumerate((question.first, question.second), start=1):
        if transition is None:
            continue
        views.append((f"before execution {number}", transition.before))
        if with_after:
            views.append((f"after execution {number}", transition.after))
    return views


def _album(
    views: Iterable[tuple[str, Observation]],
) -> tuple[list[str], tuple[Picture, ...]]:
    """Captions and pictures in one order; several cameras give several pictures of a moment."""
    captions, pictures = [], []
    for caption, observation in views:
        several = len(observation.pictures) > 1
        for picture in observation.pictures:
            captions.append(f"{caption}, camera {picture.camera}" if several else caption)
            pictures.append(picture)
    return captions, tuple(pictures)


def _predicates_of(atoms: Sequence[Atom], predicates: Sequence[Predicate]) -> list[Predicate]:
    names = {atom.predicate for atom in atoms}
    return [p for p in predicates if p.name in names]
