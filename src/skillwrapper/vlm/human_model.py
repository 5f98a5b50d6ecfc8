"""A person as the model: asked in the terminal, and told which picture to open."""

from __future__ import annotations

import re
import shutil
import sys
import tempfile
import threading
import weakref
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from skillwrapper.errors import LimitReachedError
from skillwrapper.vlm.protocol import ModelReply, ModelRequest, Role

Ask = Callable[[str], str]
"""Puts a question to the person, and gives what was typed."""

_VERDICTS = {"y": "true", "n": "false", "?": "unsure"}
_HOW = "y, n, ? (cannot tell), several at once (yyn?), b (one back), q (leave)"
_CAPTION = re.compile(r"^- Picture (\d+): (.*)$", re.MULTILINE)
_QUOTED = re.compile(r'"""\n(.*)\n"""', re.DOTALL)
_LEFT = "left; the same command goes on later, and asks nothing twice"
_NOTHING = "Nothing"


class HumanModel:
    """Somebody at the terminal. Replies are kept like those of any model.

    Statements about a picture are asked one by one; everything else is answered in the words that
    a model would use, ended by an empty line.

    Args:
        ask: puts questions.
    """

    name = "human"
    parameters: Mapping[str, str | int | float | bool] = {}

    def __init__(self, ask: Ask | None = None) -> None:
        self._ask = ask or ask_in_terminal
        self._lock = threading.Lock()  # one question at a time, however many are in flight
        self._folder: Path | None = None

    def complete(self, request: ModelRequest) -> ModelReply:
        """Put a question, and wait.

        Raises:
            LimitReachedError: if the person leaves.
        """
        with self._lock:
            return ModelReply(self._answer(request))

    def close(self) -> None:
        """Take away the pictures that were shown."""
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)
            self._folder = None

    def _answer(self, request: ModelRequest) -> str:
        said = _QUOTED.search(request.prompt)
        if request.role is Role.SUMMARISE and said:
            return said[1]  # what a person said is as short as a summary
        statements = _section(request.prompt, "Statements")
        if request.role is Role.EVALUATE and statements:
            return self._judge(request, statements)
        return self._write(request)

    def _judge(self, request: ModelRequest, statements: Sequence[str]) -> str:
        """A verdict on every statement."""
        meanings = dict(_split_meaning(line) for line in _section(request.prompt, "Predicates"))
        verdicts: list[str] = []
        shown, meaning = self._shown(request), ""
        while len(verdicts) < len(statements):
            statement = statements[len(verdicts)]
            name = statement.partition("(")[0]
            told = f"{name}: {meanings.get(name, '')}\n"
            asked = f"  {len(verdicts) + 1}/{len(statements)} {statement}? [{_HOW}]: "
            typed = self._typed(shown + (told if told != meaning else "") + asked)
            shown, meaning = "", told
            given = [sign for sign in typed.casefold() if not sign.isspace()]
            if given == ["b"]:
                del verdicts[-1:]
            elif set(given) <= set(_VERDICTS) and len(given) <= len(statements) - len(verdicts):
                verdicts += [_VERDICTS[sign] for sign in given]
        return "\n".join(f"{s}: {v}" for s, v in zip(statements, verdicts, strict=True))

    def _write(self, request: ModelRequest) -> str:
        """Free lines up to an empty one."""
        asked = f"\n{request.prompt.strip()}\n{self._shown(request)}"
        lines = [self._typed(f"{asked}Your answer, ended by an empty line (q to leave):\n")]
        while lines[-1].strip():
            lines.append(self._typed(""))
        return "\n".join(lines).strip() or _NOTHING

    def _typed(self, question: str) -> str:
        try:
            typed = self._ask(question)
        except EOFError as error:
            raise LimitReachedError(_LEFT) from error
        if typed.strip().casefold() == "q":
            raise LimitReachedError(_LEFT)
        return typed

    def _shown(self, request: ModelRequest) -> str:
        """Which pictures to open; always the same files, for a viewer that reloads them."""
        captions = dict(_CAPTION.findall(request.prompt))
        if self._folder is None:
            self._folder = Path(tempfile.mkdtemp(prefix="skillwrapper-"))
            weakref.finalize(self, shutil.rmtree, self._folder, ignore_errors=True)
        lines = []
        for number, picture in enumerate(request.pictures, start=1):
            path = self._folder / f"picture_{number}.png"
            path.write_bytes(picture.png)
            lines.append(f"\nPicture {number} ({captions.get(str(number), 'now')}): open {path}")
        return "".join(lines) + "\n"


def ask_in_terminal(question: str) -> str:
    """Put a question on standard error; the answer is a line of standard input."""
    sys.stderr.write(question)
    sys.stderr.flush()
    return input()


def _section(prompt: str, title: str) -> list[str]:
    """The lines of a list below a heading."""
    body = prompt.partition(f"\n## {title}\n")[2].partition("\n## ")[0]
    return [line[2:].strip() for line in body.splitlines() if line.startswith("- ")]


def _split_meaning(line: str) -> tuple[str, str]:
    signature, _, meaning = line.partition(": ")
    return signature.partition("(")[0], meaning
