"""What is learned accounts for what was recorded, whatever was recorded."""

from __future__ import annotations

from hypothesis import given
from notebook import Notebook
from random_worlds import QUICK, notebooks

from skillwrapper.learning.certification import Violation, certify
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.kinds import InconsistencyKind


def unaccounted(fit: Fit) -> list[Violation]:
    """Violations of Lemma 1 or Theorem 1 by transitions that are in no inconsistency."""
    accounted = {i.culprit for i in fit.inconsistencies}
    return [v for v in certify(fit).violations if v.transition not in accounted]


@QUICK
@given(notebooks())
def test_a_success_lacks_an_operator_only_if_its_change_is_unexplained(notebook: Notebook) -> None:
    fit = notebook.fit()
    unexplained = {
        i.culprit for i in fit.inconsistencies if i.kind is InconsistencyKind.UNEXPLAINED
    }
    lacking = {
        v.transition
        for v in certify(fit).violations
        if v.reason == "no applicable operator makes the change"
    }
    assert lacking <= unexplained


@QUICK
@given(notebooks())
def test_consistent_data_obey_theorem_1(notebook: Notebook) -> None:
    fit = notebook.fit()
    certificate = certify(fit)
    assert certificate.decided == certificate.transitions == len(notebook.recorded)
    assert not [v for v in unaccounted(fit) if v.statement == "theorem1"]


@QUICK
@given(notebooks(unknowns=True))
def test_also_with_unknown_labels(notebook: Notebook) -> None:
    assert not [v for v in unaccounted(notebook.fit()) if v.statement == "theorem1"]


@QUICK
@given(notebooks())
def test_consistent_data_obey_lemma_1(notebook: Notebook) -> None:
    """Unless a condition is on an effect context that stood in no relation before."""
    fit = notebook.fit()
    skill = {v.skill for v in unaccounted(fit) if v.statement == "lemma1"}
    for name in skill:
        arity = len(notebook.domain.skill_by_name[name].parameters)
        clusters = [o.cluster for o in fit.skills[name].operators]
        assert any(len(c.groups[0].lifting.objects) > arity for c in clusters)
