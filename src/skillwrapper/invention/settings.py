"""Settings of learning with invention: a run's ``learning``."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from skillwrapper.learning.settings import LearnerSettings


class LearningSettings(LearnerSettings):
    """How predicates are invented, scored and pruned, and how operators are learned."""

    threshold: float = Field(
        default=0.6,
        ge=0.0,
        le=1.0,
        description="least score of a candidate predicate (the paper's h; 0.6 for its simulated "
        "kitchen, 0.5 for its robots)",
        json_schema_extra={"unit": "share of the transitions"},
    )
    attempts: int = Field(
        default=3,
        ge=1,
        description="how often the model is asked for one inconsistency (D8)",
        json_schema_extra={"unit": "questions"},
    )
    candidates: int = Field(
        default=5,
        ge=1,
        description="how many candidates are asked for at once; the best is kept (D6)",
        json_schema_extra={"unit": "predicates"},
    )
    max_inventions: int = Field(
        default=60,
        ge=0,
        description="upper bound on questions for predicates in one iteration",
        json_schema_extra={"unit": "questions"},
    )
    lift: bool = Field(
        default=True,
        description="whether a candidate that names an object that shares a type with others is "
        "lifted to a relation before it is judged (D8)",
    )
    rephrase: bool = Field(
        default=True,
        description="whether the model is asked how to word a candidate that is lifted; else, and "
        "where its answer is of no use, words are replaced",
    )
    widen: bool = Field(
        default=True,
        description="whether relations are widened to the widest type that a skill takes (D8)",
    )
    steady: bool = Field(
        default=True,
        description="whether predicates must read the same where the state is the same: at every "
        "start, if the domain declares that resets restore the state, and around failures",
    )
    steady_tolerance: float = Field(
        default=0.0,
        ge=0.0,
        le=0.5,
        description="at so many of the starts a predicate may read otherwise, by mistake",
        json_schema_extra={"unit": "share of the starts"},
    )
    starts: int = Field(
        default=6,
        ge=0,
        description="so many starts are looked at before anything is executed, where labels are "
        "decoded, resets bring the state back and show the same again: they tell which predicates "
        "are steady",
        json_schema_extra={"unit": "pictures"},
    )
    screen: bool = Field(
        default=True,
        description="whether candidates are read on the pictures of the inconsistency first, and "
        "everywhere only if they tell these apart",
    )
    rotate: bool = Field(
        default=True,
        description="whether every further question about an inconsistency shows another pair of "
        "it, and a candidate need tell only one of them apart",
    )
    reject_by_cause: bool = Field(
        default=True,
        description="whether a candidate that was rejected for one inconsistency is tried for "
        "others",
    )
    unnoticed: bool = Field(
        default=True,
        description="whether the model is asked what has changed where all successes of a skill "
        "change nothing in the vocabulary (D26)",
    )
    unnoticed_everywhere: bool = Field(
        default=True,
        description="whether that is asked of every change too: what else has changed (D26)",
    )
    look_alikes: bool = Field(
        default=True,
        description="whether the model is shown pictures that look alike though other things were "
        "done before them, and asked what is different, when nothing else is left to ask (D26)",
    )
    new_causes: bool = Field(
        default=True,
        description="whether predicates are asked for during an episode too, as soon as a new "
        "cause of inconsistency appears, if who explores looks at the model",
    )
    spare_retraction: bool = Field(
        default=True,
        description="whether no predicate is taken back whose absence brings back a violation",
    )
    keep_best: bool = Field(
        default=True,
        description="whether the vocabulary of an earlier iteration is taken up again if it "
        "leaves less inconsistent (D9)",
    )
    exchange: bool = Field(
        default=True,
        description="whether a dormant predicate may take the place of an active one, before the "
        "model is asked, if that leaves less inconsistent (D9)",
    )
    max_trials: int = Field(
        default=150,
        ge=0,
        description="upper bound on candidates with which everything is learned anew in one "
        "iteration; bounds the time that it takes",
        json_schema_extra={"unit": "predicates"},
    )
    prune: bool = Field(
        default=True, description="whether superfluous predicates are set dormant (D9)"
    )
    invention: Literal["pairs", "batch"] = Field(
        default="pairs",
        description="pairs asks for one predicate at a time, from what disagrees with the model; "
        "batch asks for all of them once, after the first iteration (FM Invent)",
    )
    batch_size: int = Field(
        default=20,
        ge=1,
        description="how many predicates batch asks for at most",
        json_schema_extra={"unit": "predicates"},
    )
