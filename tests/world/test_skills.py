from __future__ import annotations

from skillwrapper.world import Object, Parameter, Skill, SkillInstance, ground_skills

ARM = Object("arm", ("robot",))
CUP = Object("cup", ("item",))
LID = Object("lid", ("item",))
TAKE = Skill("Take", (Parameter("robot", "robot"), Parameter("item", "item")))
COVER = Skill("Cover", (Parameter("upper", "item"), Parameter("lower", "item")))
WAIT = Skill("Wait", ())


def test_instances_come_in_the_order_of_skills_and_objects() -> None:
    assert ground_skills([COVER, TAKE], [ARM, CUP, LID]) == (
        SkillInstance("Cover", ("cup", "lid")),
        SkillInstance("Cover", ("lid", "cup")),
        SkillInstance("Take", ("arm", "cup")),
        SkillInstance("Take", ("arm", "lid")),
    )


def test_skill_without_parameters_has_one_instance() -> None:
    assert [str(instance) for instance in ground_skills([WAIT], [ARM])] == ["Wait()"]


def test_skill_accepts_distinct_objects_of_its_types_only() -> None:
    assert COVER.accepts([CUP, LID])
    assert not COVER.accepts([CUP, CUP])
    assert not COVER.accepts([CUP])
    assert not COVER.accepts([ARM, CUP])
