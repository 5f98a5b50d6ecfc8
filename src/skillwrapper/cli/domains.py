"""``skillwrapper domain`` and ``skillwrapper render``: what a domain is, and what it looks like."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from skillwrapper.cli.domain_argument import DomainArgument
from skillwrapper.cli.output import JsonFlag, print_json, results
from skillwrapper.domains.discovery import find_domain
from skillwrapper.errors import ConfigurationError
from skillwrapper.files.writing import write_atomically
from skillwrapper.files.yaml_documents import YamlDocument
from skillwrapper.world.domain import Domain, load_domain
from skillwrapper.world.environment import EnumerableEnvironment, Environment
from skillwrapper.world.observation import Observation
from skillwrapper.world.skills import SkillInstance, parse_skill_instance


def register(app: typer.Typer) -> None:
    """Add the commands of this group."""
    app.command(name="domain")(show_domain)
    app.command()(render)


def show_domain(
    name: Annotated[str, typer.Argument(help="A bundled domain, or a domain.yaml to check.")],
    as_json: JsonFlag = False,
) -> None:
    """Show types, objects and skills of a domain."""
    figures: dict[str, Any] = {}
    if Path(name).suffix in (".yaml", ".yml"):
        domain = load_domain(Path(name))
    else:
        environment = find_domain(name).make_environment()
        domain = environment.domain
        if isinstance(environment, EnumerableEnvironment):
            figures["reachable_states"] = len(environment.reachable_states())
        environment.close()
    figures["skill_instances"] = len(domain.skill_instances)
    if as_json:
        print_json({**_describe(domain), **figures})
    else:
        _print_domain(domain, figures)


def render(
    name: DomainArgument,
    out: Annotated[Path, typer.Option(help="The PNG file to write.")],
    seed: Annotated[int, typer.Option(min=0, help="Chooses the layout.")] = 0,
    state: Annotated[
        str | None,
        typer.Option(help="A YAML file of a state, or the number of a reachable one."),
    ] = None,
    skills: Annotated[
        list[str] | None,
        typer.Option("--do", help="A skill to run first, e.g. 'Pick(robot, patty)'; repeatable."),
    ] = None,
    as_json: JsonFlag = False,
) -> None:
    """Write a picture of a domain in some state."""
    environment = find_domain(name).make_environment()
    observation = environment.reset(seed=seed)
    if state is not None:
        observation = _set_state(environment, state, seed)
    outcomes = []
    for text in skills or []:
        instance = _parse_instance(environment.domain, text)
        outcome = environment.execute(instance)
        observation = outcome.observation
        outcomes.append({"skill": str(instance), "success": outcome.success})
    write_atomically(out, observation.pictures[0].png)
    environment.close()
    if as_json:
        print_json({"picture": str(out), "skills": outcomes})
    else:
        for outcome_line in outcomes:
            done = "done" if outcome_line["success"] else "failed"
            results().print(f"{outcome_line['skill']}: {done}", markup=False)
        results().print(f"wrote {out}", markup=False)


def _set_state(environment: Environment, text: str, seed: int) -> Observation:
    """Put the environment into a state that a number or a file names."""
    if not isinstance(environment, EnumerableEnvironment):
        raise ConfigurationError(f"--state: the states of {environment.domain.name} are not known")
    if not text.isdigit():
        document = YamlDocument.read(Path(text))
        return environment.set_state(environment.state_from_data(document.data), seed=seed)
    states = environment.reachable_states()
    if int(text) >= len(states):
        raise ConfigurationError(f"--state: expected 0 to {len(states) - 1}, got {text}")
    return environment.set_state(states[int(text)], seed=seed)


def _parse_instance(domain: Domain, text: str) -> SkillInstance:
    instance = parse_skill_instance(text)
    domain.check_instance(instance)
    return instance


def _describe(domain: Domain) -> dict[str, Any]:
    return {
        "name": domain.name,
        "types": {
            t: {"parents": list(domain.types.parents[t]), "meaning": domain.types.descriptions[t]}
            for t in domain.types.names
        },
        "objects": {o.name: list(o.types) for o in domain.objects},
        "skills": {
            s.name: {p.name: {"type": p.type, "role": p.role} for p in s.parameters}
            for s in domain.skills
        },
        "failures_change_nothing": domain.failures_change_nothing,
    }


def _print_domain(domain: Domain, figures: dict[str, Any]) -> None:
    console = results()
    console.print(f"[bold]{domain.name}[/]: {domain.agent}")
    console.print("\n[bold]types[/]")
    for name in domain.types.names:
        parents = ", ".join(domain.types.parents[name])
        console.print(f"  {name}{f' (a {parents})' if parents else ''}", markup=False)
    console.print("\n[bold]objects[/]")
    for thing in domain.objects:
        console.print(f"  {thing.name}: {', '.join(thing.types)}", markup=False)
    console.print("\n[bold]skills[/]")
    for skill in domain.skills:
        parameters = ", ".join(f"{p.name}: {p.type}" for p in skill.parameters)
        console.print(f"  {skill.name}({parameters})  {skill.description}", markup=False)
    console.print("")
    for figure, value in figures.items():
        console.print(f"{figure.replace('_', ' ')}: {value}", markup=False)
