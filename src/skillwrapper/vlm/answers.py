"""From what a model sent to what it answers: signs mended on receipt, reasoning left out.

Both are done here and nowhere else; docs/models.md lists the forms of reasoning.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

_PLAIN = b"\t\n" + bytes(range(32, 127))
_LINE_BREAKS = re.compile(r"\r\n?|[\v\f\x85\u2028\u2029]")
_UNSEEN = r"\x00-\x08\x0e-\x1f\x7f-\x84\x86-\x9f\u200b-\u200f\u202a-\u202e\u2060-\u2069\ufeff"
_HAS_UNSEEN = re.compile(f"[{_UNSEEN}]")
_CONTROL = re.compile(
    r"(?:\x1b\[|\x9b)[0-?]{0,64}[ -/]{0,8}[@-~]?"  # colours and cursor movements of terminals
    r"|(?:\x1b[\]PX^_]|[\x90\x98\x9d-\x9f])[^\x07\x1b\x9c\n]{0,2000}+(?:\x07|\x1b\\|\x9c)?"
    rf"|\x1b[ -/]{{0,8}}[0-~]?|[{_UNSEEN}]"
)
_SURROGATE = re.compile(r"[\ud800-\udfff]")

_THINKING = (
    r"(?:[a-z]{1,12}[:_])?(?:think(?:ing)?|thoughts?|reason(?:ing)?|reflect(?:ion)?"
    r"|scratch[-_ ]?pad|analysis|deliberation|rationale|cot|chain[-_ ]of[-_ ]thoughts?"
    r"|(?:inner[-_ ])?monologue|details)"
)
_ANSWER = r"(?:final[-_ ]?)?(?:answer|response|output|solution)|final"
_TAG_SIGNS = "<[\u25c1\uff1c&"
_MOST_TAGS, _MOST_BRACKETS = 2_000, 40_000
"""A reply with more is noise; nothing of it is read."""
_TAG = re.compile(
    r"(?:[<\[\u25c1\uff1c]|&lt;)\|?"
    r"(?P<end>/|end[-_ ](?:of[-_ ])?|(?:begin|start)[-_ ](?:of[-_ ])?)?"
    rf"(?:(?P<thinking>{_THINKING})|(?P<answer>{_ANSWER}))"
    r"(?: \w{1,20}=[^<>\n]{0,80})?\|?(?:[>\]\u25b7\uff1e]|&gt;)",
    re.IGNORECASE,
)
_ALIASES = {
    "<unused94>thought": "<think>",
    "<unused95>": "</think>",
    "<|inner_prefix|>": "<think>",
    "<|inner_suffix|>": "</think>",
    "<channel|>": "<|end|>",
}
_CHANNEL = re.compile(r"<\|?(channel|message|start|end|return|call)\|?>")
_BARE_CHANNEL = re.compile(r"\s{0,20}analysis(?=[A-Z])")
_END_OF_TURN = re.compile(
    r"<\|(?:im_end|eot_id|end_of_text|endoftext|eom_id|eos|end_of_turn_token)\|>"
    r"|<end_of_turn>|<\uff5cend\u2581of\u2581sentence\uff5c>"
)
_TEMPLATE = re.compile(
    r"<\|(?:im_start|begin_of_text|start_header_id|assistant)\|>(?:assistant\b)?"
    r"(?:<\|end_header_id\|>)?|<start_of_turn>(?:model\b)?"
    r"|<\|(?:begin|end)_of_box\|>"
)
_TEMPLATE_SIGN = re.compile(r"<(?:[|\uff5c]|/?s>|unused9[45]>|channel\||(?:start|end)_of_turn>)")
_FENCE = re.compile(rf"```[ \t]{{0,4}}(?:{_THINKING})[ \t]{{0,20}}$", re.IGNORECASE | re.MULTILINE)
_ANSWER_BELOW = re.compile(
    r"^[^\w\n]{0,20}(?:begin final response|done thinking"
    r"|here (?:is|are) my (?:final )?(?:response|answer)s?"
    r"|(?:my |the )?final (?:answer|label|response|output|verdict|judge?ment|summary|plan"
    r"|proposal|sequence|predicate)s?)[^\w\n]{0,20}$",
    re.IGNORECASE | re.MULTILINE,
)
_BELOW_WORDS = ("final", "done thinking", "is my", "are my")


class _NoiseError(Exception):
    """A reply makes no sense."""


def clean_text(text: str) -> str:
    """What was received without what no text holds, in one pass.

    Lone surrogates become U+FFFD, all line breaks ``\\n``; escape sequences of terminals, control
    characters, and marks that cannot be seen or turn the direction of writing go.
    """
    if text.isascii() and not text.encode().translate(None, delete=_PLAIN):
        return text
    text = _SURROGATE.sub("\ufffd", _LINE_BREAKS.sub("\n", text))
    return _CONTROL.sub("", text) if _HAS_UNSEEN.search(text) else text


def answer_of(reply: str) -> str:
    """What a reply says after, and outside of, the model's reasoning; may be empty.

    Knows tags (``<think>``, ``[THINK]``, ``<reflection>`` ...), also if a server has cut off the
    opening one or the output limit the closing one; channels; fences; and the lines with which
    models begin their final answer. An answer in tags of its own is all that counts.
    """
    text = _of_last_channel(_of_first_turn(clean_text(reply)))
    return _below_announcement(_without_fences(_outside_of_tags(text)))


def _of_first_turn(text: str) -> str:
    """Without signs of chat templates, and without turns that a model invents after its own."""
    text = text.replace("[/INST]", "")
    if not _TEMPLATE_SIGN.search(text):
        return text
    for written, meant in _ALIASES.items():
        text = text.replace(written, meant)
    turns = (_TEMPLATE.sub("", turn) for turn in _END_OF_TURN.split(text))
    first = next((turn for turn in turns if turn.strip()), "").strip()
    return first.removeprefix("<s>").removesuffix("</s>")


def _of_last_channel(text: str) -> str:
    """The last ``final`` channel, if there are channels; also where their signs were removed."""
    if "assistantfinal" in text:
        return text.rpartition("assistantfinal")[2]
    if _BARE_CHANNEL.match(text):
        return ""
    if "channel" not in text:
        return text
    markers = list(_CHANNEL.finditer(text))
    if not any(marker.group(1) == "channel" for marker in markers):
        return text
    outside, final, channel = [text[: markers[0].start()]], None, ""
    for marker, following in zip(markers, [*markers[1:], None], strict=True):
        said = text[marker.end() : following.start() if following else None]
        if marker.group(1) == "channel":
            channel, _, said = said.lstrip().partition("\n")
            channel = channel.strip().casefold()
        elif marker.group(1) != "message":
            channel = ""
        if channel.startswith("final"):
            final = said
        elif not channel and marker.group(1) not in {"start", "call"}:
            outside.append(said)
    return final if final is not None else "".join(outside)


def _outside_of_tags(text: str) -> str:
    """Without reasoning in tags; only the part in answer tags, if there is one."""
    outside: list[str] = []
    answers: list[str] = []
    try:
        parts = list(_tagged_parts(text))
    except _NoiseError:
        return ""
    for kind, said in parts:
        if kind == "outside":
            outside.append(said)
        elif kind == "answer":
            answers.append(said)
        elif kind == "reasoning without a beginning":
            outside.clear()
            answers.clear()
    chosen = answers if any(answer.strip() for answer in answers) else outside
    return "\n".join(chosen)


def _tagged_parts(text: str) -> Iterator[tuple[str, str]]:
    """The text between tags with what it is; tags that do not open or close anything are kept."""
    open_tags: list[str] = []
    answering, start = False, 0
    for number, tag in enumerate(_tags(text)):
        if number == _MOST_TAGS:
            raise _NoiseError
        kind = "reasoning" if open_tags else "answer" if answering else "outside"
        yield kind, text[start : tag.start()]
        start = tag.end()
        closing = (tag.group("end") or "").casefold().startswith(("/", "end"))
        name = (tag.group("thinking") or "").casefold()
        if tag.group("answer"):
            answering = not closing and not open_tags
        elif not closing:
            open_tags += [name] * (name not in open_tags)
        elif name in open_tags:
            del open_tags[open_tags.index(name) :]
        else:
            open_tags.clear()
            yield "reasoning without a beginning", ""
    yield "reasoning" if open_tags else "answer" if answering else "outside", text[start:]


def _tags(text: str) -> Iterator[re.Match[str]]:
    """Tags of reasoning and answers; in square brackets only capitals are tags."""
    places = sorted(place for sign in _TAG_SIGNS for place in _places(text, sign))
    if len(places) > _MOST_BRACKETS:
        raise _NoiseError
    for place in places:
        tag = _TAG.match(text, place)
        if tag and (tag.group()[0] != "[" or tag.group().isupper()):
            yield tag


def _places(text: str, sign: str) -> Iterator[int]:
    place = text.find(sign)
    while place >= 0:
        yield place
        place = text.find(sign, place + 1)


def _below_announcement(text: str) -> str:
    """What stands below a line like ``Final answer:``, if there is one such line."""
    lowered = text.lower()
    if not any(words in lowered for words in _BELOW_WORDS):
        return text
    ends = [found.end() for found in _ANSWER_BELOW.finditer(text)]
    return text[ends[0] :] if len(ends) == 1 and text[ends[0] :].strip() else text


def _without_fences(text: str) -> str:
    """Without code fences that are marked as reasoning."""
    if "```" not in text:
        return text
    kept, start = [], 0
    for fence in _FENCE.finditer(text):
        if fence.start() >= start:
            kept.append(text[start : fence.start()])
            closing = text.find("```", fence.end())
            start = len(text) if closing < 0 else closing + 3
    return "".join((*kept, text[start:]))
