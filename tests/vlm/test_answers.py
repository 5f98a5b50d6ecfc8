"""What is mended on receipt, and the forms in which models write down their reasoning."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from skillwrapper.symbols import Atom
from skillwrapper.vlm.answers import answer_of, clean_text
from skillwrapper.vlm.parsing import parse_labels
from skillwrapper.vlm.protocol import ModelReply

ATOM = Atom("holding", ("robot", "patty"))
ANSWER = "holding(robot, patty): false"
THOUGHT = "holding(robot, patty): true\nNo, it lies on the stove. holding(robot, patty) is true?"

REASONED = {
    "tags": f"<think>{THOUGHT}</think>\n{ANSWER}",
    "no opening tag": f"{THOUGHT}</think>{ANSWER}",
    "the tag twice": f"<think>x <think>{THOUGHT}</think>{ANSWER}",
    "closed twice": f"<think>x</think>{THOUGHT}</think>{ANSWER}",
    "after the answer": f"{ANSWER}\n<think>{THOUGHT}</think>",
    "never closed": f"{ANSWER}\n<thinking>{THOUGHT}",
    "attributes": f'<think id="1">{THOUGHT}</think>{ANSWER}',
    "capitals": f"<THINK>{THOUGHT}</THINK>{ANSWER}",
    "thinking": f"<thinking>{THOUGHT}</thinking>{ANSWER}",
    "reasoning": f"<reasoning>{THOUGHT}</reasoning>{ANSWER}",
    "thought": f"<thought>\n{THOUGHT}\n</thought>\n{ANSWER}",
    "scratchpad": f"<scratchpad>{THOUGHT}</scratchpad>{ANSWER}",
    "scratch pad": f"<SCRATCH_PAD>{THOUGHT}</SCRATCH_PAD>{ANSWER}",
    "analysis": f"<analysis>{THOUGHT}</analysis>{ANSWER}",
    "reflection": f"<thinking>x<reflection>{THOUGHT}</reflection>{THOUGHT}</thinking>{ANSWER}",
    "output tag": f"<thinking>{THOUGHT}</thinking><output>{ANSWER}</output>",
    "answer tag": f"{THOUGHT}\n<answer>\n{ANSWER}\n</answer>",
    "answer tag without an end": f"{THOUGHT}\n<answer>\n{ANSWER}",
    "square brackets": f"[THINK]{THOUGHT}[/THINK]{ANSWER}",
    "triangles": f"◁think▷{THOUGHT}◁/think▷{ANSWER}",
    "fullwidth": f"\uff1cthink\uff1e{THOUGHT}\uff1c/think\uff1e{ANSWER}",
    "with a name": f"<seed:think>{THOUGHT}</seed:think>{ANSWER}",
    "escaped": f"&lt;think&gt;{THOUGHT}&lt;/think&gt;{ANSWER}",
    "begin and end of thought": f"<|begin_of_thought|>{THOUGHT}<|end_of_thought|>"
    f"<|begin_of_solution|>{ANSWER}<|end_of_solution|>",
    "start and end": f"<|START_THINKING|>{THOUGHT}<|END_THINKING|>"
    f"<|START_RESPONSE|>{ANSWER}<|END_RESPONSE|>",
    "channels": f"<|channel|>analysis<|message|>{THOUGHT}<|end|><|start|>assistant"
    f"<|channel|>final<|message|>{ANSWER}<|return|>",
    "channels after a commentary": f"<|channel|>commentary<|message|>{THOUGHT}<|end|>"
    f"<|start|>assistant<|channel|>final<|message|>{ANSWER}",
    "channels without their signs": f"analysisWe must judge. {THOUGHT}assistantfinal{ANSWER}",
    "a channel of thought": f"<|channel>thought\n{THOUGHT}\n<channel|>{ANSWER}",
    "unused tokens": f"<unused94>thought\n{THOUGHT}<unused95>{ANSWER}",
    "prefixes": f"<|inner_prefix|>{THOUGHT}<|inner_suffix|>{ANSWER}",
    "a fence": f"```thinking\n{THOUGHT}\n```\n{ANSWER}",
    "details": f'<details type="reasoning">\n<summary>Thought for 3 s</summary>\n{THOUGHT}\n'
    f"</details>\n{ANSWER}",
    "done thinking": f"Thinking...\n{THOUGHT}\n...done thinking.\n\n{ANSWER}",
    "a final answer": f"{THOUGHT}\n\n**Final Answer:**\n{ANSWER}",
    "a response": f"Here is my thought process:\n{THOUGHT}\n\nHere is my response:\n{ANSWER}",
    "a final response": f"{THOUGHT}\n[BEGIN FINAL RESPONSE]\n{ANSWER}\n[END FINAL RESPONSE]",
    "the next turn": f"{ANSWER}<|im_end|>\n<|im_start|>user\nAre you sure?<|im_end|>\n{THOUGHT}",
    "a template": f"<|im_start|>assistant\n<think>{THOUGHT}</think>{ANSWER}<|im_end|>",
    "a field": f'{{"reasoning": "{THOUGHT[:27]}", "labels": {{"{ATOM}": false}}}}',
    "a field of steps": f'{{"thoughts": ["{THOUGHT[:27]}"], "answer": ["{ANSWER}"]}}',
    "a field below": f"Statement: {ATOM}\nReasoning: {THOUGHT[:27]}\nVerdict: false",
}
UNFINISHED = {
    "tags": f"<think>{THOUGHT}",
    "square brackets": f"[THINK]{THOUGHT}",
    "channels": f"<|channel|>analysis<|message|>{THOUGHT}",
    "bare channels": f"analysisWe must judge.\n{THOUGHT}",
    "triangles": f"◁think▷{THOUGHT}",
    "a fence": f"```thinking\n{THOUGHT}",
    "only thoughts": f"<think>{THOUGHT}</think>",
}


@pytest.mark.parametrize("reply", REASONED.values(), ids=REASONED)
def test_reasoning_is_no_answer(reply: str) -> None:
    assert parse_labels(reply, [ATOM]).labels == {ATOM: False}


@pytest.mark.parametrize("reply", UNFINISHED.values(), ids=UNFINISHED)
def test_reasoning_that_does_not_end_is_no_answer(reply: str) -> None:
    assert answer_of(reply).strip() == ""
    assert parse_labels(reply, [ATOM]).labels == {}


PIECES = st.sampled_from(
    [
        "<think>", "</think>", "<thinking>", "[THINK]", "[/THINK]", "<|channel|>", "final", "\n",
        "analysis", "<|message|>", "<|end|>", "<answer>", "</answer>", "Final answer:", "```",
        "```thinking\n", "<|im_end|>", "<s>", "a: true", "assistantfinal", " ", "&lt;", "◁think▷",
    ]
)  # fmt: skip


@given(st.lists(PIECES, max_size=25).map("".join))
def test_an_answer_holds_no_reasoning_that_could_be_left_out(reply: str) -> None:
    answer = answer_of(reply)
    assert len(answer) <= len(reply) + reply.count(">") + reply.count("]")
    assert "</think>" not in answer
    assert "<|channel|>" not in answer or "<|channel|>" in reply


@pytest.mark.parametrize(
    ("sent", "kept"),
    [
        ("a\ud800b", "a\ufffdb"),
        ("\udc00", "\ufffd"),
        ("a\r\nb\rc\u2028d\x85e", "a\nb\nc\nd\ne"),
        ("\x1b[31mred\x1b[0m", "red"),
        ("\x1b[1;38;5;196mred", "red"),
        ("\x9b31mred", "red"),
        ("\x1b]0;title\x07text", "text"),
        ("\x1b]8;;http://x\x1b\\link\x1b]8;;\x1b\\", "link"),
        ("\x1bPq#0\x1b\\text", "text"),
        ("\x1b(Btext\x1b7", "text"),
        ("tab\tand\nline", "tab\tand\nline"),
        ("nul\x00bell\x07back\x08del\x7f", "nulbellbackdel"),
        ("zero\u200bwidth\ufeff \u202eturned\u2066", "zerowidth turned"),
        ("日本 ß é 🍔", "日本 ß é 🍔"),
    ],
)
def test_signs_are_mended_on_receipt(sent: str, kept: str) -> None:
    assert clean_text(sent) == kept
    assert ModelReply(sent).text == kept


@given(st.text(st.characters(), max_size=80) | st.text("\x1b[]01;m\x9b\ud800\x07\\\n", max_size=40))
def test_whatever_is_received_can_be_written_and_shown(sent: str) -> None:
    text = ModelReply(sent).text
    text.encode("utf-8")
    assert "\x1b" not in text
    assert "\x9b" not in text
    assert clean_text(text) == text


def test_signs_that_json_spells_out_are_mended_too() -> None:
    reply = r'{"holding(robot, patty)": false, "note\ud800": "\u001b[31mred"}'
    parsed = parse_labels(reply, [ATOM])
    assert parsed.labels == {ATOM: False}
    "".join(parsed.unusable).encode("utf-8")
