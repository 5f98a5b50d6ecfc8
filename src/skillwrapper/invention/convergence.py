"""When to stop: an iteration brought nothing that the model before it did not know."""

from __future__ import annotations

import numpy as np

from skillwrapper.grounding import TRUE, UNKNOWN
from skillwrapper.invention.fitter import Fitter
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.predictions import TablePrediction, predict


class Convergence:
    """Holds the model of an iteration against what the next one recorded.

    Args:
        fitter: learns operators, and holds the data.
    """

    def __init__(self, fitter: Fitter) -> None:
        self._fitter = fitter
        self._before: Fit | None = None
        self._size = 0

    def remember(self, fit: Fit) -> None:
        """Note what an iteration ended with."""
        self._before, self._size = fit, len(self._fitter.recorded)

    def is_reached(self) -> bool:
        """Whether what was recorded since brought no new inconsistency and no surprise.

        To be asked after new data came in, before anything is invented from them. Asks the model
        nothing that learning from the new data would not ask anyway.
        """
        if self._before is None:
            return False
        now = self._fitter.fit(self._before.predicates)
        known = {i.identity for i in self._before.inconsistencies}
        if any(i.identity not in known for i in now.inconsistencies):
            return False
        return self.held_back_errors() == 0

    def held_back_errors(self) -> int:
        """How many new transitions the model from before them predicts wrongly.

        Transitions that hang on an unknown label are left out (D10).
        """
        before = self._before
        if before is None:
            return 0
        errors = 0
        transitions = self._fitter.labeller.label(before.predicates)
        for name, fit in before.skills.items():
            data = transitions.of_skill(name)
            new = tuple(table.select(table.ids >= self._size) for table in data)
            errors += sum(map(_wrong, predict(new, fit.operators)))
        return errors


def _wrong(prediction: TablePrediction) -> int:
    """Transitions whose success or whose change is predicted wrongly."""
    executable, success = prediction.executable, prediction.table.success
    wrong = (executable != UNKNOWN) & ((executable == TRUE) != success)
    return int(np.count_nonzero(wrong | prediction.mistaken))
