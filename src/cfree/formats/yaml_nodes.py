"""YAML with every value as it is written, and where: numbers stay the decimals they are."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from cfree.formats.extras import needed
from cfree.formats.findings import Findings, InvalidFileError, read_text
from cfree.formats.source import DEEPEST, Source

MOST_BYTES = 1 << 18
"""Of YAML: it is read slowly, and no map's or robot's has as much."""


def read_nodes(source: Source) -> Any:
    """The root node of the file, a tree of PyYAML's nodes; None if it is empty."""
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
    """Keys and value nodes of a mapping node, a later key before an earlier one."""
    if node is None or node.id != "mapping":
        return {}
    return {key.value: value for key, value in node.value if key.id == "scalar"}


def every(node: Any, keys: tuple[str, ...]) -> Iterator[tuple[str, Any]]:
    """All members of these names, wherever they are; shared nodes once."""
    waiting, seen = [node], {id(None)}
    while waiting:
        node = waiting.pop()
        if id(node) in seen or node.id == "scalar":
            continue
        seen.add(id(node))
        if node.id == "mapping":
            yield from ((key, value) for key, value in members(node).items() if key in keys)
            waiting += [value for _, value in reversed(node.value)]
        else:
            waiting += reversed(node.value)


def written(source: Source, node: Any, depth: int = 3) -> str:
    """A value as text: a scalar, or a flow list of such."""
    source.spend()
    if node.id == "scalar":
        return str(node.value)
    if node.id == "sequence" and depth:
        return f"[{', '.join(written(source, part, depth - 1) for part in node.value)}]"
    return "{...}"
