"""``skillwrapper learn-operators``: operators from labelled transitions, without pictures."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from skillwrapper.cli.action_models import Effects, Negatives, TraceOptions, learn_from_traces
from skillwrapper.cli.output import JsonFlag, print_json, results
from skillwrapper.cli.setting_options import ConfigOption, SetOption, run_settings
from skillwrapper.domains.discovery import find_domain
from skillwrapper.errors import ConfigurationError
from skillwrapper.files.writing import write_json
from skillwrapper.learning.certification import Certificate, certify
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.learner import learn_operators
from skillwrapper.learning.untested import find_untested
from skillwrapper.symbols.describe import describe_operator
from skillwrapper.symbols.files import read_predicates
from skillwrapper.symbols.model_folder import write_model
from skillwrapper.symbols.operators import Condition
from skillwrapper.transitions.files import read_transitions

_Untested = dict[str, frozenset[Condition]]


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command(name="learn-operators")(learn_from_file)


def learn_from_file(
    transitions: Annotated[
        list[Path],
        typer.Argument(
            help="JSON lines, one transition a line; with a PDDL domain also traces in "
            "parentheses, any number of files; see docs/operators.md."
        ),
    ],
    domain: Annotated[
        str,
        typer.Option(
            help="The domain: its domain.yaml, its folder or its name; or a PDDL domain that "
            "declares types, predicates and the parameters of actions."
        ),
    ],
    out: Annotated[Path, typer.Option(help="Folder for domain.pddl and the other files.")],
    failures: Annotated[
        bool,
        typer.Option(
            "--failures", help="In traces in parentheses, what leaves the state as it was failed."
        ),
    ] = False,
    negatives: Annotated[
        Negatives | None,
        typer.Option(help="With a PDDL domain: which negative preconditions. Default: declared."),
    ] = None,
    effects: Annotated[
        Effects | None,
        typer.Option(
            help="With a PDDL domain: an action whose effects depend on context as one with "
            "conditional effects, or as separate ones. Default: conditional."
        ),
    ] = None,
    partial: Annotated[
        bool,
        typer.Option(
            "--partial",
            help="In traces in parentheses, states say all that is known, not all that is true.",
        ),
    ] = False,
    cautious: Annotated[
        bool,
        typer.Option(
            "--cautious",
            help="Where states are missing, what no state shows counts as a precondition.",
        ),
    ] = False,
    problem: Annotated[
        list[Path] | None,
        typer.Option(
            help="With a PDDL domain: the problem that plans solve; one for all, or one for each."
        ),
    ] = None,
    predicates: Annotated[
        Path | None,
        typer.Option(help="predicates.yaml with types and meanings; default: from the atoms."),
    ] = None,
    config: ConfigOption = None,
    assignments: SetOption = None,
    as_json: JsonFlag = False,
) -> None:
    """Learn operators from transitions whose labels are known; no picture, no model."""
    options = TraceOptions(failures, partial, tuple(problem or ()), cautious, negatives, effects)
    if domain.lower().endswith(".pddl"):
        learn_from_traces(transitions, Path(domain), out, options, as_json=as_json)
        return
    if len(transitions) > 1 or options != TraceOptions():
        raise ConfigurationError(
            "several files, --failures, --negatives, --effects, --partial, --cautious and "
            "--problem are for PDDL domains: expected --domain to name a file that ends with "
            f".pddl, got '{domain}'"
        )
    settings = run_settings(config, {"domain": ("--domain", domain)}, assignments or ()).learning
    declared = find_domain(domain).domain
    vocabulary = read_predicates(predicates, declared) if predicates is not None else None
    labelled = read_transitions(transitions[0], declared, vocabulary)
    fit = learn_operators(labelled, learner=settings.learner, settings=settings)
    certificate, untested = certify(fit), find_untested(fit)
    write_model(out, fit.model)
    write_json(out / "certificate.json", _checked(certificate, untested))
    if as_json:
        print_json({**_figures(fit), "certificate": _checked(certificate, untested)})
    else:
        _print(fit, certificate, untested, out)


def _figures(fit: Fit) -> dict[str, Any]:
    return {
        "predicates": [p.signature for p in fit.predicates],
        "operators": [o.operator.name for o in fit.operators],
        "inconsistencies": len(fit.inconsistencies),
    }


def _checked(certificate: Certificate, untested: _Untested) -> dict[str, Any]:
    conditions = {name: sorted(map(str, found)) for name, found in untested.items()}
    return {**certificate.to_json(), "untested": conditions}


def _print(fit: Fit, certificate: Certificate, untested: _Untested, out: Path) -> None:
    console = results()
    for learned in fit.operators:
        name = learned.operator.name
        console.print(describe_operator(learned.operator, untested[name]))
        console.print("")
    console.print(
        f"{certificate.transitions} transitions, {certificate.decided} decided, violations: "
        f"{certificate.count('lemma1')} of Lemma 1, {certificate.count('theorem1')} of Theorem 1; "
        f"{len(fit.inconsistencies)} inconsistencies",
    )
    console.print(f"written: {out / 'domain.pddl'} and what belongs to it")
