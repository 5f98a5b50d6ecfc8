"""What providers say when they refuse a call: one table, read from top to bottom.

Providers say the same thing in many ways and with many status numbers, so their words count first
and the status second. ``ROWS`` says of every kind of error which exception it becomes, whether
another attempt may work (those that become a ``TemporaryProviderError``), and what to do.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection
from dataclasses import dataclass

from skillwrapper.errors import (
    AuthenticationError,
    ModelCapabilityError,
    ModelNotFoundError,
    ModelUnavailableError,
    ProviderError,
    TemporaryProviderError,
    UnusableReplyError,
)
from skillwrapper.vlm.openai_dialect import Feature, NotUnderstoodError

Maker = Callable[[str], ProviderError]
"""Makes an exception of a message."""


@dataclass(frozen=True)
class Row:
    """One kind of error.

    Attributes:
        name: of the kind.
        make: our exception for it.
        advice: what to do; empty where waiting is all.
        statuses: with which it comes; empty for any.
        words: what providers say, in any of their forms; None if the status says enough.
        wait_is_told: whether it is of this kind only if the provider says how long to wait.
    """

    name: str
    make: Maker
    advice: str
    statuses: Collection[int] = ()
    words: re.Pattern[str] | None = None
    wait_is_told: bool = False

    def fits(self, status: int, said: str, wait: float | None) -> bool:
        """Whether an error is of this kind."""
        if self.statuses and status not in self.statuses:
            return False
        if self.wait_is_told and wait is None:
            return False
        return self.words is None or self.words.search(said) is not None


def row_of(status: int, said: str, wait: float | None) -> Row:
    """The first row that an error fits.

    Args:
        status: HTTP status.
        said: the provider's words, with codes and names of parameters.
        wait: seconds that the provider asks to wait; None if it does not say.
    """
    return next(row for row in ROWS if row.fits(status, said, wait))


def _refused(message: str) -> ProviderError:
    return UnusableReplyError(message, "refused")


def _does_without(feature: Feature) -> Maker:
    return lambda message: NotUnderstoodError(message, feature)


def _words(*forms: str) -> re.Pattern[str]:
    return re.compile("|".join(forms), re.IGNORECASE)


def _unknown_parameter(name: str) -> re.Pattern[str]:
    """A parameter that an endpoint does not know, or of which it takes one value only."""
    unknown = (
        r"(?:unsupported|not (?:be )?(?:supported|permitted|allowed)|(?:does not|doesn't) support|"
        r"unknown|unrecogni[sz]ed|unexpected|deprecated|extra (?:inputs|fields)|"
        r"invalid (?:field|parameter|argument|request argument))"
    )
    return _words(rf"{unknown}.{{0,90}}\b{name}\b", rf"\b{name}\b.{{0,90}}{unknown}")


_REFUSED = range(400, 500)
_BUSY = frozenset({408, 409, 424, 425, 429, 498, 502, 503, 504, 529})
_BELIEVED = frozenset(range(200, 600)) - _BUSY
"""Statuses that do not speak against what the words say; some servers say 500 for everything."""
_NO_KEY_IS_GOOD = "set the environment variable OPENAI_API_KEY to a valid key of this provider"
CHECK_ADDRESS = (
    "check that --base-url is the address of an OpenAI-compatible endpoint (most end in /v1)"
)
_TOP_UP = "top up the account, then resume the run"
_REWORD = "reword the prompt templates or choose another model"
_PICTURES = r"(?:images?|image_url|pictures?|photos?|vision|visual|multi-?modal)"
_NOT_TAKEN = (
    r"(?:not (?:\w+ )?(?:support|accept|allow|enabl|permit)|unsupported|"
    r"n[o']t (?:support|accept|allow|enabl|have)|only supported|no endpoints? found|"
    r"unknown (?:variant|content|part)|invalid content|unrecogni[sz]ed|missing data required)"
)

ROWS: tuple[Row, ...] = (
    Row(
        "content filter",
        _refused,
        _REWORD,
        _BELIEVED,
        _words(
            r"content[ _-]?(?:filter|policy|management)",
            r"responsible ?ai",
            r"moderation",
            r"flagged (?:as|by|for)",
            r"safety (?:system|filter|reason|polic)",
            r"usage polic",
            r"prohibited[_ ]content",
            r"blocked.{0,40}(?:safety|polic|filter)",
            r"violat.{0,40}polic",
            r"data_?inspection",
            r"(?:inappropriate|sensitive|unsafe) (?:content|words)",
            r"content exists risk",
            r"不安全|敏感(?:内容|词)|违规",
        ),
    ),
    Row(
        "daily limit",
        ModelUnavailableError,
        "resume the run when the provider counts anew, or ask for a higher limit",
        (429,),
        _words(r"per[- ]?day", r"\bdaily\b", r"\b[rt]pd\b", r"usage limits?\b.{0,80}\bregain"),
    ),
    Row(
        "request too large for the rate",
        ModelCapabilityError,
        "ask for fewer groundings at once, send smaller pictures (--image-size), or get a higher "
        "limit",
        (429,),
        _words(r"request too large"),
    ),
    Row(
        "no credit, by its code",
        ModelUnavailableError,
        _TOP_UP,
        (429,),
        _words("insufficient_quota"),
    ),
    Row("busy, and says until when", TemporaryProviderError, "", (429,), wait_is_told=True),
    Row("payment required", ModelUnavailableError, _TOP_UP, (402,)),
    Row(
        "no credit",
        ModelUnavailableError,
        _TOP_UP,
        (400, 401, 403, 429),
        _words(
            r"insufficient[_ ](?:quota|balance|credit|fund)",
            r"\bcredits?\b",
            r"exceeded your (?:current|monthly) (?:quota|spend)",
            r"billing",
            r"payment required",
            r"in arrears",
            r"top up",
            r"spending limit",
            r"key limit exceeded",
            r"余额不足|欠费",
            r"balance (?:is )?(?:too low|not enough|insufficient)",
        ),
    ),
    Row(
        "region",
        ProviderError,
        "the provider does not serve this place; use another endpoint",
        _REFUSED,
        _words(
            r"(?:country|region|territory|location).{0,40}not supported",
            r"unsupported_country",
            r"not available in your (?:country|region)",
        ),
    ),
    Row(
        "model not for this key",
        ModelNotFoundError,
        "choose a model that your key may use, or ask the provider for it",
        (400, 401, 403, 404),
        _words(
            r"not have (?:access|permission).{0,60}model",
            r"model.{0,80}not have access",
            r"model.{0,60}(?:not allowed|no access|gated)",
            r"must be verified to use",
            r"model.{0,40}requires? (?:a|an|the) .{0,20}(?:subscription|plan|tier)\b",
        ),
    ),
    Row("wrong key", AuthenticationError, _NO_KEY_IS_GOOD, (401,)),
    Row(
        "proxy wants a login",
        AuthenticationError,
        "put user and password into the proxy's address, in the environment",
        (407,),
    ),
    Row(
        "wrong key, in words",
        AuthenticationError,
        _NO_KEY_IS_GOOD,
        (400, 403, 404, 422, 500),
        _words(
            r"api[ _-]?key.{0,40}(?:invalid|incorrect|expired|revoked|missing|required|wrong)",
            r"api[ _-]?key.{0,20}not (?:valid|found|provided)",
            r"(?:invalid|incorrect|expired|revoked|missing|wrong|bad)[ _-](?:x-)?api[ _-]?key",
            r"(?:invalid|bad|missing|no)[ _-](?:auth\w*|credentials?|bearer|access token)\b",
            r"unauthori[sz]ed",
            r"unauthenticated",
            r"authentication[_ ](?:error|fail)",
            r"subscription key",
            r"api[ _-]?key.{0,40}must be set",
        ),
    ),
    Row(
        "busy, by the words",
        TemporaryProviderError,
        "",
        (400, 403, 499),
        _words(r"rate[ -]limit", r"try again (?:later|in)", r"client closed"),
    ),
    Row(
        "kept out by a firewall",
        ProviderError,
        "something in front of the provider keeps this machine out; use another endpoint",
        (403,),
        _words(r"error code:? 10\d\d", r"cloudflare", r"access denied.{0,40}(?:ip|firewall|waf)\b"),
    ),
    Row(
        "output limit too high",
        ProviderError,
        "lower --max-output-tokens",
        _BELIEVED,
        _words(
            r"max(?:_completion|_output|_new)?_tokens.{0,80}"
            r"(?:too large|too high|at most|exceed|must be|less than|maximum)",
            r"at most \d+ completion tokens",
            r"range of max(?:_completion|_output|_new)?_tokens",
        ),
    ),
    Row(
        "no system role",
        _does_without(Feature.SYSTEM_ROLE),
        "give the model a chat template with a system role",
        _BELIEVED,
        _words(
            r"(?:system|developer).{0,30}(?:role|messages?|prompts?|instructions?)\b.{0,60}"
            r"(?:not (?:be )?(?:support|allow|enabl|permit|accept|valid)|unsupported|invalid)",
            r"(?:not support|unsupported|unexpected|invalid|unknown).{0,40}"
            r"(?:system|developer)\W{0,3}(?:role|message|prompt|instruction)",
            r"(?:unknown|invalid|unsupported|unexpected) (?:message )?role\W{0,4}system",
            r"roles? (?:must|should) alternate",
            r"\brole\b.{0,40}n[o']t support\W{0,3}(?:system|developer)\b",
            r"only user and assistant",
            r"first message (?:must|should) be.{0,20}user",
        ),
    ),
    Row(
        "no max_completion_tokens",
        _does_without(Feature.MAX_COMPLETION_TOKENS),
        "leave out --max-output-tokens",
        _BELIEVED,
        _unknown_parameter(r"max(?:_completion)?_tokens"),
    ),
    Row(
        "no temperature",
        _does_without(Feature.TEMPERATURE),
        "leave out --temperature",
        _BELIEVED,
        _unknown_parameter("temperature"),
    ),
    Row(
        "no reasoning effort",
        _does_without(Feature.REASONING_EFFORT),
        "leave out --reasoning-effort, or choose another",
        _BELIEVED,
        _words(
            _unknown_parameter(r"reasoning(?:[_.]?effort)?").pattern,
            r"(?:does not|doesn't) support (?:thinking|reasoning)",
            r"(?:thinking|reasoning)(?: mode)? is not supported",
            r"invalid\W{0,3}reasoning[_.]?effort",
        ),
    ),
    Row(
        "picture too large",
        ModelCapabilityError,
        "send smaller pictures (--image-size)",
        _BELIEVED,
        _words(
            rf"{_PICTURES}.{{0,60}}(?:too (?:large|big)|dimensions?\b|"
            r"exceeds?.{0,40}(?:bytes|[km]b\b|pixels|size))"
        ),
    ),
    Row(
        "picture not read",
        ModelCapabilityError,
        "it takes no pictures in PNG, or not of this size (--image-size); choose another endpoint",
        _BELIEVED,
        _words(
            r"(?:could not|cannot|can't|unable to|failed to) "
            rf"(?:process|load|decode|read|identify) (?:the |input |an )?{_PICTURES}\b",
            rf"{_PICTURES} (?:is|are) not valid",
            r"invalid[_ ](?:image|base64)(?:[_ ](?:format|data|type))?\b(?! ?url)",
        ),
    ),
    Row(
        "too many pictures",
        ModelCapabilityError,
        "choose a model that takes several pictures in one call, or let the server allow it (vLLM: "
        "--limit-mm-per-prompt)",
        _BELIEVED,
        _words(
            r"(?:at most|up to|maximum(?: of)?|only|more than|limit(?:ed)?(?: of| to)?|exceeds?) "
            r"(?!0)(?:\d+|one|(?:a )?single) {0,2}(?:image|picture|photo)",
            r"too many (?:images|pictures)",
            r"(?:images|pictures|image count).{0,40}(?:limit|maximum|at most|exceed|more than)",
            r"(?:multiple|several) (?:images|pictures).{0,30}not",
            r"not support (?:multiple|several) (?:images|pictures)",
        ),
    ),
    Row(
        "no pictures",
        ModelCapabilityError,
        "choose a model that accepts pictures",
        _BELIEVED,
        _words(
            rf"\b{_PICTURES}\b.{{0,80}}{_NOT_TAKEN}",
            rf"{_NOT_TAKEN}.{{0,80}}\b{_PICTURES}\b",
            r"not a (?:multi-?modal|vision)",
            r"mmproj",
            r"at most 0 (?:image|picture)",
            r"content.{0,60}(?:must be|should be|expected)(?: an?)?(?: valid)? string",
            r"invalid value\W{0,3}image_url",
        ),
    ),
    Row(
        "context too short",
        ModelCapabilityError,
        "choose a model with a longer context, or ask for fewer groundings at once",
        _BELIEVED,
        _words(
            r"context.{0,20}(?:length|window|size|limit|exceed)",
            r"(?:maximum|max|full) context",
            r"too many (?:input |prompt )?tokens",
            r"(?:prompt|input|message|request).{0,40}too (?:long|large)",
            r"max_model_len",
            r"token (?:limit|count).{0,30}exceed",
            r"exceeds? .{0,40}(?:tokens|context)",
            r"(?:input|prompt) (?:length|tokens?).{0,40}exceed",
            r"range of input length",
        ),
    ),
    Row(
        "unknown model",
        ModelNotFoundError,
        "check the name of the model",
        frozenset(_REFUSED) - _BUSY,
        _words(
            r"model.{0,80}(?:not found|n[o']t exist|not (?:a )?valid|not available|not supported)",
            r"model.{0,80}(?:unknown|invalid|no longer|deprecated|decommissioned|retired)",
            r"(?:unknown|invalid|no such|unsupported|not find) (?:the )?model",
            r"not a valid model",
            r"model_?not_?found",
            r"no endpoints? found",
            r"deploymentnotfound",
            r"deployment.{0,40}not exist",
            r"pull(?:ing)? it first",
            r"models? (?:is )?not loaded",
            r"no models? (?:is |are )?loaded",
            r"not work with the specified model",
        ),
    ),
    Row("moved", ModelNotFoundError, CHECK_ADDRESS, range(300, 400)),
    Row(
        "no such path",
        ModelNotFoundError,
        f"check the name of the model, and {CHECK_ADDRESS}",
        (404, 405, 410, 501),
    ),
    Row(
        "HTTP where TLS is spoken",
        ModelNotFoundError,
        "write https:// in --base-url",
        (400,),
        _words(r"http request.{0,40}https"),
    ),
    Row("forbidden", AuthenticationError, _NO_KEY_IS_GOOD, (403,)),
    Row("body too large", ModelCapabilityError, "send smaller pictures (--image-size)", (413,)),
    Row("unavailable for legal reasons", _refused, _REWORD, (451,)),
    Row(
        "model too large for its machine",
        ModelCapabilityError,
        "choose a smaller model, or give the server more memory",
        range(500, 600),
        _words(r"requires more (?:system |gpu |video )?memory"),
    ),
    Row("busy", TemporaryProviderError, "", _BUSY),
    Row("server error", TemporaryProviderError, "", range(500, 600)),
    Row("other", ProviderError, "the provider does not accept this request"),
)
"""From the most particular to the most general; the last one fits everything."""
