"""Running commands in the process of the test, or in one that starts with nothing but the code."""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import sys
from collections.abc import Mapping, Sequence
from multiprocessing.process import BaseProcess
from pathlib import Path

from skillwrapper.cli.main import main, run

_APART = multiprocessing.get_context("forkserver")
# Loading the code takes longer than most commands; so it is loaded once, then forked.
_APART.set_forkserver_preload([__name__, "skillwrapper.cli.main", "skillwrapper.vlm.openai_model"])


def command(*words: str | Path) -> int:
    """Run a command; its exit code."""
    before, sys.argv = sys.argv, ["skillwrapper", *map(str, words)]
    try:
        main()
    except SystemExit as ended:
        return int(ended.code or 0)
    finally:
        sys.argv = before
    return 0


def begun(words: Sequence[str], said: Path) -> BaseProcess:
    """A command that has begun in a process of its own; all that it says goes into a file."""
    process = _APART.Process(target=_run_main, args=(words, dict(os.environ), said))
    process.start()
    return process


def commands_apart(
    lines: Sequence[Sequence[str]], environment: Mapping[str, str], where: Path
) -> str:
    """All that commands say in a process of their own, with this environment, in this folder."""
    said = where.with_name(f"{where.name}-said")
    process = _APART.Process(target=_run_all, args=(lines, dict(environment), where, said))
    process.start()
    process.join(300)
    process.kill()
    text = said.read_text()
    said.unlink()
    assert "Traceback" not in text
    assert process.exitcode == 0, text
    return text


def _run_all(
    lines: Sequence[Sequence[str]], environment: dict[str, str], where: Path, said: Path
) -> None:
    _speak_into(said, environment)
    os.chdir(where)
    for line in lines:
        sys.argv = ["skillwrapper", *line]
        with contextlib.suppress(SystemExit):
            run()
        sys.stdout.flush()


def _run_main(words: Sequence[str], environment: dict[str, str], said: Path) -> None:
    _speak_into(said, environment)
    sys.argv = ["skillwrapper", *words]
    main()


def _speak_into(said: Path, environment: dict[str, str]) -> None:
    os.environ.clear()
    os.environ.update(environment)
    target = os.open(said, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
    for stream in (sys.stdout, sys.stderr):
        os.dup2(target, stream.fileno())
