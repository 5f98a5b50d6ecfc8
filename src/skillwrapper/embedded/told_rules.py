"""What a prompt tells of the skills, and imagining with it what a skill would do.

These rules are what the run has learned so far, right or wrong; none is built in.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from skillwrapper.embedded.lexicon import understand
from skillwrapper.embedded.noise import Judgement
from skillwrapper.embedded.prompt_text import PromptText, WrittenCall
from skillwrapper.embedded.sight import Sight

_HEAD = re.compile(r"^- ([\w-]+): ([\w-]+)\(([^()]*)\)(?: with (.*))?$")
_VARIABLE = re.compile(r"(\?[\w-]+)(?:: ([\w-]+(?: and [\w-]+)*))?")
_CONDITION = re.compile(r"(?:no other ([^:()]+): )?(not )?([\w-]+)\(([^()]*)\)")
_EACH = re.compile(r"every other (\?[\w-]+) with (.*?): (not )?([\w-]+)\(([^()]*)\)(?=, |$)")

MANY = 2
"""So many needs that are not met leave little hope that a skill works."""

Facts = frozenset[WrittenCall]
Binding = Mapping[str, str]
Objects = Mapping[str, frozenset[str]]


@dataclass(frozen=True)
class ToldCondition:
    """Something that must hold, must not hold, or must hold of no other object.

    Attributes:
        atom: what is spoken of, with variables.
        positive: whether it must hold.
        others: variables that stand for any other object.
        sure: whether it is said to matter, and not only that it may.
    """

    atom: WrittenCall
    positive: bool
    others: frozenset[str] = frozenset()
    sure: bool = True

    def holds(self, facts: Facts, binding: Binding, objects: Objects) -> bool:
        """Whether it is met."""
        if not self.others:
            return (_bound(self.atom, binding) in facts) is self.positive
        named = set(binding.values())
        return not any(
            fact.name == self.atom.name
            and len(fact.arguments) == len(self.atom.arguments)
            and all(
                given not in named if wanted in self.others else binding.get(wanted) == given
                for wanted, given in zip(self.atom.arguments, fact.arguments, strict=True)
            )
            for fact in facts
        )


@dataclass(frozen=True)
class ToldTypes:
    """Types that what stands for a variable may need to have.

    Attributes:
        variable: the variable.
        types: the types.
        sure: always False; types that are sure are written with the variables.
    """

    variable: str
    types: tuple[str, ...]
    sure: bool = False

    def holds(self, facts: Facts, binding: Binding, objects: Objects) -> bool:
        """Whether it is met."""
        return objects.get(binding[self.variable], frozenset()).issuperset(self.types)


ToldNeed = ToldCondition | ToldTypes
Doubt = tuple[str, ToldNeed]
"""A need that only may matter, with the name of its rule."""


@dataclass(frozen=True)
class Imagined:
    """What a rule says of a call.

    Attributes:
        unmet: how many of its needs are not met, at best; from ``MANY`` on not counted further.
        facts: what is true afterwards, if the call works all the same.
        doubts: needs that only may matter, each unmet alone under some binding.
    """

    unmet: int
    facts: Facts
    doubts: tuple[Doubt, ...] = ()


@dataclass(frozen=True)
class ToldChange:
    """What becomes true or false, for the rule's objects or for each other one.

    Attributes:
        atom: what changes, with variables.
        becomes: whether it is true afterwards.
        each: the variable that stands for every other object; empty for none.
        when: what must hold of that object.
    """

    atom: WrittenCall
    becomes: bool
    each: str = ""
    when: tuple[ToldCondition, ...] = ()


@dataclass(frozen=True)
class ToldRule:
    """One way in which a skill is said to work.

    Attributes:
        name: of the rule.
        skill: name of the skill.
        variables: its own parameters first, then others, with the types they must have.
        arity: how many of the variables are the skill's own parameters.
        needs: what must hold.
        changes: what changes.
    """

    name: str
    skill: str
    variables: tuple[tuple[str, tuple[str, ...]], ...]
    arity: int
    needs: tuple[ToldNeed, ...]
    changes: tuple[ToldChange, ...]

    def imagine(self, call: WrittenCall, facts: Facts, objects: Objects) -> Imagined:
        """What is to be expected of a call where certain facts are true."""
        best = Imagined(MANY, facts)
        doubts: dict[Doubt, None] = {}
        for binding in self._bindings(call, objects):
            unmet = self._unmet(facts, binding, objects)
            if len(unmet) < best.unmet:
                best = Imagined(len(unmet), self._changed(facts, binding, objects))
            if not unmet:
                return best
            if len(unmet) == 1 and not unmet[0].sure:
                doubts[self.name, unmet[0]] = None
        return replace(best, doubts=tuple(doubts))

    def _unmet(self, facts: Facts, binding: Binding, objects: Objects) -> list[ToldNeed]:
        unmet = (need for need in self.needs if not need.holds(facts, binding, objects))
        return list(itertools.islice(unmet, MANY))

    def _bindings(self, call: WrittenCall, objects: Objects) -> Iterator[Binding]:
        fixed = [(name,) for name in call.arguments]
        free = [
            tuple(name for name, has in objects.items() if has.issuperset(types))
            for _, types in self.variables[self.arity :]
        ]
        for chosen in itertools.product(*fixed, *free):
            fits = all(
                objects.get(name, frozenset()).issuperset(types)
                for name, (_, types) in zip(chosen, self.variables, strict=False)
            )
            if fits and len(set(chosen)) == len(chosen) == len(self.variables):
                yield dict(zip((name for name, _ in self.variables), chosen, strict=True))

    def _changed(self, facts: Facts, binding: Binding, objects: Objects) -> Facts:
        following = set(facts)
        for change in self.changes:
            others = [name for name in objects if name not in binding.values()]
            for extra in ({change.each: name} for name in others) if change.each else ({},):
                wider = {**binding, **extra}
                if all(condition.holds(facts, wider, objects) for condition in change.when):
                    atom = _bound(change.atom, wider)
                    (following.add if change.becomes else following.discard)(atom)
        return frozenset(following)


def told_rules(lines: Sequence[str]) -> tuple[ToldRule, ...]:
    """The rules in a section of a prompt; what is written otherwise is passed over."""
    blocks: list[list[str]] = []
    for line in lines:
        if line.startswith("- "):
            blocks.append([line])
        elif line.startswith("  ") and blocks:
            blocks[-1].append(line.strip())
    return tuple(rule for block in blocks if (rule := _read_rule(block)) is not None)


def seen_facts(prompt: PromptText, sight: Sight | None, judgement: Judgement) -> Facts:
    """What the known predicates say of the picture."""
    if sight is None:
        return frozenset()
    facts = set()
    places = sight.scene.names("station")
    for predicate in prompt.predicates("Known predicates"):
        for names in itertools.permutations(prompt.objects, len(predicate.types)):
            if all(t in prompt.objects[n] for t, n in zip(predicate.types, names, strict=True)):
                kinds = tuple(sight.scene.kind(name) for name in names)
                meant = understand(predicate.name, kinds, predicate.semantics, places)
                if meant and judgement.truth(meant.concept, sight, meant.arranged(names)):
                    facts.add(WrittenCall(predicate.name, names))
    return frozenset(facts)


def _read_rule(block: Sequence[str]) -> ToldRule | None:
    head = _HEAD.match(block[0])
    if head is None:
        return None
    own, context = (_variables(head.group(part) or "") for part in (3, 4))
    needs: list[ToldNeed] = []
    changes: list[ToldChange] = []
    for line in block[1:]:
        if line.startswith("needs "):
            needs += _conditions(line)
        elif line.startswith("may need "):
            needs += [replace(condition, sure=False) for condition in _conditions(line)]
            needs += [ToldTypes(*variable) for variable in _types(line)]
        elif line.startswith(("makes true ", "makes false ")):
            becomes = line.startswith("makes true ")
            changes += [ToldChange(c.atom, becomes) for c in _conditions(line)]
        elif line.startswith("changes "):
            changes += _changes(line)
    unsure = {need.variable for need in needs if isinstance(need, ToldTypes)}
    variables = tuple((name, () if name in unsure else types) for name, types in own + context)
    return ToldRule(head.group(1), head.group(2), variables, len(own), tuple(needs), tuple(changes))


def _types(text: str) -> tuple[tuple[str, tuple[str, ...]], ...]:
    """``?item: cookable and small`` in a list of needs."""
    return tuple((name, types) for name, types in _variables(_CONDITION.sub("", text)) if types)


def _variables(text: str) -> tuple[tuple[str, tuple[str, ...]], ...]:
    return tuple(
        (name, tuple(types.split(" and ")) if types else ())
        for name, types in _VARIABLE.findall(text)
    )


def _conditions(text: str) -> list[ToldCondition]:
    return [
        ToldCondition(_atom(name, terms), not negated, frozenset(_VARIABLE_NAMES(others)))
        for others, negated, name, terms in _CONDITION.findall(text)
    ]


def _changes(text: str) -> list[ToldChange]:
    return [
        ToldChange(_atom(name, terms), not negated, each, tuple(_conditions(when)))
        for each, when, negated, name, terms in _EACH.findall(text)
    ]


_VARIABLE_NAMES = re.compile(r"\?[\w-]+").findall


def _atom(name: str, terms: str) -> WrittenCall:
    return WrittenCall(name, tuple(term.strip() for term in terms.split(",") if term.strip()))


def _bound(atom: WrittenCall, binding: Binding) -> WrittenCall:
    return WrittenCall(atom.name, tuple(binding.get(term, term) for term in atom.arguments))
