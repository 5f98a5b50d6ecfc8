"""A domain: the types, objects and skills that are known from the start, read from YAML."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from types import MappingProxyType

import yaml

from skillwrapper.errors import ConfigurationError, UnknownNameError
from skillwrapper.files.yaml_documents import YamlDocument
from skillwrapper.world.domain_file import DomainFile
from skillwrapper.world.scenes import DEFAULT_SCENE, Scene
from skillwrapper.world.skills import Parameter, Skill, SkillInstance, ground_skills
from skillwrapper.world.types import Object, TypeHierarchy


@dataclass(frozen=True)
class Domain:
    """What a robot's user declares (the paper's types, objects and skills).

    Attributes:
        name: e.g. ``"kitchen"``.
        agent: one sentence on the robot, used in prompts.
        description: what the scene looks like, used in prompts; no rule of when a skill works.
        types: hierarchy of object types.
        objects: all objects; a scene may hold a part of them.
        skills: the black-box skills.
        declared_scenes: those of the file, in its order; empty for one with all objects.
        failures_change_nothing: whether a failed skill is known to leave the state as it
            was (docs/semantics.md D11).
        resets_restore_state: whether every reset brings the same state of a scene back, if
            perhaps not the same picture (D8).
    """

    name: str
    agent: str
    description: str
    types: TypeHierarchy
    objects: tuple[Object, ...]
    skills: tuple[Skill, ...]
    declared_scenes: tuple[Scene, ...] = ()
    failures_change_nothing: bool = False
    resets_restore_state: bool = False

    @cached_property
    def object_by_name(self) -> dict[str, Object]:
        """Objects by their names."""
        return {o.name: o for o in self.objects}

    @cached_property
    def skill_by_name(self) -> dict[str, Skill]:
        """Skills by their names."""
        return {s.name: s for s in self.skills}

    @cached_property
    def skill_instances(self) -> tuple[SkillInstance, ...]:
        """All skill instances over all objects."""
        return ground_skills(self.skills, self.objects)

    @cached_property
    def scenes(self) -> Mapping[str, Scene]:
        """Scenes by their names; at least one (docs/semantics.md D19)."""
        scenes = self.declared_scenes or (Scene(DEFAULT_SCENE, self.objects),)
        return MappingProxyType({scene.name: scene for scene in scenes})

    def scene(self, name: str | None = None) -> Scene:
        """The scene of a name; None for the first one.

        Raises:
            UnknownNameError: if there is no such scene.
        """
        if name is None:
            return next(iter(self.scenes.values()))
        if name not in self.scenes:
            raise UnknownNameError("scene", name, self.scenes)
        return self.scenes[name]

    def check_instance(self, instance: SkillInstance, scene: Scene | None = None) -> None:
        """Raise ``UnknownNameError`` or ``ConfigurationError`` if there is no such instance.

        Args:
            instance: what is to be executed.
            scene: what is present; None for all objects.
        """
        skill = self.skill_by_name.get(instance.skill)
        if skill is None:
            raise UnknownNameError("skill", instance.skill, self.skill_by_name)
        present = self.object_by_name if scene is None else scene.names
        for name in instance.arguments:
            if name not in present:
                raise UnknownNameError("object", name, present)
        if not skill.accepts([self.object_by_name[name] for name in instance.arguments]):
            expected = ", ".join(p.type for p in skill.parameters)
            raise ConfigurationError(
                f"{instance}: expected different objects of the types ({expected})"
            )


def load_domain(path: Path) -> Domain:
    """Read a domain from its YAML file.

    Raises:
        ConfigurationError: with file, line and what was expected.
    """
    return build_domain(YamlDocument.read(path))


def build_domain(document: YamlDocument) -> Domain:
    """The domain of a YAML document.

    Raises:
        ConfigurationError: with file, line and what was expected.
    """
    entries = document.validate(DomainFile)
    for kind, names in (
        ("type", entries.types),
        ("object", entries.objects),
        ("skill", entries.skills),
    ):
        _expect_more_than_case(document, kind, names)
    hierarchy = _build_types(document, entries)
    objects = _build_objects(document, entries, hierarchy)
    return Domain(
        name=entries.name,
        agent=entries.agent.strip(),
        description=entries.description.strip(),
        types=hierarchy,
        objects=objects,
        skills=_build_skills(document, entries),
        declared_scenes=_build_scenes(document, entries, objects),
        failures_change_nothing=entries.failures_change_nothing,
        resets_restore_state=entries.resets_restore_state,
    )


def domain_to_yaml(domain: Domain) -> str:
    """What a ``domain.yaml`` says of a domain; ``load_domain`` gives an equal one."""
    content = {
        "name": domain.name,
        "agent": domain.agent,
        "description": domain.description,
        "failures_change_nothing": domain.failures_change_nothing,
        "resets_restore_state": domain.resets_restore_state,
        "types": {
            name: {"parents": parents, "description": domain.types.descriptions.get(name, "")}
            for name, parents in domain.types.parents.items()
        },
        "objects": {
            o.name: {"types": domain.types.most_specific(o.types), "description": o.description}
            for o in domain.objects
        },
        "skills": {
            s.name: {
                "parameters": [vars(parameter) for parameter in s.parameters],
                "description": s.description,
            }
            for s in domain.skills
        },
        "scenes": {scene.name: scene.names for scene in domain.declared_scenes},
    }
    plain = DomainFile.model_validate(content).model_dump(mode="json", exclude_defaults=True)
    return yaml.safe_dump(plain, sort_keys=False, allow_unicode=True, width=88)


def _build_types(document: YamlDocument, entries: DomainFile) -> TypeHierarchy:
    for name, entry in entries.types.items():
        for parent in entry.parents:
            _check_type(document, entries, parent, ("types", name, "parents"))
    try:
        return TypeHierarchy(
            parents={name: tuple(e.parents) for name, e in entries.types.items()},
            descriptions={name: e.description for name, e in entries.types.items()},
        )
    except ConfigurationError as error:
        raise ConfigurationError(f"{document.place(('types',))}: {error}") from error


def _build_objects(
    document: YamlDocument, entries: DomainFile, hierarchy: TypeHierarchy
) -> tuple[Object, ...]:
    objects = []
    for name, entry in entries.objects.items():
        for type_name in entry.types:
            _check_type(document, entries, type_name, ("objects", name, "types"))
        types = tuple(sorted(hierarchy.closure(entry.types)))
        objects.append(Object(name, types, entry.description))
    return tuple(objects)


def _build_skills(document: YamlDocument, entries: DomainFile) -> tuple[Skill, ...]:
    skills = []
    for name, entry in entries.skills.items():
        for number, parameter in enumerate(entry.parameters):
            place = ("skills", name, "parameters", number, "type")
            _check_type(document, entries, parameter.type, place)
        parameters = tuple(Parameter(p.name, p.type, p.role) for p in entry.parameters)
        if len({p.name for p in parameters}) < len(parameters):
            where = document.place(("skills", name, "parameters"))
            raise ConfigurationError(f"{where}: two parameters of '{name}' have the same name")
        skills.append(Skill(name, parameters, entry.description))
    return tuple(skills)


def _build_scenes(
    document: YamlDocument, entries: DomainFile, objects: tuple[Object, ...]
) -> tuple[Scene, ...]:
    for scene, names in entries.scenes.items():
        where = document.place(("scenes", scene))
        if not names or len(set(names)) < len(names):
            raise ConfigurationError(
                f"{where}: expected scene '{scene}' to name at least one object, and each once"
            )
        for number, name in enumerate(names):
            if name not in entries.objects:
                where = document.place(("scenes", scene, number))
                raise UnknownNameError(f"object in scene '{scene}'", name, entries.objects, where)
    return tuple(Scene.of(scene, names, objects) for scene, names in entries.scenes.items())


def _expect_more_than_case(document: YamlDocument, kind: str, names: Iterable[str]) -> None:
    """PDDL and the readers of replies do not tell ``Cup`` from ``cup``."""
    first: dict[str, str] = {}
    for name in names:
        other = first.setdefault(name.lower(), name)
        if other != name:
            raise ConfigurationError(
                f"{document.place((f'{kind}s', name))}: expected names that differ in more than "
                f"upper and lower case, which planners do not tell apart, got the {kind}s "
                f"'{other}' and '{name}'; rename one"
            )


def _check_type(
    document: YamlDocument, entries: DomainFile, name: str, place: tuple[str | int, ...]
) -> None:
    if name not in entries.types:
        raise UnknownNameError("type", name, entries.types, document.place(place))
