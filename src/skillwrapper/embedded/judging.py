"""Answering the two prompts of evaluation: judging a picture, and summing up what was said."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillwrapper.embedded.chance import Chance
from skillwrapper.embedded.facts import Fact, Sort
from skillwrapper.embedded.lexicon import Lexicon, Understanding
from skillwrapper.embedded.prompt_text import PromptText, WrittenCall
from skillwrapper.embedded.sight import Sight
from skillwrapper.symbols.predicates import Atom
from skillwrapper.vlm.parsing.labels import parse_labels

_WORDINGS: tuple[dict[bool | None, str], ...] = (
    {True: "- {} is true.", False: "- {} is false.", None: "- {} cannot be told."},
    {True: "{}: yes", False: "{}: no", None: "{}: unclear"},
    {True: "* {}: true", False: "* {}: false", None: "* {}: uncertain"},
)
_GROUPS = {True: "True:", False: "False:", None: "Unsure:"}
_LABELS = {True: "true", False: "false", None: "unsure"}


def judge_picture(prompt: PromptText, sight: Sight | None, lexicon: Lexicon, chance: Chance) -> str:
    """Describe the picture, then judge every statement, in one of several manners."""
    verdicts = [(str(call), verdict) for call, verdict in _verdicts(prompt, sight, lexicon)]
    unknown = "I do not recognise what this picture shows."
    description = describe(sight, lexicon) if sight else unknown
    style = chance.below(len(_WORDINGS) + 1)
    if style == len(_WORDINGS):
        return f"{description}\n\n{_grouped(verdicts)}"
    wording = _WORDINGS[style]
    return "\n".join([description, "", *(wording[v].format(call) for call, v in verdicts)])


def describe(sight: Sight, lexicon: Lexicon) -> str:
    """What seems to be where, in sentences that name no predicate."""
    sentences = []
    for thing in sight.graph.things:
        looks = [a for a in sorted(sight.graph.attributes.get(thing.name, ()))
                 if sight.holds(Fact(Sort.ATTRIBUTE, a, (thing.name,)))]  # fmt: skip
        places = [
            f"{relation} the {fact.things[1]}"
            for relation in sight.graph.outline.relations
            for fact in lexicon.relation(relation).facts_of(sight, thing.name)
            if sight.holds(fact)
        ]
        if (looks or places) and not thing.scenery:
            seen = ", ".join((*looks, *places)).replace("_", " ")
            sentences.append(f"I see the {thing.name}: {seen}.")
    return " ".join(sentences) or "I see nothing that stands out."


def summarise(prompt: PromptText) -> str:
    """One line with a label for every statement, from the quoted text alone."""
    atoms = [Atom(call.name, call.arguments) for call in prompt.calls("Statements")]
    labels = parse_labels(prompt.quotation, atoms).labels
    return "\n".join(f"{atom}: {_LABELS[labels.get(atom)]}" for atom in atoms)


def _verdicts(
    prompt: PromptText, sight: Sight | None, lexicon: Lexicon
) -> Iterator[tuple[WrittenCall, bool | None]]:
    statements = prompt.calls("Statements")
    meanings = _meanings(prompt, sight, statements, lexicon) if sight else {}
    for call in statements:
        meaning = meanings.get(call.name)
        if sight is None or meaning is None or len(meaning.order) != len(call.arguments):
            yield call, None
        else:
            yield call, meaning.concept.truth(sight, meaning.arranged(call.arguments))


def _meanings(
    prompt: PromptText, sight: Sight, statements: Sequence[WrittenCall], lexicon: Lexicon
) -> dict[str, Understanding]:
    """What the predicates of the statements mean; those not understood are left out."""
    said_of: dict[str, list[tuple[str, ...]]] = {}
    for call in statements:
        said_of.setdefault(call.name, []).append(call.arguments)
    meanings = {}
    for predicate in prompt.predicates("Predicates"):
        found = lexicon.meaning(
            predicate.name, predicate.semantics, said_of.get(predicate.name, ()), sight.graph
        )
        if found is not None:
            meanings[predicate.name] = found
    return meanings


def _grouped(verdicts: Sequence[tuple[str, bool | None]]) -> str:
    lines = []
    for verdict, title in _GROUPS.items():
        calls = [call for call, given in verdicts if given is verdict]
        if calls:
            lines += [f"**{title}**", *(f"- {call}" for call in calls), ""]
    return "\n".join(lines)
