"""The folder of a run, and the only code that reads and writes it.

config.yaml        what was asked for, with the format, versions and commit
domain.yaml        the domain as it was
episodes/          001.jsonl ...: where an episode started, then a line each skill
images/            <sha256>.png
calls.sqlite       every model call
iterations/001/    truth table, predicates, operators, decisions, certificate, summary
model/             domain.pddl, predicates.yaml, model.json
events.jsonl       what happened when
corrections.jsonl  what people have corrected, if they have
imported.json      the model that a person has edited and imported last, if they have
curve.json         how true the model was after each iteration, if somebody measured it

Episodes, pictures, calls, corrections and imports are what a run cannot compute again; everything
else follows from them, and is written anew by a resumed run where it is missing or damaged.
"""

from skillwrapper.runs.archive.archive import ArchivedIteration, RunArchive
from skillwrapper.runs.archive.episode_files import EpisodeFile
from skillwrapper.runs.archive.labels import RecordedLabels
from skillwrapper.runs.archive.making import (
    discard_beginning,
    make_archive,
    reserved,
    restate_settings,
)
from skillwrapper.runs.archive.writer import ArchiveWriter

__all__ = [
    "ArchiveWriter",
    "ArchivedIteration",
    "EpisodeFile",
    "RecordedLabels",
    "RunArchive",
    "discard_beginning",
    "make_archive",
    "reserved",
    "restate_settings",
]
