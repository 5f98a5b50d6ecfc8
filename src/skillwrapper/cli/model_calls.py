"""``skillwrapper calls``, ``doctor`` and ``vlm-server``: what models are asked, and trying them."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.table import Table
from rich.text import Text

from skillwrapper.cli.domain_argument import OptionalDomainArgument
from skillwrapper.cli.output import JsonFlag, messages, print_json, results
from skillwrapper.cli.setting_options import (
    BaseUrlOption,
    PromptsOption,
    option,
    options_given,
    run_settings,
)
from skillwrapper.domains.discovery import bundled_domains, find_domain
from skillwrapper.domains.eyesight import Eyesight
from skillwrapper.embedded import EmbeddedModel
from skillwrapper.embedded.server import ServerSettings, VlmServer
from skillwrapper.embedded.server_faults import FAULTS, FaultPlan
from skillwrapper.errors import ConfigurationError, RunFolderError
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.doctor import examine
from skillwrapper.vlm.protocol import Role
from skillwrapper.vlm.stored_call import CallStatus, CallTotals, StoredCall


def register(app: typer.Typer) -> None:
    """Add the commands of this group."""
    app.command()(calls)
    app.command()(doctor)
    app.command("vlm-server")(vlm_server)


def calls(
    run: Annotated[Path, typer.Argument(help="Folder of a run.")],
    role: Annotated[Role | None, typer.Option(help="Only calls of a role.")] = None,
    iteration: Annotated[int | None, typer.Option(min=1, help="Only of an iteration.")] = None,
    status: Annotated[CallStatus | None, typer.Option(help="List only such calls.")] = None,
    last: Annotated[int, typer.Option(min=0, help="List so many, the last ones; 0 for all.")] = 20,
    full: Annotated[bool, typer.Option("--full", help="With whole prompts and replies.")] = False,
    as_json: JsonFlag = False,
) -> None:
    """List the model calls of a run, and what they took in all."""
    archive = RunArchive.open(run)
    readings = _readings(archive)
    with archive.open_calls() as store:
        if store is None:
            raise RunFolderError(
                f"{archive.layout.calls}: expected recorded calls, got no such file"
            )
        found = list(store.calls(role=role, iteration=iteration, status=status))
        totals = [
            t for t in store.totals() if role in {None, t.role} and iteration in {None, t.iteration}
        ]
    shown = found[-last:] if last else found
    if as_json:
        entries = [asdict(call) for call in shown]
        total = _describe_sum(totals)
        parts = {"totals": [asdict(t) for t in totals], "total": total, "readings": readings}
        print_json({"calls": entries, **parts})
        return
    for call in shown:
        _print_call(call, full)
    if len(shown) < len(found):
        results().print(f"the last {len(shown)} of {len(found)} calls; all with --last 0\n")
    _print_totals(totals)
    if readings and readings["reasking"]:
        results().print(_describe_readings(**readings))


def doctor(
    context: typer.Context,
    model: Annotated[str, typer.Option(help="embedded, human, openai:NAME or recorded:DIR.")],
    domain: OptionalDomainArgument = None,
    picture: Annotated[
        list[str] | None,
        typer.Option(help="A picture of the domain to be tried on; may be repeated."),
    ] = None,
    base_url: BaseUrlOption = None,
    prompts: PromptsOption = None,
    timeout: Annotated[float | None, option("timeout")] = None,
    temperature: Annotated[float | None, option("temperature")] = None,
    max_output_tokens: Annotated[int | None, option("max_output_tokens")] = None,
    reasoning_effort: Annotated[str | None, option("reasoning_effort")] = None,
    image_size: Annotated[int | None, option("image_size")] = None,
    as_json: JsonFlag = False,
) -> None:
    """Try a model with a few calls, on pictures of a domain: does it answer, see, and agree."""
    if picture and domain is None:
        raise ConfigurationError("--picture: expected a domain to go with it, got none")
    options = options_given({**context.params, "domain": domain or "bundled"})
    settings = run_settings(None, options, ()).model
    findings = []
    for finding in examine(settings, domain, picture or ()):
        findings.append(finding)
        if not as_json:
            mark = ("ok    ", "green") if finding.passed else ("wrong ", "red")
            results().print(Text.assemble(mark, f"{finding.check}: {finding.detail}"))
    healthy = all(finding.passed for finding in findings)
    if as_json:
        print_json({"healthy": healthy, "findings": [asdict(f) for f in findings]})
    if not healthy:
        raise typer.Exit(2)


def vlm_server(
    port: Annotated[int, typer.Option(min=0, max=65535, help="On 127.0.0.1; 0 for any.")] = 8000,
    latency: Annotated[float, typer.Option(min=0.0, help="Seconds that a call takes.")] = 0.0,
    fault: Annotated[
        list[str] | None,
        typer.Option(help="A fault that calls have; may be repeated; see --list-faults."),
    ] = None,
    faults: Annotated[
        float | None,
        typer.Option(min=0.0, max=1.0, help="Share of failing calls; all if a fault is named."),
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Of the model, and of what fails.")] = 0,
    domains: Annotated[
        list[str] | None,
        typer.Option("--domain", help="A domain whose pictures it reads, beside all bundled ones."),
    ] = None,
    list_faults: Annotated[
        bool, typer.Option("--list-faults", help="Print the names of all faults; serve nothing.")
    ] = False,
) -> None:
    """Serve the embedded model to any client of the chat-completions protocol."""
    if list_faults:
        for name, summary in FAULTS.items():
            typer.echo(f"{name:20} {summary}")
        return
    settings = ServerSettings(port, latency, FaultPlan.of_names(fault or (), faults, seed))
    own = [find_domain(reference) for reference in domains or ()]
    for package in own:
        package.require("scene_reader", "serving the embedded model")
    eyes = Eyesight.for_packages((*bundled_domains(), *own))
    model = EmbeddedModel(seed, readers=eyes.readers, words=eyes.words)
    server = VlmServer(model, settings)
    messages().print(
        f"serving the model 'embedded' at {server.url}; stop with Ctrl-C\n"
        f"try it: skillwrapper doctor --model openai:embedded --base-url {server.url}",
        soft_wrap=True,
    )
    try:
        server.serve()
    except KeyboardInterrupt:
        messages().print("stopped")


def _readings(archive: RunArchive) -> dict[str, int] | None:
    """Calls that reading pictures took, and what asking everything again would have taken."""
    finished = archive.iterations()
    if not finished:
        return None
    summary = finished[-1].summary
    return {"needed": summary.evaluation_calls, "reasking": summary.evaluation_calls_reasking}


def _describe_readings(needed: int, reasking: int) -> str:
    times = f", {reasking / needed:.1f} times as many" if needed else ""
    return (
        f"\nevaluate: {needed} calls needed for the iterations that are finished; asking every "
        f"predicate on every new picture, and on every picture after each invention: "
        f"{reasking}{times}"
    )


def _print_call(call: StoredCall, full: bool) -> None:
    console = results()
    source = "shared store" if call.shared else call.model
    console.print(
        f"{call.iteration or '-':>3}  {call.role:9}  {call.status:8}  {call.usage.seconds:6.1f} s  "
        f"{source}  {call.key[:12]}",
    )
    if full:
        pictures = json.dumps(call.pictures)
        console.print(
            f"--- system\n{call.system}\n--- prompt\n{call.prompt}\n--- pictures {pictures}\n"
            f"--- reply\n{call.reply}\n",
        )


def _print_totals(totals: Sequence[CallTotals]) -> None:
    names = ("it.", "role", "made", "failed", "served", "share", "in", "out", "dollars")
    table = Table(box=None, padding=(0, 2, 0, 0), caption="in, out: tokens of prompts and replies")
    for name in (*names, "seconds"):
        table.add_column(name, no_wrap=True)
    for one in totals:
        table.add_row(str(one.iteration or "-"), str(one.role), *_cells(asdict(one)))
    table.add_row("all", "", *_cells(_describe_sum(totals)), style="bold")
    results().print(table)


def _cells(total: dict[str, Any]) -> tuple[str, ...]:
    asked = total["made"] + total["served"]
    return (
        str(total["made"]),
        str(total["failed"]),
        str(total["served"]),
        f"{total['served'] / asked:.0%}" if asked else "-",
        _known(total["input_tokens"], ","),
        _known(total["output_tokens"], ","),
        _known(total["cost"], ".4f"),
        f"{total['seconds']:.1f}",
    )


def _describe_sum(totals: Sequence[CallTotals]) -> dict[str, Any]:
    """Everything added up; unknown as soon as one part is."""
    names = ("made", "served", "failed", "input_tokens", "output_tokens", "cost", "seconds")
    columns = {name: [getattr(total, name) for total in totals] for name in names}
    return {name: None if None in values else sum(values) for name, values in columns.items()}


def _known(value: float | None, form: str) -> str:
    return "unknown" if value is None else format(value, form)
