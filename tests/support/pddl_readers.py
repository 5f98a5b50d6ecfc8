"""Independent readers of PDDL: the ``pddl`` library, unified-planning, and K*'s translator.

The translator is Fast Downward's. It runs in a process of its own, because its modules have names
that others have, too, and takes many files at once, because starting it takes long.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import warnings
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import Any

import kstar_planner
from pddl.parser.domain import DomainParser
from pddl.parser.problem import ProblemParser
from unified_planning.io import PDDLReader

Texts = tuple[str, str]
"""A domain and a problem."""

TRANSLATOR = Path(kstar_planner.__file__).parent / "builds/release/bin/translate"
READ_ALL = f"""
import sys
folder, sys.argv = sys.argv[1], ["translate", "domain", "problem"]
sys.path.insert(0, {str(TRANSLATOR)!r})
from pathlib import Path
import pddl_parser
for domain in sorted(Path(folder).glob("*.domain")):
    pddl_parser.open(str(domain), str(domain.with_suffix(".problem")))
"""


def read_with_pddl_library(texts: Texts) -> tuple[Any, Any]:
    domain, problem = texts
    parse_domain, parse_problem = _parsers()
    try:
        return parse_domain(domain), parse_problem(problem)
    except BaseException:
        _parsers.cache_clear()  # after an error they are of no further use
        raise


@cache
def _parsers() -> tuple[DomainParser, ProblemParser]:
    return DomainParser(), ProblemParser()


def read_with_unified_planning(texts: Texts) -> Any:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        try:
            return _reader().parse_problem_string(*texts)
        except BaseException:
            _reader.cache_clear()
            raise


@cache
def _reader() -> PDDLReader:
    """Making its grammar takes longer than reading any of our domains."""
    return PDDLReader()


def read_with_translator(many: Iterable[Texts]) -> None:
    with tempfile.TemporaryDirectory() as folder:
        for number, (domain, problem) in enumerate(many):
            Path(folder, f"{number}.domain").write_text(domain, encoding="utf-8")
            Path(folder, f"{number}.problem").write_text(problem, encoding="utf-8")
        done = subprocess.run(
            [sys.executable, "-c", READ_ALL, folder], capture_output=True, text=True, check=False
        )
    assert done.returncode == 0, done.stdout + done.stderr
