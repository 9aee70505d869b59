"""Read DXF: the outlines of a layout, with the layer as role and name; ezdxf reads the file.

The tags are mended first (`dxf_tags`); then the entities are walked over, blocks expanded (`dxf_walk`). Frame and unit
are the drawing's.
"""

from __future__ import annotations

import json
import logging
from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence
from io import BytesIO
from typing import Any, Literal

from cfree.errors import FormatError
from cfree.formats.drawings.dxf_tags import BINARY, Entity, Tags, described, essential, mended
from cfree.formats.drawings.dxf_walk import DRAWING, PAINT, Layers, Place, Walk
from cfree.formats.drawings.outlines import shapes_of_drawing
from cfree.formats.drawings.signals import ask
from cfree.formats.drawings.source import Source, read_bytes
from cfree.formats.scenes.scene_settings import read_settings
from cfree.formats.shapes import Shapes
from cfree.formats.text.extras import needed

UNITS = {
    1: "in",
    2: "ft",
    3: "mi",
    4: "mm",
    5: "cm",
    6: "m",
    7: "km",
    9: "mil",
    10: "yd",
    12: "nm",
    13: "um",
    14: "dm",
    15: "dam",
    16: "hm",
}
"""Units by their codes in $INSUNITS."""
PROPERTY = "cfree"
"""The property of the file that holds the settings of a scene, as JSON."""
MOST_BYTES = 1 << 25


def read_dxf(source: Source) -> Shapes:
    """Read the outlines of a drawing."""
    needed("ezdxf", "dxf", "DXF")
    logging.getLogger("ezdxf").addHandler(logging.NullHandler())  # its repairs are counted below

    raw = read_bytes(source.findings.file, MOST_BYTES)
    tags = mended(raw)
    _note_lost(source, tags)
    if tags.mended:
        source.note("mended", "entity without subclass markers", count=tags.mended)
    try:
        document, faults = _loaded(source, tags)
        code = int(document.header.get("$INSUNITS", 0))
        text = next((value for tag, value in document.header.custom_vars if tag == PROPERTY), "{}")
        layers = _layers(document)
        layout = _layout(source, document)
        entities = list(layout)
    except Exception as error:  # a damaged file raises any of them
        if isinstance(error, FormatError):
            raise
        source.refuse(f"{str(error)[:100] or type(error).__name__}; give DXF")
    if faults:
        source.note("mended", "fault of the file, mended by ezdxf", count=faults)
    walk = Walk(source, layers, tags)
    walk.all(entities, Place())
    _note_heights(source, walk)
    _note_blocks(source, document, entities)
    content = walk.content()
    ask(source, content)
    settings = read_settings(source.findings, _object(text), (PROPERTY,))
    if unit := UNITS.get(code, source.reading.units if not code else ""):
        settings = {"units": unit} | settings
    elif code:
        source.note("warning", "unit that has no name here: the scene has none", "none", handle=f"$INSUNITS {code}")
    return shapes_of_drawing(source, "DXF", content, settings, 'call a layer "robot"')


def _note_lost(source: Source, tags: Tags) -> None:
    for lost in tags.lost:
        what = f"{lost.kind} that cannot be read: {lost.fault}"
        source.note("lost", what, "less", where=lost.layer, handle=described(lost))


def _loaded(source: Source, tags: Tags) -> tuple[Any, int]:
    """Return the document, and the number of faults that ezdxf mended.

    A file that ezdxf refuses is tried without its tables and objects, and then without the entities that it refuses.
    """
    from ezdxf import recover

    try:
        document, audit = recover.read(BytesIO(tags.raw))
    except Exception:  # a damaged file raises any of them
        if tags.raw.startswith(BINARY) or b"ENTITIES" not in tags.raw:
            raise
        raw = essential(tags.raw)
        source.note("mended", "damaged file, read without tables: all layers are visible", "more")
        try:
            document, audit = recover.read(BytesIO(raw))
        except Exception:
            tags = mended(raw, _fault)
            document, audit = recover.read(BytesIO(tags.raw))
            _note_lost(source, tags)
    _note_removed(source, tags, document)
    return document, len(audit.fixes)


def _note_removed(source: Source, tags: Tags, document: Any) -> None:
    """Note the entities that ezdxf removed while it mended the file."""
    left = [entity for block in document.blocks for entity in block]
    handles, counts = {entity.dxf.handle for entity in left}, Counter(entity.dxftype() for entity in left)
    of_kind: dict[str, list[Entity]] = defaultdict(list)
    for entity in tags.entities:
        if entity.kind not in PAINT:
            of_kind[entity.kind].append(entity)
    for kind, entities in of_kind.items():
        removed = [entity for entity in entities if entity.handle not in handles or not entity.handle]
        count = len(entities) - counts[kind]
        for entity in sorted(removed, key=lambda entity: not entity.handle)[: max(count, 0)]:
            what = f"{kind} that is removed, since it is not valid" if kind in DRAWING else f"{kind} entity"
            source.note("lost", what, "less", where=entity.layer, handle=described(entity))


def _fault(tags: Sequence[tuple[int, bytes]]) -> str:
    """Return the reason why ezdxf refuses an entity, or an empty text."""
    from ezdxf.entities import factory
    from ezdxf.lldxf.extendedtags import ExtendedTags

    text = "".join(f"{code}\n{value.decode(errors='replace')}\n" for code, value in tags)
    try:
        factory.load(ExtendedTags.from_text(text))
    except Exception as error:  # of many types
        return str(error)[:80] or type(error).__name__
    return ""


def _object(text: str) -> Any:
    try:
        return json.loads(text)
    except (ValueError, RecursionError):
        return {}


def _layers(document: Any) -> Layers:
    layers = list(document.layers)
    unplotted = {layer.dxf.name.lower() for layer in layers if not layer.dxf.get("plot", 1)} | {"defpoints"}
    return Layers(
        frozenset(layer.dxf.name.lower() for layer in layers if layer.is_off()),
        frozenset(layer.dxf.name.lower() for layer in layers if layer.is_frozen()),
        frozenset(unplotted),
    )


def _drawn(entities: Iterable[Any]) -> int:
    return sum(entity.dxftype() in DRAWING for entity in entities)


def _layout(source: Source, document: Any) -> Any:
    """Return the layout to read: the wanted one, the model space, or the first that draws; note the others."""
    names = list(document.layouts.names_in_taborder())
    counts = {name: _drawn(document.layouts.get(name)) for name in names}
    model = names[0]
    wanted = source.reading.space
    if wanted:
        chosen = next((name for name in names if name.lower() == wanted.lower()), "")
        if not chosen:
            source.refuse(f"no layout {wanted!r}; give one of {', '.join(names)}")
    else:
        chosen = model if counts[model] else next((name for name in names if counts[name]), model)
        if chosen != model:
            source.note("info", "paper space, read since the model space is empty", where=chosen)
    for name in names:
        if name != chosen and counts[name]:
            what = "entity in the model space" if name == model else "entity in paper space"
            source.note("lost", what, "less", count=counts[name], where=name, remedy=f"--space {name}")
    return document.layouts.get(chosen)


def _note_heights(source: Source, walk: Walk) -> None:
    low, high = walk.heights
    if low == high and low:
        source.note("info", "elevation", size=low)
    elif low < high:
        source.note("info", "drawing with heights, seen from above", "more", size=high - low)


def _note_blocks(source: Source, document: Any, entities: Iterable[Any]) -> None:
    """Note blocks that nothing inserts; they are a loss if nothing else is drawn."""
    used = set()
    for block in document.blocks:
        used |= {entity.dxf.get("name", "").lower() for entity in block if entity.dxftype() == "INSERT"}
    for layout in document.layouts:
        used |= {entity.dxf.get("name", "").lower() for entity in layout if entity.dxftype() == "INSERT"}
    for block in document.blocks:
        if not block.name.startswith(("*", "_")) and block.name.lower() not in used and _drawn(block):
            kind: Literal["info", "lost"] = "info" if _drawn(entities) else "lost"
            source.note(kind, "block that nothing inserts", where=block.name)
