from __future__ import annotations

import pytest

from skillwrapper.domains.registry import domain_file, domain_names, make_environment
from skillwrapper.errors import UnknownNameError
from skillwrapper.world import load_domain


def test_every_name_makes_its_domain() -> None:
    assert "burger" in domain_names()
    for name in domain_names():
        environment = make_environment(name)
        assert environment.domain.name == name
        assert load_domain(domain_file(name)) == environment.domain


def test_environments_are_independent() -> None:
    first, second = make_environment("burger"), make_environment("burger")
    first.reset(seed=0)
    second.reset(seed=0)
    first.execute(first.domain.skill_instances[0])
    assert first.observe().key != second.observe().key


def test_unknown_name_gets_a_hint() -> None:
    with pytest.raises(UnknownNameError, match="unknown domain 'burgr'; did you mean 'burger'"):
        make_environment("burgr")
    with pytest.raises(UnknownNameError, match="unknown domain 'burgr'"):
        domain_file("burgr")
