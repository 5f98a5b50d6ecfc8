"""Whatever stands between and around the statements: a label is right, or it is missing."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skillwrapper.errors import SymbolError
from skillwrapper.symbols import Atom
from skillwrapper.symbols.predicates import WORDS_OF_LOGIC, parse_predicate
from skillwrapper.vlm.parsing import ParameterNames, parse_labels, parse_predicates

ATOMS = (
    Atom("holding", ("robot", "patty")),
    Atom("holding", ("robot", "lettuce")),
    Atom("is_cut", ("lettuce",)),
    Atom("on_top_of", ("lettuce", "patty")),
    Atom("kitchen_tidy", ()),
)
Truth = dict[Atom, bool | None]
WORDS = {True: "true", False: "false", None: "unsure"}

INLINE: list[Callable[[str, str], str]] = [
    lambda atom, word: f"{atom}: {word}",
    lambda atom, word: f"- **{atom}**: {word.title()}",
    lambda atom, word: f"3. `{atom}` - {word.upper()}.",
    lambda atom, word: f"| {atom} | {word} |",
    lambda atom, word: f"{word}: {atom}",
    lambda atom, word: f"{atom} is {word}, since that is what can be seen.",
    lambda atom, word: f'"{atom}": "{word}",',
    lambda atom, word: f"The statement {atom} → {word}",
    lambda atom, word: f"{atom}\uff1a{word}\u3002",
    lambda atom, word: f"{atom}? {word.title()}.",
]
BELOW: list[Callable[[str, str], list[str]]] = [
    lambda atom, word: [atom, word.title()],
    lambda atom, word: [atom, "", word, ""],
    lambda atom, word: [f"- {atom}", f"  {word}"],
    lambda atom, word: [f"### {atom}", "The picture shows it well.", f"**{word.title()}**", ""],
    lambda atom, word: [f"**{atom}**", f"Verdict: {word}"],
    lambda atom, word: [f"Statement: {atom}", "Reason: it can be seen", f"Label: {word}"],
    lambda atom, word: [f"{atom}:", f"→ {word}"],
]
NOISE = [
    "", "Sure!", "Here are the labels:", "---", "```", "### Results", "1.", "True or false?",
    "The hand is empty, since nothing floats over the head.", "| Statement | Label |",
    "Note: labels may be unsure.", "No problem!", "I see a robot.",
    "<think>holding(robot, patty): true</think>", "Yes, here they are.", "> quote",
    "Each statement is true, false or unsure.", "{", "}", "[", "Let me check each one.",
    "(a) (b)", "Is holding(robot, patty) true?", "Whether is_cut(lettuce) is hard to say.",
    "All done.", "I first look at holding(robot, lettuce) and then at is_cut(lettuce).",
    "Not everything is cut.",
]  # fmt: skip
OTHERS = ["near(robot, stove)", "near(robot, stove): true"]
"""Not beside lone verdicts: "S / false / near(robot, stove) / true" says that S is false."""
VERDICTS = ["True", "Yes.", "false", "**No**", "Unsure", "That is true.", "Answer: true", "✓"]
truths = st.fixed_dictionaries({atom: st.sampled_from([True, False, None]) for atom in ATOMS})


def check(reply: str, truth: Truth) -> None:
    labels = parse_labels(reply, ATOMS).labels
    wrong = {str(atom): label for atom, label in labels.items() if label is not truth[atom]}
    assert not wrong, reply


def headed(truth: Truth, title: str) -> list[str]:
    lines = []
    for label, word in WORDS.items():
        chosen = [f"- {atom}" for atom in ATOMS if truth[atom] is label]
        lines += [title.format(word.title()), *chosen, ""] if chosen else []
    return lines


def with_noise(lines: Sequence[str], noise: Sequence[tuple[float, str]]) -> str:
    """The lines with others at some of the places between them, before them and after them."""
    mixed = list(lines)
    for place, line in noise:
        mixed.insert(round(place * len(mixed)), line)
    return "\n".join(mixed)


def places(lines: Sequence[str]) -> st.SearchStrategy[list[tuple[float, str]]]:
    return st.lists(st.tuples(st.floats(0, 1), st.sampled_from(lines)), max_size=8)


@settings(max_examples=200, deadline=None)
@given(truths, st.permutations(ATOMS), st.data())
def test_statements_with_their_verdicts_on_one_line(
    truth: Truth, order: Sequence[Atom], data: st.DataObject
) -> None:
    manner = st.sampled_from(INLINE)
    lines = [data.draw(manner)(str(atom), WORDS[truth[atom]]) for atom in order]
    check(with_noise(lines, data.draw(places([*NOISE, *VERDICTS]))), truth)


@settings(max_examples=200, deadline=None)
@given(truths, st.permutations(ATOMS), st.sampled_from(BELOW), st.data())
def test_verdicts_below_their_statements(
    truth: Truth,
    order: Sequence[Atom],
    manner: Callable[[str, str], list[str]],
    data: st.DataObject,
) -> None:
    lines = [line for atom in order for line in manner(str(atom), WORDS[truth[atom]])]
    check(with_noise(lines, data.draw(places([*NOISE, *VERDICTS]))), truth)


@settings(max_examples=200, deadline=None)
@given(truths, st.sampled_from(["{}:", "**{}:**", "## {} statements", "{} statements:"]), st.data())
def test_verdicts_above_their_statements(truth: Truth, title: str, data: st.DataObject) -> None:
    check(with_noise(headed(truth, title), data.draw(places([*NOISE, *VERDICTS]))), truth)


@settings(max_examples=200, deadline=None)
@given(truths, st.data())
def test_all_manners_in_one_reply(truth: Truth, data: st.DataObject) -> None:
    manners = st.one_of(
        st.sampled_from(INLINE).map(lambda manner: lambda a, w: [manner(a, w)]),
        st.sampled_from(BELOW),
    )
    lines = [line for atom in ATOMS for line in data.draw(manners)(str(atom), WORDS[truth[atom]])]
    check(with_noise(lines, data.draw(places([*NOISE, *OTHERS]))), truth)


@settings(max_examples=100, deadline=None)
@given(truths, st.permutations(ATOMS), st.integers(0, 400), st.sampled_from(BELOW), st.booleans())
def test_replies_that_break_off(
    truth: Truth,
    order: Sequence[Atom],
    length: int,
    manner: Callable[[str, str], list[str]],
    below: bool,
) -> None:
    lines = [
        line
        for atom in order
        for line in (
            manner(str(atom), WORDS[truth[atom]]) if below else [f"{atom}: {WORDS[truth[atom]]}"]
        )
    ]
    check("\n".join(lines)[:length], truth)


@given(truths, st.permutations(ATOMS), st.data())
def test_every_manner_is_read_where_nothing_else_is_said(
    truth: Truth, order: Sequence[Atom], data: st.DataObject
) -> None:
    inline, below = data.draw(st.sampled_from(INLINE)), data.draw(st.sampled_from(BELOW))
    for lines in (
        [inline(str(atom), WORDS[truth[atom]]) for atom in order],
        [line for atom in order for line in below(str(atom), WORDS[truth[atom]])],
        headed(truth, "**{}:**"),
    ):
        assert parse_labels("\n".join(lines), ATOMS).labels == truth, "\n".join(lines)


@pytest.mark.parametrize("supposing", ["Unless", "If", "Assuming", "When"])
def test_what_follows_from_a_supposition_is_not_claimed(supposing: str) -> None:
    reply = f"{supposing} {ATOMS[0]} is true, {ATOMS[1]}: false. {ATOMS[2]}: true"
    assert parse_labels(reply, ATOMS).labels == {ATOMS[2]: True}


def test_the_other_way_round_is_another_statement() -> None:
    """Where only one of two was asked for, the other one's label once counted for it."""
    asked = Atom("on_top_of", ("lettuce", "patty"))
    parsed = parse_labels("on_top_of(patty, lettuce): false", [asked])
    assert parsed.missing == (asked,)


@pytest.mark.parametrize("name", [*sorted(WORDS_OF_LOGIC), "Not", "AND"])
def test_no_predicate_is_called_like_a_word_of_logic(name: str) -> None:
    """A goal or a label could not name it: ``not(patty)`` says something else."""
    reply = f"{name}(?item): the item is raw.\nis_{name}(?item): the item is raw."
    parsed = parse_predicates(reply, ParameterNames({"item": 1}))
    assert [predicate.name for predicate in parsed.predicates] == [f"is_{name}"]
    assert parsed.unusable == (f"{name}(?item): expected a name of its own, got a word of logic",)
    with pytest.raises(SymbolError, match="word of logic"):
        parse_predicate(f"{name}(?item): the item is raw")
