from __future__ import annotations

import time
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
    with pytest.raises(ConfigurationError, match=r"system\.j2, line 1: .*'robots'"):
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


HOSTILE = {
    "syntax": ("fine\n{% for x in %}", 2),
    "open block": ("{% if domain %}", 1),
    "missing include": ("\n{% include 'nowhere.j2' %}", 2),
    "missing import": ("{% import '../../secrets.j2' as x %}", 1),
    "computed include": ("\n{% include domain.name ~ '.j2' %}", 2),
    "division": ("\n\n{{ 1 / 0 }}", 3),
    "type": ("{{ domain.name + 1 }}", 1),
    "attribute": ("{{ domain.robots }}", 1),
    "code": ("{{ ''.__class__.__mro__[1].__subclasses__() }}", 1),
    "code in a macro": ("{% macro m() %}{{ m.__globals__ }}{% endmacro %}\n{{ m() }}", None),
    "long loop": ("{% for i in range(10 ** 9) %}x{% endfor %}", 1),
    "nested loops": (
        "\n{% for i in range(99999) %}{% for j in range(99999) %}{% endfor %}{% endfor %}",
        2,
    ),
    "loops that write": ("{% for i in range(9999) %}{{ 'x' * 9999 }}{% endfor %}", None),
    "endless recursion": ("{% macro m() %}{{ m() }}{% endmacro %}{{ m() }}", None),
    "including itself": ("{% include 'system.j2' %}", None),
    "large text": ("{{ 'x' * 10 ** 12 }}", 1),
    "large list": ("{{ [1] * 10 ** 12 }}", 1),
    "large number": ("{{ 10 ** 10 ** 10 ** 10 }}", 1),
    "doubling": (
        "{% set n = namespace(s='x') %}"
        "{% for i in range(60) %}{% set n.s = n.s ~ n.s %}{% endfor %}",
        1,
    ),
    "format": ("{{ '%999999999999d' % 1 }}", 1),
    "filling": ("{{ 'x' | center(10 ** 10) }}", 1),
    "filling by a method": ("\n{{ 'x'.ljust(10 ** 10) }}", 2),
    "filling by a number": ("{{ (1).to_bytes(10 ** 10) }}", 1),
    "tabs": ("{{ ('\t' * 1000).expandtabs(10 ** 9) }}", 1),
    "format filter": ("{{ '%9999999999d' | format(1) }}", 1),
    "format of a method": ("{{ '{:9999999999}'.format(1) }}", 1),
    "format by another value": ("{{ '{:{}}'.format(1, 10 ** 10) }}", 1),
    "replacing": ("{{ ('a' * 900000) | replace('a', 'b' * 900000) }}", 1),
    "joining": ("{{ range(99999) | join('b' * 900000) }}", 1),
    "joining an attribute": (
        "{% set n = namespace(s='x' * 900000) %}{{ ([n] * 99999) | join('', attribute='s') }}",
        1,
    ),
    "joining by a method": ("{{ ('b' * 900000).join(['x'] * 900000) }}", 1),
    "indenting": ("{{ ('\\n' * 900000) | indent(900000) }}", 1),
    "batches": ("{{ [1] | batch(10 ** 10, 'x') | list }}", 1),
    "slices": ("{{ 'abc' | slice(10 ** 9) | list }}", 1),
    "wrapping": ("{{ ('a ' * 900000) | wordwrap(1) }}", 1),
    "links": ("{{ ('http://a.b/ ' * 100000) | urlize }}", 1),
    "many filters": (
        "{% for i in range(9999) %}{% set _ = ('x' * 99999) | upper %}{% endfor %}",
        1,
    ),
    "a list of long texts": ("{{ ['x' * 900000] * 900000 }}", 1),
    "lists in lists": (
        "{% set n = namespace(l=[1]) %}"
        "{% for i in range(60) %}{% set n.l = [n.l, n.l] %}{% endfor %}{{ n.l }}",
        1,
    ),
    "ten thousand paragraphs": ("{{ lipsum(n=10 ** 6) }}", None),
    "chance": ("{{ [1, 2] | random }}", 1),
    "unknown filter": ("fine\n{{ domain | nonsense }}", 2),
    "unknown test": ("fine\n{{ domain is nonsense }}", 2),
    "change": ("{% set _ = domain.objects.append(1) %}", 1),
}


@pytest.mark.parametrize("kind", HOSTILE)
def test_a_hostile_template_ends_in_one_sentence(kind: str, tmp_path: Path, burger: Domain) -> None:
    """Syntax, run time, loops, sizes, and code: with file and line, and in no time."""
    text, line = HOSTILE[kind]
    (tmp_path / "system.j2").write_text(text)
    began = time.process_time()
    with pytest.raises(ConfigurationError, match=r"prompt template .*j2") as caught:
        PromptLibrary(tmp_path).render(PromptKind.SYSTEM, domain=burger)
    assert time.process_time() - began < 5
    assert len(str(caught.value).splitlines()) == 1
    if line is not None:
        assert f"line {line}" in str(caught.value)


def test_a_template_that_is_no_text(tmp_path: Path) -> None:
    (tmp_path / "system.j2").write_bytes(b"\xff\xfe{{")
    with pytest.raises(ConfigurationError, match=r"system\.j2: expected UTF-8"):
        PromptLibrary(tmp_path)


def test_ordinary_templates_are_not_kept_from_anything(tmp_path: Path, burger: Domain) -> None:
    (tmp_path / "system.j2").write_text(
        "{% macro line(o) %}{{ o.name ~ ':' }}{% endmacro %}"
        "{% for o in domain.objects if o.types %}{{ loop.index + 1 }} {{ line(o) }} {% endfor %}"
        "{{ '-' * 3 }} {{ '%-3d|%s' | format(7, 'x') }} {{ '{:>3}'.format(7) }} "
        "{{ ' a b '.strip().split() | join(',') }} "
        "{{ domain.objects | map(attribute='name') | join(', ') | upper }}"
    )
    text = PromptLibrary(tmp_path).render(PromptKind.SYSTEM, domain=burger)
    assert text.startswith("2 robot: 3 lettuce: ")
    assert " --- 7  |x   7 a,b " in text
    assert text.endswith("STOVE, BOARD")


def test_half_characters_are_replaced(tmp_path: Path, burger: Domain) -> None:
    (tmp_path / "system.j2").write_text("{{ '\\ud800' }}{{ '\\ud83e\\udd16' }}")
    assert PromptLibrary(tmp_path).render(PromptKind.SYSTEM, domain=burger) == "\ufffd🤖"
