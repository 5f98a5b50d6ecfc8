"""``skillwrapper domain`` and ``skillwrapper render``: what a domain is, and what it looks like."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import closing
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.text import Text

from skillwrapper.cli.domain_argument import DomainArgument
from skillwrapper.cli.films import filmed
from skillwrapper.cli.output import JsonFlag, print_json, results
from skillwrapper.domains.discovery import find_domain
from skillwrapper.domains.package import DomainPackage
from skillwrapper.errors import ConfigurationError
from skillwrapper.files.writing import write_atomically
from skillwrapper.files.yaml_documents import YamlDocument
from skillwrapper.world.capabilities import (
    Enumerable,
    Settable,
    capabilities_of,
    require,
    supports,
)
from skillwrapper.world.domain import Domain
from skillwrapper.world.environment import Environment
from skillwrapper.world.episode import Outcome
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import ground_skills, parse_skill_instance


def register(app: typer.Typer) -> None:
    """Add the commands of this group."""
    app.command(name="domain")(show_domain)
    app.command()(render)


SceneOption = Annotated[str | None, typer.Option(help="One of the domain's scenes.")]


def show_domain(
    reference: DomainArgument,
    scene: SceneOption = None,
    as_json: JsonFlag = False,
) -> None:
    """Show types, objects, skills and scenes of a domain, and what its robot can do."""
    package = find_domain(reference)
    scenes = [package.domain.scene(scene)] if scene else list(package.domain.scenes.values())
    found = {**_describe(package.domain, scenes), **_find_out(package, scenes)}
    if as_json:
        print_json(found)
    else:
        _print_domain(package.domain, found)


def render(
    reference: DomainArgument,
    out: Annotated[Path, typer.Option(help="The PNG file to write.")],
    seed: Annotated[int, typer.Option(min=0, help="Chooses the layout.")] = 0,
    scene: SceneOption = None,
    camera: Annotated[str | None, typer.Option(help="Which camera; the first by default.")] = None,
    state: Annotated[
        str | None,
        typer.Option(help="A YAML file of a state, or the number of a reachable one."),
    ] = None,
    skills: Annotated[
        list[str] | None,
        typer.Option("--do", help="A skill to run first, e.g. 'Pick(robot, cup)'; repeatable."),
    ] = None,
    video: Annotated[
        Path | None,
        typer.Option(help="Also write a video (.webp, .gif) of the skills, if it can be filmed."),
    ] = None,
    as_json: JsonFlag = False,
) -> None:
    """Write a picture of a domain in some state."""
    with closing(find_domain(reference).make_environment()) as environment:
        observation = environment.reset(seed=seed, scene=scene)
        if state is not None:
            observation = _set_state(environment, state, seed)
        with filmed(environment, video):
            done = [_execute(environment, text) for text in skills or []]
        shown = done[-1][1].observation if done else observation
        write_atomically(out, shown.picture(camera).png)
    if as_json:
        film = {} if video is None else {"video": str(video)}
        outcomes = [{"skill": skill, "success": outcome.success} for skill, outcome in done]
        print_json({"picture": str(out), **film, "skills": outcomes})
    else:
        for skill, outcome in done:
            results().print(f"{skill}: {'done' if outcome.success else 'failed'}")
        for path in filter(None, (out, video)):
            results().print(f"wrote {path}")


def _execute(environment: Environment, text: str) -> tuple[str, Outcome]:
    instance = parse_skill_instance(text)
    environment.domain.check_instance(instance, environment.scene)
    return str(instance), environment.execute(instance)


def _set_state(environment: Environment, text: str, seed: int) -> Observation:
    """Put the environment into a state that a number or a file names."""
    if not text.isdigit():
        settable = require(environment, Settable, "--state")
        document = YamlDocument.read(Path(text))
        return settable.set_state(settable.state_from_data(document.data), seed=seed)
    enumerable = require(environment, Enumerable, "--state with a number")
    states = enumerable.reachable_states()
    if int(text) >= len(states):
        raise ConfigurationError(f"--state: expected 0 to {len(states) - 1}, got {text}")
    return enumerable.set_state(states[int(text)], seed=seed)


def _describe(domain: Domain, scenes: Sequence[Scene]) -> dict[str, Any]:
    present = {o for scene in scenes for o in scene.objects}
    instances = {i for scene in scenes for i in ground_skills(domain.skills, scene.objects)}
    return {
        "name": domain.name,
        "types": {
            t: {"parents": list(domain.types.parents[t]), "meaning": domain.types.descriptions[t]}
            for t in domain.types.names
        },
        "objects": {o.name: list(o.types) for o in domain.objects if o in present},
        "skills": {
            s.name: {p.name: {"type": p.type, "role": p.role} for p in s.parameters}
            for s in domain.skills
        },
        "scenes": {scene.name: list(scene.names) for scene in scenes},
        "failures_change_nothing": domain.failures_change_nothing,
        "resets_restore_state": domain.resets_restore_state,
        "skill_instances": len(instances),
    }


def _find_out(package: DomainPackage, scenes: Sequence[Scene]) -> dict[str, Any]:
    """What only the domain's robot tells; nothing is executed."""
    if not package.has("robot"):
        return {"robot": False}
    with closing(package.make_environment()) as environment:
        found: dict[str, Any] = {"robot": True, "capabilities": list(capabilities_of(environment))}
        if supports(environment, Enumerable):
            listed = require(environment, Enumerable, "counting states")
            found["abstract_states"] = {s.name: _count_states(listed, s) for s in scenes}
    return found


def _count_states(environment: Enumerable, scene: Scene) -> int:
    environment.reset(seed=0, scene=scene.name)
    return len(environment.reachable_states())


def _print_domain(domain: Domain, found: Mapping[str, Any]) -> None:
    console = results()
    console.print(Text.assemble((domain.name, "bold"), f": {domain.agent}"))
    console.print("\ntypes", style="bold")
    for name in domain.types.names:
        parents = ", ".join(domain.types.parents[name])
        console.print(f"  {name}{f' (a {parents})' if parents else ''}")
    console.print("\nobjects", style="bold")
    for name, types in found["objects"].items():
        console.print(f"  {name}: {', '.join(types)}")
    console.print("\nskills", style="bold")
    for skill in domain.skills:
        parameters = ", ".join(f"{p.name}: {p.type}" for p in skill.parameters)
        console.print(f"  {skill.name}({parameters})  {skill.description}")
    console.print("\nscenes", style="bold")
    counts = found.get("abstract_states", {})
    for name, objects in found["scenes"].items():
        states = f"  ({counts[name]} reachable states)" if name in counts else ""
        console.print(f"  {name}: {', '.join(objects)}{states}")
    console.print(f"\nskill instances: {found['skill_instances']}")
    if found["robot"]:
        console.print(f"capabilities: {', '.join(found['capabilities']) or 'none'}")
    else:
        console.print("no robot: its skills cannot be executed")
