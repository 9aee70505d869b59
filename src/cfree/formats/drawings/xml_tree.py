"""Read XML, packed by gzip or not, as a tree of small nodes with their lines.

Entities are short texts of the file itself, which drawing programs write for the names of their namespaces. No other
file is opened.
"""

from __future__ import annotations

import re
import zlib
from dataclasses import dataclass, field
from xml.parsers import expat

from cfree.formats.drawings.source import DEEPEST, MOST_BYTES, Source, read_bytes
from cfree.formats.text.findings import InvalidFileError

LONGEST_ENTITY = 200
MOST_WITH_ENTITIES = 1 << 22
"""Maximum size of a file with entities; expanded, it is at most fifty times as large."""


XLINK = "http://www.w3.org/1999/xlink"
INKSCAPE = "http://www.inkscape.org/namespaces/inkscape"


@dataclass(slots=True)
class Node:
    """An element; names are without their namespaces.

    Attributes
    ----------
    space : str
        The namespace of the element; empty if it has none.
    text : str
        The text in a style sheet; empty for all other elements.
    """

    tag: str
    attributes: dict[str, str]
    line: int
    children: list[Node] = field(default_factory=list)
    space: str = ""
    text: str = ""


def read_tree(source: Source) -> Node:
    """Read the root element of the file."""
    parser = expat.ParserCreate(namespace_separator=" ")
    top = Node("", {}, 1)
    open_nodes = [top]
    texts: list[str] = []

    def start(name: str, attributes: dict[str, str]) -> None:
        source.spend()
        if len(open_nodes) > DEEPEST:
            source.refuse(f"elements nested more than {DEEPEST} deep; flatten the groups", parser.CurrentLineNumber)
        space, _, tag = name.rpartition(" ")
        plain = attributes if not any(map(_FOREIGN, attributes)) else _own(attributes)
        node = Node(tag, plain, parser.CurrentLineNumber, space=space)
        open_nodes[-1].children.append(node)
        open_nodes.append(node)

    def end(name: str) -> None:
        node = open_nodes.pop()
        if node.tag == "style":
            node.text = "".join(texts)
            texts.clear()

    def text(data: str) -> None:
        if open_nodes[-1].tag == "style":
            texts.append(data)

    def instruction(target: str, data: str) -> None:
        if target == "xml-stylesheet":
            source.note("guess", "style sheet of another file: not read", "unknown")

    def entity(name: str, is_parameter: int, value: str | None, *rest: object) -> None:
        plain = not is_parameter and value is not None and "&" not in value and len(value) <= LONGEST_ENTITY
        if not plain or len(raw) > MOST_WITH_ENTITIES:
            source.refuse(
                f"entity {name}: only texts of up to {LONGEST_ENTITY} characters are read, in files of up to "
                f"{MOST_WITH_ENTITIES >> 10:,} KiB; write what it stands for",
                parser.CurrentLineNumber,
            )

    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.CharacterDataHandler, parser.ProcessingInstructionHandler = text, instruction
    parser.buffer_text = True
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


_FOREIGN = re.compile(" ").search


def _own(attributes: dict[str, str]) -> dict[str, str]:
    """Return attributes without a namespace, links of XLink, and labels of Inkscape; all others move no shape."""
    plain = {key: value for key, value in attributes.items() if " " not in key}
    for key in (f"{XLINK} href", f"{INKSCAPE} label"):
        if key in attributes:
            plain.setdefault(key.rpartition(" ")[2], attributes[key])
    return plain


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
