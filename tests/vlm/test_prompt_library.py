from __future__ import annotations

from pathlib import Path

import pytest

from skillwrapper.errors import ConfigurationError, UnknownNameError
from skillwrapper.vlm.prompt_library import PROMPT_VARIABLES, PromptKind, PromptLibrary
from skillwrapper.world import Domain


def test_every_prompt_has_a_template_and_declared_variables() -> None:
    PromptLibrary()
    assert set(PROMPT_VARIABLES) == set(PromptKind)


def test_a_users_template_replaces_ours_by_its_file_name(tmp_path: Path, burger: Domain) -> None:
    (tmp_path / "system.j2").write_text("Be brief. {{ domain.name }}\n")

    prompts = PromptLibrary(tmp_path)

    assert prompts.render(PromptKind.SYSTEM, domain=burger) == "Be brief. burger"
    assert "asked again" in prompts.render(PromptKind.ASK_AGAIN, problem="it was empty", time=2)


def test_a_users_template_may_use_our_pieces(tmp_path: Path, burger: Domain) -> None:
    (tmp_path / "system.j2").write_text(
        "{% import '_parts.j2' as parts %}{{ parts.objects(domain.objects) }}"
    )
    text = PromptLibrary(tmp_path).render(PromptKind.SYSTEM, domain=burger)
    assert "- stove (cooker, station): " in text


def test_an_unknown_variable_is_named_with_its_template(tmp_path: Path) -> None:
    (tmp_path / "evaluate.j2").write_text("{{ observations }}")
    with pytest.raises(ConfigurationError, match=r"evaluate\.j2: unknown variable 'observations'"):
        PromptLibrary(tmp_path)


def test_an_unknown_attribute_is_named_with_its_template(tmp_path: Path, burger: Domain) -> None:
    (tmp_path / "system.j2").write_text("{{ domain.robots }}")
    prompts = PromptLibrary(tmp_path)
    with pytest.raises(ConfigurationError, match=r"system\.j2: .*'robots'"):
        prompts.render(PromptKind.SYSTEM, domain=burger)


def test_a_syntax_error_is_named_with_its_line(tmp_path: Path) -> None:
    (tmp_path / "evaluate.j2").write_text("fine\n{% for x in %}")
    with pytest.raises(ConfigurationError, match=r"evaluate\.j2, line 2"):
        PromptLibrary(tmp_path)


def test_a_misspelt_file_name_is_not_ignored(tmp_path: Path) -> None:
    (tmp_path / "evaluat.j2").write_text("hello")
    with pytest.raises(UnknownNameError, match=r"did you mean 'evaluate\.j2'"):
        PromptLibrary(tmp_path)


def test_a_missing_folder_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(ConfigurationError, match="expected a folder"):
        PromptLibrary(tmp_path / "nowhere")
