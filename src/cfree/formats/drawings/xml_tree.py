"""Read XML, packed by gzip or not, as a tree of small nodes with their lines.

Entities are short texts of the file itself, which drawing programs write for the names of their namespaces. No other
file is opened.
"""

from __future__ import annotations

import zlib
from dataclasses import dataclass, field
from xml.parsers import expat

from cfree.formats.drawings.source import DEEPEST, MOST_BYTES, Source, read_bytes
from cfree.formats.text.findings import InvalidFileError

LONGEST_ENTITY = 200
MOST_WITH_ENTITIES = 1 << 22
"""Maximum size of a file with entities; expanded, it is at most fifty times as large."""


@dataclass(slots=True)
class Node:
    """An element; names are without their namespaces."""

    tag: str
    attributes: dict[str, str]
    line: int
    children: list[Node] = field(default_factory=list)


def read_tree(source: Source) -> Node:
    """Read the root element of the file."""
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

    def entity(name: str, is_parameter: int, value: str | None, *rest: object) -> None:
        plain = not is_parameter and value is not None and "&" not in value and len(value) <= LONGEST_ENTITY
        if not plain or len(raw) > MOST_WITH_ENTITIES:
            source.refuse(
                f"entity {name}: only texts of up to {LONGEST_ENTITY} characters are read, in files of up to "
                f"{MOST_WITH_ENTITIES >> 10:,} KiB; write what it stands for",
                parser.CurrentLineNumber,
            )

    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.EntityDeclHandler = entity
    raw = _unpacked(source, read_bytes(source.findings.file, MOST_BYTES))
    try:
        parser.Parse(raw, True)
    except expat.ExpatError as error:
        source.refuse(f"{expat.ErrorString(error.code)}; give XML", error.lineno, error.offset + 1)
    except InvalidFileError:
        raise
    except (ValueError, LookupError) as error:  # an unknown encoding
        source.refuse(f"{error}; save the file as UTF-8 text")
    return top.children[0]


def _unpacked(source: Source, raw: bytes) -> bytes:
    if not raw.startswith(b"\x1f\x8b"):
        return raw
    packed = zlib.decompressobj(wbits=zlib.MAX_WBITS | 16)
    try:
        text = packed.decompress(raw, MOST_BYTES + 1)
    except zlib.error as error:
        source.refuse(f"damaged: {error}; pack it anew by gzip")
    if len(text) > MOST_BYTES:
        source.refuse(f"more than {MOST_BYTES >> 10:,} KiB when unpacked; give a smaller file")
    if not packed.eof:
        source.refuse("its end is missing; pack it anew by gzip")
    return text
