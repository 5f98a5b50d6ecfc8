"""Settings that all cells of an experiment have in common: the tree of a run, and how to solve."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, field_validator

from skillwrapper.planning.hypotheses.settings import HypothesesSettings
from skillwrapper.planning.planner import PlannerSettings
from skillwrapper.runs.settings import ModelSettings, RunSettings, SharedSettings


class ExperimentSettings(SharedSettings):
    """The settings of a run but for domain and seed (docs/semantics.md, D22), and of solving.

    A domain, a seed and a noise are what cells differ in.
    """

    planner: PlannerSettings = Field(
        default_factory=PlannerSettings, description="how plans are looked for"
    )
    readings: Literal["single", "hypotheses"] = Field(
        default="single",
        description="how start and goal are taken: as they are read (single), or as what likely "
        "lies behind it (hypotheses), of which one after the other is tried",
    )
    hypotheses: HypothesesSettings = Field(
        default_factory=HypothesesSettings, description="how hypotheses are tried"
    )
    actions: int = Field(
        default=35,
        ge=1,
        description="skills that a method without a planner may execute for one problem",
        json_schema_extra={"unit": "skills"},
    )

    @field_validator("model")
    @classmethod
    def _noise_is_given_elsewhere(cls, given: ModelSettings) -> ModelSettings:
        if given.noise != "none":
            raise ValueError("expected the noise as 'noise: [...]' of the experiment")
        return given

    def run(self, domain: str, seed: int, noise: str) -> RunSettings:
        """The settings of a run of the whole method.

        Args:
            domain: reference to the domain.
            seed: decides everything left to chance.
            noise: noise profile of the embedded model, or a rate.
        """
        shared = {name: getattr(self, name) for name in SharedSettings.model_fields}
        shared["model"] = self.model.model_copy(update={"noise": noise})
        return RunSettings(domain=domain, seed=seed, **shared)
