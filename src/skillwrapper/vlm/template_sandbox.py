"""Templates that users write: they cannot run code, loop for ever, or grow without bound.

Jinja's sandbox keeps templates from code. It bounds neither loops nor sizes, so every pass through
a loop and every call of a macro counts here, and so does the size of what operators and filters
make. Filters and methods whose work does not follow from what they are given are not there.
"""

from __future__ import annotations

import math
import traceback
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from functools import wraps
from pathlib import Path
from types import BuiltinMethodType
from typing import Any

import jinja2
from jinja2 import nodes
from jinja2.sandbox import ImmutableSandboxedEnvironment
from jinja2.visitor import NodeTransformer

from skillwrapper.errors import ConfigurationError
from skillwrapper.vlm.template_bounds import (
    FILTERS,
    LONGEST_TEXT,
    METHODS,
    MULTIPLYING,
    TooMuchError,
    check_form,
    extent,
    size_made,
    weight,
)

MOST_STEPS = 100_000
"""Passes through loops, calls of macros, and hundreds of characters made, in one rendering."""
_LARGEST_NUMBER = 10**30
_SIZE_OF_A_STEP = 100
_STEP, _JOINED = "_step", "_joined"
_MISTAKES = "a mistake in it"


class TemplateSandbox(ImmutableSandboxedEnvironment):
    """Compiles and renders the templates of some folders.

    Args:
        folders: where templates are looked for, the first ones first.
    """

    intercepted_binops = frozenset({"+", "*", "**", "%"})

    def __init__(self, folders: Sequence[Path]) -> None:
        super().__init__(
            loader=jinja2.ChoiceLoader([jinja2.FileSystemLoader(folder) for folder in folders]),
            undefined=jinja2.StrictUndefined,
            trim_blocks=True,
            lstrip_blocks=True,
            autoescape=False,
            auto_reload=False,
            finalize=self._bounded,
        )
        self._steps: ContextVar[list[int]] = ContextVar("steps")
        del self.globals["lipsum"]
        self.globals |= {_STEP: self._count_step, _JOINED: self._join}
        self.filters = {name: self._limited(name, self.filters[name]) for name in FILTERS}

    def source_of(self, name: str) -> tuple[nodes.Template, str]:
        """The parsed template of a name, and the file that it stands in.

        Raises:
            ConfigurationError: if it is missing, no UTF-8, or not well formed; with file and line.
        """
        with self.told(name):
            if self.loader is None:
                raise jinja2.TemplateNotFound(name)
            text, file, _ = self.loader.get_source(self, name)
            return self.parse(text, name, file), file or name

    def render_bounded(self, template: jinja2.Template, variables: dict[str, Any]) -> str:
        """Fill in a template.

        Raises:
            ConfigurationError: if that fails or takes too much; with file and line.
        """
        token = self._steps.set([0])
        try:
            with self.told(template.name or "a template"):
                parts, size = [], 0
                for part in template.generate(variables):
                    size += len(part)
                    if size > LONGEST_TEXT:
                        raise TooMuchError(f"a prompt of more than {LONGEST_TEXT:,} characters")
                    parts.append(part)
                return _whole_characters("".join(parts))
        finally:
            self._steps.reset(token)

    @contextmanager
    def told(self, name: str) -> Iterator[None]:
        """Turn whatever goes wrong with a template into one sentence with file and line."""
        try:
            yield
        except ConfigurationError:
            raise
        except jinja2.TemplateSyntaxError as error:
            places = [place for place in (error.filename, error.name) if place]
            place = next((place for place in places if place.endswith(".j2")), name)
            raise _mistake(place, error.lineno, error.message or _MISTAKES) from error
        except jinja2.TemplateNotFound as error:
            said = f"there is no template '{error.name}' to include or import"
            raise _mistake(*_place(error, name), said) from error
        except RecursionError as error:
            raise _mistake(name, None, "expected less nesting and recursion") from error
        except UnicodeDecodeError as error:
            raise _mistake(name, None, "expected UTF-8 text") from error
        except Exception as error:  # a template may raise anything: it is a program of the user's
            said = " ".join(str(error).split()) or type(error).__name__
            raise _mistake(*_place(error, name), said) from error

    def call_binop(self, context: Any, operator: str, left: Any, right: Any) -> Any:
        """Bound what an operator may make."""
        for number in (left, right):
            if isinstance(number, int | float) and abs(number) > _LARGEST_NUMBER:
                raise TooMuchError("a number that is too large")
        if operator == "**" and isinstance(right, int) and abs(right) > 100:
            raise TooMuchError("a power that is too large")
        if operator == "%" and isinstance(left, str):
            raise TooMuchError("expected the filter 'format' in place of the operator %")
        if operator in {"*", "+"}:
            self._spend(size_made(operator, left, right))
        return super().call_binop(context, operator, left, right)

    def is_safe_attribute(self, obj: Any, attr: str, value: Any) -> bool:
        """Whether something may be used: of plain values only what makes no more than there is."""
        unbounded = isinstance(value, BuiltinMethodType) and attr not in METHODS
        return not unbounded and super().is_safe_attribute(obj, attr, value)

    def wrap_str_format(self, value: Any) -> Callable[..., str] | None:
        """A text's ``format``, unless the text asks for filling."""
        form = getattr(value, "__self__", None)
        if isinstance(form, str):
            check_form(form)
        wrapped: Callable[..., str] | None = super().wrap_str_format(value)
        return wrapped

    def _limited(self, name: str, function: Callable[..., Any]) -> Callable[..., Any]:
        """A filter that spends steps for what it may make."""
        hidden = 1 if hasattr(function, "jinja_pass_arg") else 0

        @wraps(function)
        def limited(*args: Any, **options: Any) -> Any:
            above, (value, *more) = args[:hidden], args[hidden:]
            if name == "join":
                value = self._joined_parts(value, options.pop("attribute", None), *more[1:])
                more = more[:1]
            if name == "format":
                check_form(str(value))
            sizes = [weight(value), *(extent(part) for part in (*more, *options.values()))]
            self._spend(math.prod(max(1, size) for size in sizes) if name in MULTIPLYING
                        else sum(sizes))  # fmt: skip
            return function(*above, value, *more, **options)

        return limited

    def _joined_parts(self, values: Iterable[Any], attribute: str | int | None) -> list[Any]:
        """What is joined, itself or an attribute of each."""
        if attribute is None:
            return list(values)
        return list(map(jinja2.filters.make_attrgetter(self, attribute), values))

    def _parse(self, source: str, name: str | None, filename: str | None) -> nodes.Template:
        parsed = super()._parse(source, name, filename)
        counted: nodes.Template = _Counting().visit(parsed)
        return counted

    def _count_step(self) -> str:
        self._spend(0)
        return ""

    def _join(self, *parts: object) -> str:
        return "".join([str(self._bounded(part)) for part in parts])

    def _bounded(self, value: Any) -> Any:
        """A value that is about to become text."""
        self._spend(weight(value))
        return value

    def _spend(self, size: int) -> None:
        """Count a step that makes something of a size, in characters or parts."""
        if size > LONGEST_TEXT:
            raise TooMuchError(f"a text or list of more than {LONGEST_TEXT:,}")
        steps = self._steps.get([0])
        steps[0] += 1 + size // _SIZE_OF_A_STEP
        if steps[0] > MOST_STEPS:
            raise TooMuchError(f"loops of more than {MOST_STEPS:,} steps")


class _Counting(NodeTransformer):
    """Makes every loop and macro count its steps, and every ``~`` look at its size."""

    def generic_visit(self, node: nodes.Node, *args: Any, **kwargs: Any) -> nodes.Node:
        """Visit what is in a node, then the node."""
        super().generic_visit(node, *args, **kwargs)
        if isinstance(node, nodes.For | nodes.Macro | nodes.CallBlock):
            step = _call(_STEP, [], node.lineno)
            node.body.insert(0, nodes.ExprStmt(step, lineno=node.lineno))
        if isinstance(node, nodes.Concat):
            return _call(_JOINED, node.nodes, node.lineno)
        return node


def _call(name: str, arguments: list[nodes.Expr], line: int) -> nodes.Call:
    function = nodes.Name(name, "load", lineno=line)
    return nodes.Call(function, arguments, [], None, None, lineno=line)


def _whole_characters(text: str) -> str:
    """A text without halves of characters, which cannot be sent."""
    return text.encode("utf-16", "surrogatepass").decode("utf-16", "replace")


def _place(error: BaseException, name: str) -> tuple[str, int | None]:
    """File and line in a template where an error comes from: the innermost one."""
    frames = traceback.extract_tb(error.__traceback__)
    inside = [frame for frame in frames if frame.filename.endswith(".j2")]
    return (inside[-1].filename, inside[-1].lineno) if inside else (name, None)


def _mistake(place: str, line: int | None, said: str) -> ConfigurationError:
    where = f"prompt template {place}" + (f", line {line}" if line else "")
    return ConfigurationError(f"{where}: {said}")
