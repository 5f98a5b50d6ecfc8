"""Answering the two prompts of evaluation: judging a picture, and summing up what was said."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillwrapper.embedded.chance import Chance
from skillwrapper.embedded.lexicon import Understanding, understand
from skillwrapper.embedded.noise import Judgement
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


def judge_picture(
    prompt: PromptText, sight: Sight | None, judgement: Judgement, chance: Chance
) -> str:
    """Describe the picture, then judge every statement, in one of several manners."""
    verdicts = [(str(call), verdict) for call, verdict in _verdicts(prompt, sight, judgement)]
    description = describe(sight) if sight else "I do not recognise what this picture shows."
    style = chance.below(len(_WORDINGS) + 1)
    if style == len(_WORDINGS):
        return f"{description}\n\n{_grouped(verdicts)}"
    wording = _WORDINGS[style]
    return "\n".join([description, "", *(wording[v].format(call) for call, v in verdicts)])


def describe(sight: Sight) -> str:
    """What is where, in sentences that name no predicate."""
    scene = sight.scene
    sentences = []
    for robot in scene.names("robot"):
        held = " and ".join(f"the {name}" for name in scene.held_by(robot))
        sentences.append(f"I see the {robot}; over its head there is {held or 'nothing'}.")
    for upper, lower in sorted(scene.on.items()):
        looks = " and ".join(sorted(scene.attributes.get(upper, ())))
        seen = f"The {upper}, {looks}," if looks else f"The {upper}"
        sentences.append(f"{seen} is seen on the {lower.replace('_', ' ')}.")
    return " ".join(sentences)


def summarise(prompt: PromptText) -> str:
    """One line with a label for every statement, from the quoted text alone."""
    atoms = [Atom(call.name, call.arguments) for call in prompt.calls("Statements")]
    labels = parse_labels(prompt.quotation, atoms).labels
    return "\n".join(f"{atom}: {_LABELS[labels.get(atom)]}" for atom in atoms)


def _verdicts(
    prompt: PromptText, sight: Sight | None, judgement: Judgement
) -> Iterator[tuple[WrittenCall, bool | None]]:
    statements = prompt.calls("Statements")
    meanings = _understandings(prompt, sight, statements) if sight else {}
    for call in statements:
        meaning = meanings.get(call.name)
        if sight is None or meaning is None or len(meaning.order) != len(call.arguments):
            yield call, None
        else:
            yield call, judgement.truth(meaning.concept, sight, meaning.arranged(call.arguments))


def _understandings(
    prompt: PromptText, sight: Sight, statements: Sequence[WrittenCall]
) -> dict[str, Understanding]:
    """What the predicates of the statements mean; those not understood are left out."""
    kinds: dict[str, tuple[str, ...]] = {}
    for call in statements:
        if call.name not in kinds and all(name in sight.scene for name in call.arguments):
            kinds[call.name] = tuple(sight.scene.kind(name) for name in call.arguments)
    places = sight.scene.names("station")
    meanings = {}
    for predicate in prompt.predicates("Predicates"):
        if predicate.name in kinds:
            found = understand(predicate.name, kinds[predicate.name], predicate.semantics, places)
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
