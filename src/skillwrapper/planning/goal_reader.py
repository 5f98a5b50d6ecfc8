"""From the outer form of a goal's text to a formula whose names and types are right."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from skillwrapper.errors import GoalError, UnknownNameError
from skillwrapper.grounding import AtomSpace
from skillwrapper.planning.goal_formulas import (
    Condition,
    Equality,
    Formula,
    Junction,
    Negation,
    Quantification,
)
from skillwrapper.planning.goal_text import Group, Node, Place, Word, goal_error, read_group
from skillwrapper.symbols.predicates import Atom, Predicate

_AND, _OR, _NOT, _COMMA = "and", "or", "not", ","
_JOINTS = (_AND, _OR, _COMMA)
_HEADS = ("imply", "forall", "exists", "=", ":goal")
_UNSUPPORTED = frozenset(
    (
        *("define", "when", "preference", "at", "either", "oneof", "increase", "decrease"),
        *("assign", "always", "sometime", "within", "at-most-once", "sometime-after"),
        *("sometime-before", "hold-during", "hold-after", "<", ">", "<=", ">=", "+", "-", "*", "/"),
    )
)
"""Words of PDDL that are no names of predicates, unless a model has one of this name."""

Scope = Mapping[str, tuple[str, ...]]
"""Variables with the names of the objects that they can stand for."""


class GoalReader:
    """Reads goals over a scene; names are looked up as they are, then whatever their case.

    Args:
        space: the ground atoms of the scene.
        types: declared types, also those that no object of the scene has.
    """

    def __init__(self, space: AtomSpace, types: Iterable[str] = ()) -> None:
        self._predicates = {p.name: p for p in space.predicates}
        self._objects = {o.name: o for o in space.objects}
        known = {t for o in space.objects for t in o.types}
        self._types = sorted(known.union(types, *(p.types for p in space.predicates)))

    def read(self, text: str) -> Formula:
        """The formula of a text.

        Raises:
            GoalError: if it is none, or an atom has arguments of the wrong number or types.
            UnknownNameError: if there is no such predicate, object or type.
        """
        whole = read_group(text)
        if not whole.items:
            raise goal_error(whole.place, "a literal", "nothing")
        return self._list(whole, {}, in_parentheses=False)

    def _list(self, group: Group, scope: Scope, *, in_parentheses: bool = True) -> Formula:
        """A form of PDDL, which its first word tells, or conditions one after the other."""
        if not group.items:
            raise goal_error(group.place, "a literal", "nothing")
        head, *rest = group.items
        keyword = self._keyword(group.items, 0)
        if isinstance(head, Word) and keyword in (_AND, _OR, *_HEADS):
            if not rest:
                raise goal_error(head.place, "a literal", "nothing")
            return self._form(keyword, head, rest, scope)
        if isinstance(head, Word) and not keyword and in_parentheses and _begins_names(rest):
            return self._condition(head, rest, scope)
        return self._joined(group.items, _AND, scope)

    def _form(self, keyword: str, head: Word, rest: Sequence[Node], scope: Scope) -> Formula:
        """What a keyword at the head of a list makes of the rest."""
        match keyword:
            case "imply":
                first, second = self._two_parts(head, _arguments(rest), scope)
                return Junction(False, (Negation(first), second))
            case "forall" | "exists":
                return self._quantification(head, rest, scope)
            case "=":
                return self._equality(head, rest, scope)
            case ":goal":
                return self._joined(rest, _AND, scope)
            case _:
                return self._joined(_arguments(rest), keyword, scope)

    def _joined(self, items: Sequence[Node], usual: str, scope: Scope) -> Formula:
        """Conditions with commas, ``and`` or ``or`` between them, or nothing.

        Args:
            items: what is read.
            usual: what joins them where no word says it.
            scope: the variables.
        """
        parts, joints, position = [], set(), 0
        while True:
            negated = self._keyword(items, position) == _NOT
            part, position = self._term(items, position, scope)
            parts.append(part)
            if position == len(items):
                break
            start, joint = position, usual
            while (keyword := self._keyword(items, position)) in _JOINTS:
                joint = joint if keyword == _COMMA else keyword
                position += 1
            if negated and start == position:
                raise goal_error(items[position].place, "one literal after 'not'", "more")
            joints.add(joint)
            if len(joints) > 1:
                raise goal_error(
                    items[start].place, "parentheses around what belongs together", "and with or"
                )
        return parts[0] if len(parts) == 1 else Junction(joints == {_AND}, tuple(parts))

    def _term(self, items: Sequence[Node], position: int, scope: Scope) -> tuple[Formula, int]:
        """One condition, and the position after it."""
        positive = True
        while self._keyword(items, position) == _NOT:
            positive, position = not positive, position + 1
        if position >= len(items):
            raise goal_error(items[-1].place, "a literal", "the end")
        formula, position = self._positive_term(items, position, scope)
        return (formula if positive else Negation(formula)), position

    def _positive_term(
        self, items: Sequence[Node], position: int, scope: Scope
    ) -> tuple[Formula, int]:
        node, after = items[position], items[position + 1 : position + 2]
        if isinstance(node, Group):
            return self._list(node, scope), position + 1
        keyword = self._keyword(items, position)
        if keyword in _HEADS:
            raise goal_error(node.place, f"parentheses around '{node.text} ...'", "none")
        if keyword:
            raise goal_error(node.place, "a literal", node.text)
        if after and isinstance(after[0], Group):
            return self._condition(node, after[0].items, scope), position + 2
        return self._condition(node, (), scope), position + 1

    def _two_parts(
        self, head: Word, items: Sequence[Node], scope: Scope
    ) -> tuple[Formula, Formula]:
        first, position = self._term(items, 0, scope)
        if self._keyword(items, position) == _COMMA:
            position += 1
        if position == len(items):
            raise goal_error(head.place, f"two conditions after '{head.text}'", "one")
        second, position = self._term(items, position, scope)
        if position < len(items):
            raise goal_error(items[position].place, f"two conditions after '{head.text}'", "more")
        return first, second

    def _quantification(self, head: Word, rest: Sequence[Node], scope: Scope) -> Formula:
        variables, *body = rest
        if not isinstance(variables, Group) or not variables.items:
            raise goal_error(head.place, f"(?x - type) after '{head.text}'", "no variables")
        choices = self._choices(variables)
        if not body:
            raise goal_error(head.place, "one condition after the variables", "none")
        part, position = self._term(body, 0, {**scope, **choices})
        if position < len(body):
            raise goal_error(body[position].place, "one condition after the variables", "more")
        return Quantification(head.lower == "forall", tuple(choices.items()), part)

    def _choices(self, variables: Group) -> dict[str, tuple[str, ...]]:
        """The objects for each variable of ``(?x ?y - type ?z - (either type type))``."""
        choices: dict[str, tuple[str, ...]] = {}
        waiting: list[str] = []
        nodes = iter(variables.items)
        for node in nodes:
            if isinstance(node, Word) and node.text == "-":
                names = self._objects_of(next(nodes, None), node.place)
                choices |= dict.fromkeys(waiting, names)
                waiting = []
            elif isinstance(node, Word) and node.text.startswith("?"):
                waiting.append(node.lower)
            elif not isinstance(node, Word) or node.text != _COMMA:
                raise goal_error(node.place, "a variable such as ?x", _shown(node))
        return choices | dict.fromkeys(waiting, tuple(self._objects))

    def _objects_of(self, node: Node | None, place: Place) -> tuple[str, ...]:
        """The objects of a type, or of one of several: ``(either type type)``."""
        names = node.items[1:] if isinstance(node, Group) else [node]
        types = set()
        for name in names:
            if not isinstance(name, Word):
                raise goal_error(place, "a type after '-'", "none")
            if name.lower == "object" and "object" not in self._types:
                return tuple(self._objects)
            types.add(_look_up("type", name, self._types))
        return tuple(o.name for o in self._objects.values() if types.intersection(o.types))

    def _equality(self, head: Word, rest: Sequence[Node], scope: Scope) -> Formula:
        terms = self._terms(_arguments(rest), scope)
        if len(terms) != 2:
            raise goal_error(head.place, "two objects after '='", str(len(terms)))
        return Equality(*terms)

    def _condition(self, head: Word, arguments: Sequence[Node], scope: Scope) -> Formula:
        """An atom that is one of the scene, or can be with objects for its variables."""
        predicate = self._predicates[self._predicate_name(head)]
        terms = self._terms(arguments, scope)
        atom = Atom(predicate.name, terms)
        if len(terms) != predicate.arity:
            raise GoalError(
                f"goal, {head.place}: expected {predicate.arity} argument(s) as in "
                f"{predicate.signature}, got {len(terms)} in {atom}"
            )
        self._check_types(head.place, atom, predicate, scope)
        if len(set(terms)) < len(terms):
            raise GoalError(f"goal, {head.place}: expected different objects in {atom}")
        return Condition(atom)

    def _predicate_name(self, head: Word) -> str:
        try:
            return _look_up("predicate", head, self._predicates)
        except UnknownNameError:
            if head.lower in _UNSUPPORTED or head.text.startswith((":", "?")):
                raise GoalError(
                    f"goal, {head.place}: '{head.text}' is not supported in goals; use and, or, "
                    f"not, imply, forall, exists, = and predicates"
                ) from None
            raise

    def _check_types(self, place: Place, atom: Atom, predicate: Predicate, scope: Scope) -> None:
        for term, wanted in zip(atom.terms, predicate.types, strict=True):
            for name in scope.get(term, (term,)):
                types = self._objects[name].types
                if wanted in types:
                    continue
                fitting = [o.name for o in self._objects.values() if wanted in o.types]
                got = f"got '{name}' ({', '.join(types)})"
                hint = f"there are: {', '.join(fitting) or 'none'}"
                if term in scope:
                    got, hint = f"{got} for {term}", f"write ({term} - {wanted})"
                raise GoalError(f"goal, {place}: expected a {wanted} in {atom}, {got}; {hint}")

    def _terms(self, nodes: Sequence[Node], scope: Scope) -> tuple[str, ...]:
        terms = []
        for node in nodes:
            if not isinstance(node, Word):
                raise goal_error(node.place, "an object", "(")
            if node.text == _COMMA:
                continue
            if node.text.startswith("?"):
                if node.lower not in scope:
                    raise goal_error(node.place, "a variable of a forall or exists", node.text)
                terms.append(node.lower)
            else:
                terms.append(_look_up("object", node, self._objects))
        return tuple(terms)

    def _keyword(self, items: Sequence[Node], position: int) -> str:
        """The keyword at a position; empty for a name, also a predicate's before an object."""
        word = items[position] if position < len(items) else None
        if not isinstance(word, Word) or word.lower not in (*_JOINTS, _NOT, *_HEADS):
            return ""
        after = items[position + 1] if position + 1 < len(items) else None
        if isinstance(after, Group):
            after = after.items[0] if after.items else None
        names_an_object = isinstance(after, Word) and after.text in self._objects
        return "" if word.text in self._predicates and names_an_object else word.lower


def _begins_names(rest: Sequence[Node]) -> bool:
    """Whether what follows a name are names that it is said of, as in ``(on cup shelf)``."""
    return bool(rest) and isinstance(rest[0], Word) and rest[0].lower not in _JOINTS


def _arguments(rest: Sequence[Node]) -> Sequence[Node]:
    """What follows a keyword, also where it is written like a function: ``or(..., ...)``."""
    first, *others = rest
    if others or isinstance(first, Word):
        return rest
    is_function = any(isinstance(item, Word) and item.text == _COMMA for item in first.items)
    return first.items if is_function else rest


def _look_up(kind: str, word: Word, known: Iterable[str]) -> str:
    names = tuple(known)
    if word.text in names:
        return word.text
    alike = [name for name in names if name.lower() == word.lower]
    if len(alike) == 1:
        return alike[0]
    raise UnknownNameError(kind, word.text, names, f"goal, {word.place}")


def _shown(node: Node) -> str:
    return node.text if isinstance(node, Word) else "("
