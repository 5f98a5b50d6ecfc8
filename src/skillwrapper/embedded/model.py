"""The embedded model: a stand-in for a vision-language model, behind the same protocol."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence

from skillwrapper.embedded.acting import plan_actions
from skillwrapper.embedded.chance import Chance
from skillwrapper.embedded.inventing import invent, invent_vocabulary
from skillwrapper.embedded.judging import judge_picture, summarise
from skillwrapper.embedded.lexicon import Lexicon
from skillwrapper.embedded.misreading import Misreading
from skillwrapper.embedded.noise import NO_NOISE, NoiseProfile
from skillwrapper.embedded.prompt_text import PromptText
from skillwrapper.embedded.proposing import propose_sequences
from skillwrapper.embedded.rephrasing import rephrase
from skillwrapper.embedded.sight import Eye, SceneReader, Sight, Sights, first_sight, sight_at
from skillwrapper.embedded.spoiling import spoil
from skillwrapper.embedded.words import Words
from skillwrapper.errors import ModelUnavailableError
from skillwrapper.usage import Usage
from skillwrapper.vlm.protocol import ModelReply, ModelRequest
from skillwrapper.world.observation import Picture

_ASKED_AGAIN = "\n\nThis is asked again (time "
_MOST_TIMEOUTS = 12
_CHARACTERS_PER_TOKEN = 4
_TOKENS_PER_PICTURE = 765
_VERSION = 3
"""Raised when replies change, so that stored replies of older versions are not served."""


class EmbeddedModel:
    """Answers prompts by looking at pixels.

    It gets the rendered prompt and PNG bytes and nothing else. The same seed, prompt and pictures
    give the same reply, also behind an HTTP server; only if a noise profile says that errors are
    not all due to the picture, the repetition number of a request matters as well. It is for
    trying, testing and simulation studies.

    Args:
        seed: what chance depends on, besides the prompt.
        noise: what goes wrong; nothing by default.
        readers: scene readers of the domains whose pictures it can make out.
        words: what those domains add to the words that everybody knows.
    """

    def __init__(
        self,
        seed: int = 0,
        noise: NoiseProfile = NO_NOISE,
        readers: Sequence[SceneReader] = (),
        words: Sequence[Words] = (),
    ) -> None:
        self._seed, self._noise = seed, noise
        self._eye = Eye(readers)
        self._lexicon = Lexicon(words)
        self._misreading = Misreading(noise, seed, self._lexicon.words.look_alikes)

    @property
    def name(self) -> str:
        """Provider and model."""
        return "embedded"

    @property
    def parameters(self) -> Mapping[str, str | int | float | bool]:
        """Everything that changes replies."""
        return {"seed": self._seed, "noise": self._noise.name, "version": _VERSION}

    def complete(self, request: ModelRequest) -> ModelReply:
        """Answer a prompt.

        Raises:
            ModelUnavailableError: if the noise profile lets every attempt time out.
        """
        began = time.perf_counter()
        pictures = [picture.sha256 for picture in request.pictures]
        # Who asks again, because a reply got lost on the way, is told the same once more.
        question = request.prompt.partition(_ASKED_AGAIN)[0]
        chance = Chance(self._seed, question, *pictures)
        asked = f"{request.prompt} {request.repetition}"
        sights = [self._look(picture, asked) for picture in request.pictures]
        text = self._answer(PromptText.of(question), sights, chance)
        if self._noise is not NO_NOISE:
            mishaps = Chance(self._seed, "mishaps", request.prompt, *pictures)
            self._wait_out(mishaps)
            text = spoil(text, self._noise, mishaps)
        return ModelReply(text, _usage(request, text, time.perf_counter() - began))

    def _look(self, picture: Picture, asked: str) -> Sight | None:
        sight = self._eye.look(picture.png, picture.sha256)
        return sight and self._misreading.of(sight, asked)

    def _wait_out(self, chance: Chance) -> None:
        """Timeouts are only counted, not waited for."""
        for _ in range(_MOST_TIMEOUTS):
            if not chance.happens(self._noise.timeouts):
                return
        raise ModelUnavailableError(f"embedded model: {_MOST_TIMEOUTS} attempts timed out")

    def _answer(self, prompt: PromptText, sights: Sights, chance: Chance) -> str:
        """What a prompt asks for is told by its sections, so that users may reword it."""
        if "Text" in prompt:
            return summarise(prompt)
        if "Least explored pairs" in prompt:
            return propose_sequences(prompt, chance)
        if "Statements" in prompt:
            return judge_picture(prompt, first_sight(sights), self._lexicon, chance)
        if "Run so far" in prompt:
            return plan_actions(prompt, *_now_and_goal(prompt, sights), self._lexicon, chance)
        if "Allowed parameters" in prompt:
            return self._invent(prompt, sights, chance)
        return "I can only answer prompts with the sections of the bundled templates."

    def _invent(self, prompt: PromptText, sights: Sights, chance: Chance) -> str:
        if "Candidate" in prompt:
            return rephrase(prompt)
        inventor = invent if "Executions" in prompt else invent_vocabulary
        return inventor(prompt, sights, self._lexicon, chance)


def _now_and_goal(prompt: PromptText, sights: Sights) -> tuple[Sight | None, Sight | None]:
    return (
        sight_at(sights, prompt.captions.get("now")),
        sight_at(sights, prompt.captions.get("the goal")),
    )


def _usage(request: ModelRequest, reply: str, seconds: float) -> Usage:
    """Tokens as a hosted model would count them, roughly; for nothing."""
    prompt = len(request.system) + len(request.prompt)
    return Usage(
        input_tokens=prompt // _CHARACTERS_PER_TOKEN + _TOKENS_PER_PICTURE * len(request.pictures),
        output_tokens=len(reply) // _CHARACTERS_PER_TOKEN,
        cost=0.0,
        seconds=seconds,
    )
