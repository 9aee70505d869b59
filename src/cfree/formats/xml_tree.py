"""XML as a tree of small nodes with their lines. Entities are refused, and nothing outside of the file is opened."""

from __future__ import annotations

from dataclasses import dataclass, field
from xml.parsers import expat

from cfree.formats.findings import InvalidFileError
from cfree.formats.source import DEEPEST, MOST_BYTES, Source, read_bytes


@dataclass(slots=True)
class Node:
    """An element: names without their namespaces."""

    tag: str
    attributes: dict[str, str]
    line: int
    children: list[Node] = field(default_factory=list)


def read_tree(source: Source) -> Node:
    """The root element of the file."""
    parser = expat.ParserCreate(namespace_separator=" ")
    top = Node("", {}, 1)
    open_nodes = [top]

    def start(name: str, attributes: dict[str, str]) -> None:
        source.spend()
        if len(open_nodes) > DEEPEST:
            source.refuse(f"elements nested more than {DEEPEST} deep; flatten the groups", parser.CurrentLineNumber)
        plain = {key.rpartition(" ")[2]: value for key, value in attributes.items()}
        node = Node(name.rpartition(" ")[2], plain, parser.CurrentLineNumber)
        open_nodes[-1].children.append(node)
        open_nodes.append(node)

    def end(name: str) -> None:
        open_nodes.pop()

    def entity(name: str, *rest: object) -> None:
        source.refuse(f"entity {name}: entities are not read; write what they stand for", parser.CurrentLineNumber)

    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.EntityDeclHandler = entity
    raw = read_bytes(source.findings.file, MOST_BYTES)
    try:
        parser.Parse(raw, True)
    except expat.ExpatError as error:
        source.refuse(f"{expat.ErrorString(error.code)}; give XML", error.lineno, error.offset + 1)
    except InvalidFileError:
        raise
    except (ValueError, LookupError) as error:  # an encoding that is none
        source.refuse(f"{error}; save the file as UTF-8 text")
    return top.children[0]
