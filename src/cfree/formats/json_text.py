"""JSON text to Python values with exact numbers and back, and what to say when it is not JSON."""

from __future__ import annotations

import json
import re
from decimal import Decimal, InvalidOperation
from typing import Any

from cfree.exact.number import MAX_DIGITS
from cfree.formats.findings import Findings
from cfree.formats.json_positions import shortened


class Literal(str):
    """A number as it is written."""

    __slots__ = ()


def read_json(findings: Findings) -> Any:
    """JSON with exact numbers: an int, a Decimal, or text where no coordinate may be so long.

    What breaks the syntax is raised, what the decoder would let pass is noted.
    """
    return with_numbers(read_literals(findings))


def read_literals(findings: Findings) -> Any:
    """The same with numbers as they are written."""
    irregular = False

    def constant(literal: str) -> Decimal:
        nonlocal irregular
        irregular = True
        return Decimal(literal)

    def unique(pairs: list[tuple[str, object]]) -> dict[str, object]:
        nonlocal irregular
        members = dict(pairs)
        irregular = irregular or len(members) < len(pairs)
        return members

    data: object = None
    try:
        data = json.loads(
            findings.text,
            parse_float=Literal,
            parse_int=Literal,
            parse_constant=constant,
            object_pairs_hook=unique,
        )
    except json.JSONDecodeError as error:
        findings.at(error.pos, "", _syntax_fault(findings.text, error))
    except RecursionError:
        findings.at(_deepest(findings.text), "", "brackets are nested too deeply; a scene needs six levels")
    if data is None:
        findings.fail_if_any()
    if irregular:
        findings.irregular_json()
    return data


def with_numbers(data: Any) -> Any:
    """Decoded JSON, its literals replaced by what they stand for."""
    whole = [data]
    waiting: list[Any] = [whole]
    while waiting:
        container = waiting.pop()
        for key, part in container.items() if isinstance(container, dict) else enumerate(container):
            if isinstance(part, Literal):
                container[key] = number_of(part)
            elif isinstance(part, (list, dict)):
                waiting.append(part)
    return whole[0]


def number_of(literal: Literal) -> int | Decimal | str:
    """What a literal stands for; one that no coordinate may be is left as text, for others to refuse."""
    if len(literal) > MAX_DIGITS:
        return str(literal)
    try:
        return int(literal) if literal.lstrip("-").isdigit() else Decimal(literal)
    except InvalidOperation:
        return str(literal)


def json_line(value: object) -> str:
    """JSON of a value on one line; decimals have the digits that they have.

    Examples
    --------
    >>> json_line({"at": [Decimal("0.10000000000000000000001"), 2.0, "x"]})
    '{"at": [0.10000000000000000000001, 2.0, "x"]}'
    """
    if isinstance(value, dict):
        return f"{{{', '.join(f'{json.dumps(key)}: {json_line(part)}' for key, part in value.items())}}}"
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(map(json_line, value))}]"
    return str(value) if isinstance(value, Decimal) else json.dumps(value)


def _syntax_fault(text: str, error: json.JSONDecodeError) -> str:
    if not text.strip():
        return "the file is empty; give a scene in JSON"
    rest = text[error.pos :].lstrip()
    if not rest or error.msg.startswith("Unterminated string"):
        return "the file ends in the middle of a value; is it complete?"
    if error.msg == "Extra data":
        return f"expected the end of the file, got {shortened(rest)}"
    if error.msg.startswith("Invalid"):
        return f"{error.msg.removesuffix(' at').lower()} in a string; escape it as JSON does"
    found = shortened(re.split(r"[\s,\]}]", rest, maxsplit=1)[0] or rest[0])
    expected = error.msg.removeprefix("Expecting ").replace("value", "a value")
    expected = expected.replace("property name enclosed in double quotes", 'a "key"')
    remedy = _REMEDIES.get(rest[0], "")
    if rest[0] in "]}" and text[: error.pos].rstrip().endswith(","):
        remedy = "; remove the comma before it"
    return f"expected {expected}, got {found}{remedy}"


_REMEDIES = {
    ".": "; write a digit before the point",
    "'": '; use double quotes "',
    "/": "; JSON has no comments, use the note",
}


def _deepest(text: str) -> int:
    """Where brackets are 100 deep for the first time."""
    depth = 0
    for match in re.finditer(r'"(?:[^"\\]++|\\.)*+"|[\[{]|[\]}]', text, re.DOTALL):
        depth += {"[": 1, "{": 1, "]": -1, "}": -1}.get(match[0], 0)
        if depth == 100:
            return match.start()
    return 0
