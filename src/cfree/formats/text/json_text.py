"""Convert JSON text to Python values with exact numbers and back; explain text that is not JSON."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from decimal import Decimal, InvalidOperation
from typing import Any

from cfree.exact.number import MAX_DIGITS
from cfree.formats.text.findings import Findings
from cfree.formats.text.json_positions import shortened


class Literal(str):
    """A number as written."""

    __slots__ = ()


def read_json(findings: Findings) -> Any:
    """Read JSON with exact numbers: an int, a Decimal, or text if no coordinate may be so long.

    Syntax errors are raised; other faults that the decoder accepts are noted.
    """
    return _without_faults(findings, number_of)


def read_literals(findings: Findings) -> Any:
    """Read JSON with numbers as written, see `read_json`."""
    return _without_faults(findings, Literal)


def read_members(findings: Findings, made: Callable[[dict[str, Any]], object]) -> Any:
    """Read JSON with a value made of each object as soon as it is read; None if `read_literals` would note faults."""
    data, irregular = _decoded(findings, Literal, made)
    return None if irregular else data


def _without_faults(findings: Findings, number: Callable[[str], object]) -> Any:
    data, irregular = _decoded(findings, number, lambda members: members)
    if irregular:
        findings.irregular_json()
    return data


def _decoded(
    findings: Findings, number: Callable[[str], object], made: Callable[[dict[str, Any]], object]
) -> tuple[Any, bool]:
    """Decode JSON; also True if there are faults that the decoder accepts."""
    irregular = False

    def constant(literal: str) -> Decimal:
        nonlocal irregular
        irregular = True
        return Decimal(literal)

    def unique(pairs: list[tuple[str, object]]) -> object:
        nonlocal irregular
        members = dict(pairs)
        irregular = irregular or len(members) < len(pairs)
        return made(members)

    data: object = None
    try:
        data = json.loads(
            findings.text,
            parse_float=number,
            parse_int=number,
            parse_constant=constant,
            object_pairs_hook=unique,
        )
    except json.JSONDecodeError as error:
        findings.at(error.pos, "", _syntax_fault(findings.text, error))
    except RecursionError:
        findings.at(_deepest(findings.text), "", "brackets are nested too deeply; a scene needs six levels")
    if data is None:
        findings.fail_if_any()
    return data, irregular


def with_numbers(data: Any) -> Any:
    """Replace the literals in decoded JSON by their numbers."""
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


def number_of(literal: str) -> int | Decimal | str:
    """Return the number of a literal; one that no coordinate may be stays text, which its reader refuses."""
    if len(literal) > MAX_DIGITS:
        return str(literal)
    try:
        return int(literal) if literal.lstrip("-").isdigit() else Decimal(literal)
    except InvalidOperation:
        return str(literal)


def json_line(value: object) -> str:
    """Return the JSON of a value on one line; decimals keep their digits.

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
    got = shortened(re.split(r"[\s,\]}]", rest, maxsplit=1)[0] or rest[0])
    expected = error.msg.removeprefix("Expecting ").replace("value", "a value")
    expected = expected.replace("property name enclosed in double quotes", 'a "key"')
    remedy = _REMEDIES.get(rest[0], "")
    if rest[0] in "]}" and text[: error.pos].rstrip().endswith(","):
        remedy = "; remove the comma before it"
    return f"expected {expected}, got {got}{remedy}"


_REMEDIES = {
    ".": "; write a digit before the point",
    "'": '; use double quotes "',
    "/": "; JSON has no comments, use the note",
}


def _deepest(text: str) -> int:
    """Return the first offset at which brackets are 100 deep."""
    depth = 0
    for match in re.finditer(r'"(?:[^"\\]++|\\.)*+"|[\[{]|[\]}]', text, re.DOTALL):
        depth += {"[": 1, "{": 1, "]": -1, "}": -1}.get(match[0], 0)
        if depth == 100:
            return match.start()
    return 0
