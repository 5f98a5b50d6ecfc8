"""The certificate (D15): each kind of violation, and what is no violation."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest
from notebook import Notebook, make_domain

from skillwrapper.learning.certification import Certificate, certify
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.predictions import predict
from skillwrapper.symbols import Operator, Predicate

KITCHEN = make_domain(
    types={"robot": (), "item": (), "place": ()},
    objects={"r": "robot", "a": "item", "b": "item", "x": "place", "y": "place"},
    skills={"Take": "robot item", "Drop": "robot item", "Wave": "robot"},
)
EMPTY = Predicate("empty", ("robot",))
HELD = Predicate("held", ("item",))
FREE = Predicate("free", ("place",))
ON = Predicate("on", ("item", "place"))


def violations(certificate: Certificate) -> set[tuple[int, str]]:
    return {(v.transition, v.reason) for v in certificate.violations}


def consistent() -> Notebook:
    notebook = Notebook(KITCHEN, EMPTY, HELD)
    notebook.success("empty(r)", "Take(r, a)", "held(a)")
    notebook.success("held(a)", "Drop(r, a)", "empty(r)")
    notebook.failure("held(a)", "Take(r, b)")
    return notebook


def test_nothing_wrong() -> None:
    certificate = certify(consistent().fit())
    assert certificate == Certificate(
        transitions=3, decided=3, undecided=0, no_ops=0, violations=()
    )
    assert json.loads(json.dumps(certificate.to_json())) == {
        "transitions": 3,
        "decided": 3,
        "undecided": 0,
        "no_ops": 0,
        "violations": [],
        "lemma1_violations": 0,
        "theorem1_violations": 0,
        "explained": 1.0,
        "left_out": [],
    }


def test_same_lifted_start() -> None:
    notebook = Notebook(KITCHEN, HELD)
    notebook.success("", "Take(r, a)", "held(a)")
    notebook.failure("held(a)", "Take(r, b)")
    certificate = certify(notebook.fit())
    assert violations(certificate) == {
        (1, "same lifted start"),
        (1, "an operator applies to a failure"),
    }
    (lemma,) = (v for v in certificate.violations if v.statement == "lemma1")
    assert (lemma.skill, lemma.partner) == ("Take", 0)
    assert (certificate.count("lemma1"), certificate.count("theorem1")) == (1, 1)


def test_same_lifted_change() -> None:
    notebook = Notebook(KITCHEN, EMPTY, HELD)
    notebook.success("empty(r)", "Take(r, a)", "empty(r) held(a)")
    notebook.failure("", "Take(r, b)", "held(b)")
    certificate = certify(notebook.fit())
    assert violations(certificate) == {
        (1, "same lifted change"),
        (1, "an operator makes the change of a failure"),
    }


def test_no_applicable_operator_makes_the_change() -> None:
    """The full abstract change counts, the unexplained part too."""
    notebook = Notebook(KITCHEN, HELD, FREE)
    notebook.success("", "Take(r, a)", "held(a) free(x)")
    assert violations(certify(notebook.fit())) == {(0, "no applicable operator makes the change")}


@pytest.mark.parametrize("forget", ["preconditions", "add_effects", "operators"])
def test_a_model_that_was_tampered_with(forget: str) -> None:
    fit = tampered(consistent().fit(), forget)
    expected = {
        "preconditions": {(2, "an operator applies to a failure")},
        "add_effects": {(0, "no applicable operator makes the change")},
        "operators": {(0, "no applicable operator makes the change")},
    }
    assert violations(certify(fit)) == expected[forget]


def tampered(fit: Fit, forget: str) -> Fit:
    """The fit with a part of the operator of Take taken away."""

    def less(operator: Operator) -> Operator:
        return operator if forget == "operators" else replace(operator, **{forget: frozenset()})

    take = fit.skills["Take"]
    learned = () if forget == "operators" else take.operators
    operators = tuple(replace(o, operator=less(o.operator)) for o in learned)
    data = tuple(p.table for p in take.predictions)
    changed = replace(take, operators=operators, predictions=predict(data, operators))
    return Fit(
        fit.domain, fit.predicates, lambda s: changed if s.name == "Take" else fit.skill(s.name)
    )


def test_operators_of_other_skills_do_not_count() -> None:
    """As printed, over all operators, Theorem 1 is false: Drop undoes what Take failed to do."""
    notebook = consistent()
    notebook.failure("held(a)", "Wave(r)", "empty(r)")
    notebook.success("empty(r)", "Wave(r)", "")
    assert certify(notebook.fit()).violations == ()


def test_no_ops_are_counted_and_exempt() -> None:
    """D7: taking what is held already looks like a failure, but other takes tell the change."""
    notebook = consistent()
    notebook.success("held(a) #1", "Take(r, a)", "held(a) #2")
    notebook.failure("", "Take(r, a)")
    certificate = certify(notebook.fit())
    assert certificate.violations == ()
    assert (certificate.no_ops, certificate.decided) == (1, 5)


def test_a_skill_that_never_showed_a_change_has_no_no_ops() -> None:
    """Equal pictures are no excuse: it is the predicate for what it does that may be missing."""
    notebook = consistent()
    notebook.success("empty(r)", "Wave(r)", "empty(r)")
    notebook.failure("", "Wave(r)")
    certificate = certify(notebook.fit())
    assert certificate.no_ops == 0
    assert violations(certificate) == {
        (4, "same lifted change"),
        (4, "an operator makes the change of a failure"),
    }


def test_what_the_robot_knows_to_be_unchanged_is_a_no_op() -> None:
    notebook = consistent()
    notebook.success("empty(r)", "Wave(r)", "empty(r)", changed=False)
    notebook.failure("", "Wave(r)")
    certificate = certify(notebook.fit())
    assert (certificate.violations, certificate.no_ops) == ((), 1)


def test_undecided_transitions_are_counted_apart() -> None:
    notebook = consistent()
    notebook.success("empty(r)", "Take(r, a)", "?held(a)")
    notebook.failure("?empty(r)", "Take(r, a)")
    certificate = certify(notebook.fit())
    assert (certificate.transitions, certificate.decided, certificate.undecided) == (5, 3, 2)
    assert certificate.violations == ()


def test_a_start_that_is_not_known_is_compared_with_none() -> None:
    """Lemma 1 compares what is beside an argument too, though no operator asks for it here."""
    for mark, lemma in (("", 1), ("?", 0)):
        notebook = Notebook(KITCHEN, HELD, ON, FREE)
        notebook.success("on(a, x)", "Take(r, a)", "on(a, x) held(a)")
        notebook.success("on(a, x) free(x)", "Take(r, a)", "on(a, x) free(x) held(a)")
        notebook.failure(f"on(a, x) {mark}free(x)", "Take(r, a)")
        certificate = certify(notebook.fit())
        assert certificate.count("theorem1") == 1
        assert certificate.count("lemma1") == lemma
