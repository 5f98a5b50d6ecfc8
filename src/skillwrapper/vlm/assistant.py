"""The assistant: asks models the package's questions and hands back answers as data."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Protocol, TypeVar

from skillwrapper.exploration.questions import ProposalAnswer, ProposalQuestion
from skillwrapper.invention.questions import (
    BatchInventionQuestion,
    InventionAnswer,
    InventionQuestion,
    RephrasingQuestion,
)
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.perception.questions import EvaluationAnswer, EvaluationQuestion
from skillwrapper.planning.questions import ActionAnswer, ActionQuestion
from skillwrapper.symbols.predicates import Predicate
from skillwrapper.vlm.cut_offs import CUT_OFF_PROBLEM, CutOffs
from skillwrapper.vlm.evaluation import Evaluator
from skillwrapper.vlm.models import ModelSet
from skillwrapper.vlm.parsing import (
    ParameterNames,
    ParsedPredicates,
    parse_plan,
    parse_predicates,
    parse_sequences,
    says_nothing,
)
from skillwrapper.vlm.prompt_library import PromptLibrary, shipped_prompts
from skillwrapper.vlm.protocol import ModelRequest, Role, VisionLanguageModel
from skillwrapper.vlm.requests import RequestBuilder, Slot, allowed_slots, batch_slots, slots_of
from skillwrapper.vlm.settings import AskingSettings


class _Parsed(Protocol):
    @property
    def unusable(self) -> tuple[str, ...]: ...


Parsed = TypeVar("Parsed", bound=_Parsed)


class Assistant:
    """Asks vision-language models and reads their replies.

    Replies that cannot be used are asked for again a bounded number of times; what is then
    still missing is unknown or empty, and the answer says what could not be used.

    Args:
        models: a model for every role.
        prompts: the prompt templates.
        settings: how models are asked.
    """

    def __init__(
        self,
        models: ModelSet | Mapping[Role, VisionLanguageModel],
        prompts: PromptLibrary | None = None,
        settings: AskingSettings | None = None,
    ) -> None:
        self._models = models if isinstance(models, ModelSet) else ModelSet(models)
        self._requests = RequestBuilder(prompts or shipped_prompts())
        self._settings = settings or AskingSettings()
        self._evaluator = Evaluator(self._models, self._requests, self._settings)

    def propose_sequences(self, question: ProposalQuestion) -> ProposalAnswer:
        """Which skill sequences to try next; may be fewer or shorter than wanted."""
        parsed = self._ask(
            self._requests.proposal(question),
            lambda reply: parse_sequences(reply, question.domain.skills, question.objects),
            lambda parsed: bool(parsed.sequences),
        )
        return ProposalAnswer(parsed.sequences, parsed.unusable)

    def invent_predicates(self, question: InventionQuestion) -> InventionAnswer:
        """Which predicate may be missing: new ones only, the best first, at most ``count``."""
        names = _parameter_names(allowed_slots(question), _aliases(question))
        taken = (*question.current, *question.rejected)
        may_be_nothing = question.kind is InconsistencyKind.UNNOTICED

        def parse(reply: str) -> ParsedPredicates:
            parsed = _only_new(parse_predicates(reply, names), taken)
            if may_be_nothing and not parsed.predicates and says_nothing(reply):
                return ParsedPredicates((), ())
            return parsed

        parsed = self._ask(
            self._requests.invention(question),
            parse,
            lambda parsed: bool(parsed.predicates) or not parsed.unusable,
        )
        return InventionAnswer(parsed.predicates[: question.count], parsed.unusable)

    def rephrase_predicate(self, question: RephrasingQuestion) -> InventionAnswer:
        """A candidate in general terms; may be empty."""
        names = _parameter_names(slots_of(question.types), {})
        parsed = self._ask(
            self._requests.rephrasing(question),
            lambda reply: parse_predicates(reply, names),
            lambda parsed: bool(parsed.predicates),
        )
        return InventionAnswer(parsed.predicates, parsed.unusable)

    def invent_batch(self, question: BatchInventionQuestion) -> InventionAnswer:
        """A whole vocabulary at once (FM Invent); as many as the model gives, at most ``count``."""
        names = _parameter_names(batch_slots(question.domain), {})
        parsed = self._ask(
            self._requests.batch_invention(question),
            lambda reply: parse_predicates(reply, names),
            lambda parsed: bool(parsed.predicates),
        )
        return InventionAnswer(parsed.predicates[: question.count], parsed.unusable)

    def evaluate(self, questions: Sequence[EvaluationQuestion]) -> list[EvaluationAnswer]:
        """Labels of all groundings of all questions, in the order of the questions."""
        return self._evaluator.evaluate(questions)

    def next_actions(self, question: ActionQuestion) -> ActionAnswer:
        """The plan from the present picture on (ViLa)."""
        parsed = self._ask(
            self._requests.next_action(question),
            lambda reply: parse_plan(reply, question.domain.skills, question.objects),
            lambda parsed: bool(parsed.plan) or parsed.done or parsed.impossible,
        )
        return ActionAnswer(parsed.plan, parsed.done, parsed.impossible)

    def _ask(
        self,
        request: ModelRequest,
        parse: Callable[[str], Parsed],
        usable: Callable[[Parsed], bool],
    ) -> Parsed:
        """The first usable reading of a reply, or the last one if none is."""
        cut_offs = CutOffs()
        asked = request
        for time in range(1, 2 + self._settings.unusable_reasks):
            parsed, problem = self._try(asked, parse, usable, cut_offs)
            if not problem:
                break
            asked = replace(self._requests.again(request, problem, time), repetition=time)
        return parsed

    def _try(
        self,
        request: ModelRequest,
        parse: Callable[[str], Parsed],
        usable: Callable[[Parsed], bool],
        cut_offs: CutOffs,
    ) -> tuple[Parsed, str]:
        """The reading of one reply, and why it is of no use; the reply is then taken back."""
        reply = self._models.complete(request)
        is_cut_off = cut_offs.check(self._models.by_role[request.role], request, reply)
        parsed = parse("" if is_cut_off else reply.text)
        if not usable(parsed):
            self._models.take_back(request)
            found = parsed.unusable[0] if parsed.unusable else "it holds nothing usable"
            return parsed, CUT_OFF_PROBLEM if is_cut_off else found
        if reply.taken_back:  # another version of the parser could not read it
            parsed = parse("")
            return parsed, parsed.unusable[0]
        return parsed, ""


def _parameter_names(slots: Iterable[Slot], aliases: Mapping[str, str]) -> ParameterNames:
    return ParameterNames({slot.type: slot.times for slot in slots}, aliases)


def _aliases(question: InventionQuestion) -> dict[str, str]:
    """Parameters of the skill and objects of the witnesses, with the allowed types they mean."""
    allowed = frozenset(question.types)
    aliases: dict[str, str] = {}
    for atom in question.unexplained:
        for term in atom.terms:
            fitting = _types_of(question, term) & allowed
            if len(fitting) == 1:
                aliases[term] = min(fitting)
    for transition in (question.first, question.second):
        if transition is not None:
            for parameter, name in zip(
                question.skill.parameters, transition.instance.arguments, strict=False
            ):
                if parameter.type in allowed:
                    aliases.setdefault(name, parameter.type)
    for parameter in question.skill.parameters:
        if parameter.type in allowed:
            aliases[parameter.name] = parameter.type
    return aliases


def _types_of(question: InventionQuestion, name: str) -> frozenset[str]:
    found = question.domain.object_by_name.get(name)
    return frozenset(found.types) if found else frozenset()


def _only_new(parsed: ParsedPredicates, taken: Sequence[Predicate]) -> ParsedPredicates:
    """Without predicates that are known or rejected under the same name and types."""
    known = {(p.name, p.types) for p in taken}
    old = [p for p in parsed.predicates if (p.name, p.types) in known]
    if not old:
        return parsed
    return ParsedPredicates(
        tuple(p for p in parsed.predicates if p not in old),
        (*parsed.unusable, *(f"{p.signature}: known or rejected already" for p in old)),
    )
