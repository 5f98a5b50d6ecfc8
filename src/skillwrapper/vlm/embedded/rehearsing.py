"""Running skills in mind: what the prompt says of them, from what the picture shows.

Nothing here knows any skill: without operators in the prompt every skill may work.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from skillwrapper.vlm.embedded.lexicon import understand
from skillwrapper.vlm.embedded.noise import Judgement
from skillwrapper.vlm.embedded.prompt_text import PromptText, WrittenCall, WrittenPredicate
from skillwrapper.vlm.embedded.sight import Sight

_HEAD = re.compile(r"^- [\w-]+: ([\w-]+)\(([^()]*)\)(?: with (.*))?$")
_VARIABLE = re.compile(r"(\?[\w-]+): ([\w-]+(?: and [\w-]+)*)")
_LITERAL = re.compile(r"(no other [^:()]+: |not )?([\w-]+)\(([^()]*)\)")

Facts = frozenset[WrittenCall]
"""The statements that are taken to be true."""

_Binding = dict[str, str]


@dataclass(frozen=True)
class _Rule:
    """An operator as a prompt describes it."""

    variables: tuple[tuple[str, frozenset[str]], ...]
    arity: int
    needed: tuple[WrittenCall, ...]
    excluded: tuple[WrittenCall, ...]
    absent: tuple[WrittenCall, ...]
    added: tuple[WrittenCall, ...]
    removed: tuple[WrittenCall, ...]


class Rehearsal:
    """Knows from the prompt when skills work and what they change.

    Args:
        prompt: a proposal prompt.
        sight: what the picture shows at the start; None if it is not recognised.
        judgement: how statements are judged.
    """

    def __init__(self, prompt: PromptText, sight: Sight | None, judgement: Judgement) -> None:
        self._objects = prompt.objects
        self._rules = _read_rules(prompt.lines("What is known of the skills"))
        self.start = _facts(prompt, sight, judgement) if sight else frozenset()

    def is_known(self, call: WrittenCall) -> bool:
        """Whether the prompt says anything of the skill."""
        return call.name in self._rules

    def outcome(self, facts: Facts, call: WrittenCall) -> Facts | None:
        """The facts afterwards; None if what is known says that the skill does not work."""
        for rule in self._rules.get(call.name, ()):
            for binding in self._bindings(rule, call):
                if _applies(rule, binding, facts):
                    gone = {_bound(c, binding) for c in rule.removed}
                    return (facts - gone) | {_bound(c, binding) for c in rule.added}
        return None

    def _bindings(self, rule: _Rule, call: WrittenCall) -> Iterator[_Binding]:
        own = dict(zip((name for name, _ in rule.variables), call.arguments, strict=False))
        if any(
            not types <= self._objects[own[name]] for name, types in rule.variables[: rule.arity]
        ):
            return
        context = rule.variables[rule.arity :]
        others = [name for name in self._objects if name not in call.arguments]
        for chosen in itertools.permutations(others, len(context)):
            if all(
                types <= self._objects[o] for (_, types), o in zip(context, chosen, strict=True)
            ):
                yield {**own, **dict(zip((name for name, _ in context), chosen, strict=True))}


def _applies(rule: _Rule, binding: _Binding, facts: Facts) -> bool:
    if any(_bound(call, binding) not in facts for call in rule.needed):
        return False
    if any(_bound(call, binding) in facts for call in rule.excluded):
        return False
    return not any(_stands(call, binding, facts) for call in rule.absent)


def _stands(pattern: WrittenCall, binding: _Binding, facts: Facts) -> bool:
    """Whether some other object stands in a relation; variables without a binding are free."""
    taken = set(binding.values())
    return any(
        fact.name == pattern.name
        and all(
            got == binding[want] if want in binding else got not in taken
            for want, got in zip(pattern.arguments, fact.arguments, strict=True)
        )
        for fact in facts
    )


def _bound(call: WrittenCall, binding: Mapping[str, str]) -> WrittenCall:
    return WrittenCall(call.name, tuple(binding.get(a, a) for a in call.arguments))


def _read_rules(lines: Sequence[str]) -> dict[str, tuple[_Rule, ...]]:
    rules: dict[str, tuple[_Rule, ...]] = {}
    blocks: list[list[str]] = []
    for line in lines:
        if _HEAD.match(line):
            blocks.append([line])
        elif blocks:
            blocks[-1].append(line.strip())
    for block in blocks:
        head = _HEAD.match(block[0])
        if head:
            rules[head.group(1)] = (*rules.get(head.group(1), ()), _read_rule(head, block[1:]))
    return rules


def _read_rule(head: re.Match[str], lines: Sequence[str]) -> _Rule:
    own = _VARIABLE.findall(head.group(2))
    variables = [
        (name, frozenset(types.split(" and ")))
        for name, types in (*own, *_VARIABLE.findall(head.group(3) or ""))
    ]
    needs = [found for line in lines if line.startswith("needs") for found in _literals(line)]
    return _Rule(
        variables=tuple(variables),
        arity=len(own),
        needed=tuple(call for sign, call in needs if not sign),
        excluded=tuple(call for sign, call in needs if sign.startswith("not")),
        absent=tuple(call for sign, call in needs if sign.startswith("no other")),
        added=_calls(lines, "makes true"),
        removed=_calls(lines, "makes false"),
    )


def _calls(lines: Sequence[str], title: str) -> tuple[WrittenCall, ...]:
    return tuple(c for line in lines if line.startswith(title) for _, c in _literals(line))


def _literals(line: str) -> list[tuple[str, WrittenCall]]:
    return [
        (sign, WrittenCall(name, tuple(t.strip() for t in terms.split(",") if t.strip())))
        for sign, name, terms in _LITERAL.findall(line)
    ]


def _facts(prompt: PromptText, sight: Sight, judgement: Judgement) -> Facts:
    """What of the known predicates is true in the picture."""
    return frozenset(
        call
        for predicate in prompt.predicates("Known predicates")
        for call in _groundings(prompt, predicate)
        if _is_true(predicate, call, sight, judgement)
    )


def _groundings(prompt: PromptText, predicate: WrittenPredicate) -> Iterator[WrittenCall]:
    for names in itertools.permutations(prompt.objects, len(predicate.types)):
        if all(t in prompt.objects[n] for t, n in zip(predicate.types, names, strict=True)):
            yield WrittenCall(predicate.name, names)


def _is_true(
    predicate: WrittenPredicate, call: WrittenCall, sight: Sight, judgement: Judgement
) -> bool:
    if not all(name in sight.scene for name in call.arguments):
        return False
    kinds = tuple(sight.scene.kind(name) for name in call.arguments)
    meaning = understand(predicate.name, kinds, predicate.semantics, sight.scene.names("station"))
    if meaning is None:
        return False
    return bool(judgement.truth(meaning.concept, sight, meaning.arranged(call.arguments)))
