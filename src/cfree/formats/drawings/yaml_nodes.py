"""Read YAML with every value as written, and its place: numbers stay exact decimals."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

from cfree.exact.number import to_fraction
from cfree.formats.drawings.source import DEEPEST, Source
from cfree.formats.text.extras import needed
from cfree.formats.text.findings import Findings, InvalidFileError, read_text

MOST_BYTES = 1 << 18
"""Maximum size of YAML: it is read slowly, and no file of a map or a robot is as large."""


def read_nodes(source: Source) -> Any:
    """Read the root node of the file, a tree of PyYAML's nodes; None if it is empty."""
    yaml = needed("yaml", "ros", "YAML")
    text = read_text(Path(source.findings.file), MOST_BYTES)
    source.findings = Findings(source.findings.file, text)
    try:
        loader = yaml.BaseLoader(text)
        depth = 0
        for event in yaml.parse(text, Loader=yaml.BaseLoader):
            source.spend()
            depth += isinstance(event, yaml.CollectionStartEvent) - isinstance(event, yaml.CollectionEndEvent)
            if depth > DEEPEST:
                source.refuse(f"nested more than {DEEPEST} deep; flatten it", event.start_mark.line + 1)
        return loader.get_single_node()
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        line, column = (mark.line + 1, mark.column + 1) if mark else (1, 1)
        reason = getattr(error, "problem", None) or getattr(error, "reason", None) or "no YAML"
        source.refuse(f"{reason}; give YAML", line, column)
    except InvalidFileError:
        raise
    except (ValueError, RecursionError) as error:
        source.refuse(f"{error}; give YAML")


def members(node: Any) -> dict[str, Any]:
    """Return keys and value nodes of a mapping node; the last of equal keys counts."""
    if node is None or node.id != "mapping":
        return {}
    return {key.value: value for key, value in node.value if key.id == "scalar"}


def mappings(source: Source, node: Any) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield the key and the members of all mappings at any depth, in order; shared nodes once."""
    waiting, visited = [("", node)], {id(None)}
    while waiting:
        name, node = waiting.pop()
        source.spend()
        if id(node) in visited or node.id == "scalar":
            continue
        visited.add(id(node))
        if node.id == "mapping":
            yield name, members(node)
            waiting += [(key.value if key.id == "scalar" else "", value) for key, value in reversed(node.value)]
        else:
            waiting += [(name, value) for value in reversed(node.value)]


def written(source: Source, node: Any, depth: int = 3) -> str:
    """Return a value as text: a scalar, or a flow list of scalars."""
    source.spend()
    if node.id == "scalar":
        return str(node.value)
    if node.id == "sequence" and depth:
        return f"[{', '.join(written(source, part, depth - 1) for part in node.value)}]"
    return "{...}"


def above_zero(text: str) -> Fraction:
    """Read a length above 0."""
    value = to_fraction(text)
    if not Fraction(1, 10**9) < value < 10**9:
        raise ValueError(f"{text[:60]}; give a length above 0, from 1e-9 to 1e9")
    return value


def fault(source: Source, node: Any, place: str, message: str) -> None:
    """Note a fault of a node."""
    source.findings.at(node.start_mark.index, place, message)
