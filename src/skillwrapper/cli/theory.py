"""``skillwrapper theory``: what can be said of a model beyond the recorded data."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from skillwrapper.cli.output import JsonFlag, print_json, results
from skillwrapper.domains.discovery import find_domain
from skillwrapper.errors import ConfigurationError
from skillwrapper.evaluation.theory.held_back import HeldBackError, held_back_error
from skillwrapper.evaluation.theory.hypotheses import HypothesisClass, SampleSize, sample_size
from skillwrapper.runs.archive import RunArchive
from skillwrapper.world.domain import Domain


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command(name="theory")(theory)


def theory(
    target: Annotated[str, typer.Argument(help="A run's folder, or a domain.")],
    epsilon: Annotated[float, typer.Option(help="Wanted error, above 0 and below 1.")] = 0.05,
    delta: Annotated[
        float, typer.Option(help="Probability of failing, above 0 and below 1.")
    ] = 0.05,
    predicates: Annotated[
        int | None, typer.Option(min=1, help="At most so many. Default: the run's, or 10.")
    ] = None,
    arity: Annotated[int, typer.Option(min=0, help="Of a predicate, at most.")] = 2,
    operators: Annotated[
        int | None,
        typer.Option(min=1, help="Of a skill, at most. Default: the paper's own bound."),
    ] = None,
    mixing: Annotated[
        float | None,
        typer.Option(
            help="How fast transitions forget each other: b of e^(-b k). Default: at once."
        ),
    ] = None,
    as_json: JsonFlag = False,
) -> None:
    """The paper's sample size, said in plain words, and the error on held-back episodes."""
    _check(epsilon, delta, mixing)
    archive = RunArchive.open(Path(target)) if RunArchive.is_one(Path(target)) else None
    domain = archive.domain() if archive else find_domain(target).domain
    known = len(archive.latest().model.predicates) if archive else 10
    hypotheses = _hypotheses(domain, predicates or known, arity, operators)
    size = sample_size(hypotheses, epsilon, delta, mixing)
    error = held_back_error(archive, 1 - delta) if archive else None
    if as_json:
        print_json(_to_json(hypotheses, size, error))
    else:
        _print(hypotheses, size, error, epsilon, delta)


def _check(epsilon: float, delta: float, mixing: float | None) -> None:
    for name, value in (("epsilon", epsilon), ("delta", delta)):
        if not 0 < value < 1:
            raise ConfigurationError(
                f"--{name}: expected a number above 0 and below 1, got {value}"
            )
    if mixing is not None and not mixing > 0:
        raise ConfigurationError(f"--mixing: expected a number above 0, got {mixing}")


def _hypotheses(
    domain: Domain, predicates: int, arity: int, operators: int | None
) -> HypothesisClass:
    objects = max(len(scene.objects) for scene in domain.scenes.values())
    return HypothesisClass(predicates, arity, objects, len(domain.skills), operators)


def _to_json(
    hypotheses: HypothesisClass, size: SampleSize, error: HeldBackError | None
) -> dict[str, Any]:
    found: dict[str, Any] = {
        "hypotheses": vars(hypotheses),
        "log10_log10_size": float(size.log10_size.log10()),
        "log10_transitions": float(size.log10_transitions),
    }
    if error is not None:
        found["held_back"] = {
            **vars(error),
            "interval": list(error.interval),
            "at_most": error.at_most,
        }
    return found


def _print(
    hypotheses: HypothesisClass,
    size: SampleSize,
    error: HeldBackError | None,
    epsilon: float,
    delta: float,
) -> None:
    console = results()
    operators = "the paper's bound on" if hypotheses.operators is None else hypotheses.operators
    console.print(
        f"Models of at most {hypotheses.predicates} predicates of at most {hypotheses.arity} "
        f"parameters, over {hypotheses.objects} objects and {hypotheses.skills} skills, with at "
        f"most {operators} operators a skill: log10 of their number is {size.log10_size:.3g}."
    )
    console.print(
        f"For an error of at most {epsilon} but with probability {delta}, "
        f"10^{size.log10_transitions:.3g} transitions suffice by the paper's bound. "
        f"{_judged(size)}"
    )
    if error is not None:
        low, high = error.interval
        console.print(
            f"Held-back episodes: {error.wrong} of {error.tried} predictions wrong"
            f" ({error.undecided} undecided), a true error between {low:.4f} and {high:.4f} with "
            f"probability {error.confidence:g}, if transitions were independent and the vocabulary "
            "were given."
        )
    if error is not None and error.wrong_as_read is not None:
        console.print(
            "These labels are decoded, and lean towards the model. Beside the labels as they were "
            f"read {error.wrong_as_read} of {error.tried_as_read} predictions are wrong, every "
            f"misreading included: the true error is at most {error.at_most:.4f}."
        )


_LOG_OF_A_LIFE = 6
"""Nobody makes more than a million executions."""


def _judged(size: SampleSize) -> str:
    if size.log10_transitions > _LOG_OF_A_LIFE:
        return "That is vacuous: no robot will ever make so many."
    return "That can be made."
