"""Style of SVG elements by CSS: sheets, style attributes and presentation attributes; only what moves or hides counts.

Later ones win: attribute, sheet by specificity, ``style``, ``!important`` of a sheet, ``!important`` of ``style``.
A rule that is not understood, such as one for a width of the window, is not obeyed. If it hides something, this is a
guess; if it moves something, the file is refused.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any
from xml.etree.ElementTree import Element

from cfree.formats.drawings.source import Source
from cfree.formats.drawings.xml_tree import Node
from cfree.formats.text.extras import needed

INHERITED = {
    "visibility": "visible", "fill": "", "fill-rule": "nonzero", "clip-rule": "nonzero", "stroke": "none",
    "stroke-width": "1", "stroke-linejoin": "miter", "stroke-linecap": "butt", "stroke-miterlimit": "4",
    "stroke-dasharray": "none", "font-size": "16px", "marker-start": "none", "marker-mid": "none", "marker-end": "none",
}  # fmt: skip
"""Properties that children inherit, with their first values; the empty fill is black that nobody asked for."""
OWN = {
    "display": "inline", "opacity": "1", "vector-effect": "none", "transform": "", "transform-origin": "",
    "transform-box": "view-box", "clip-path": "none", "mask": "none", "overflow": "", "filter": "none",
    "animation": "none", "animation-name": "none",
}  # fmt: skip
"""Properties of an element alone."""
SIZES = ("x", "y", "cx", "cy", "r", "rx", "ry", "width", "height", "d")
"""Attributes that CSS may override."""
MOVES = {*SIZES, "transform", "transform-origin", "transform-box", "translate", "rotate", "scale", "offset", "zoom",
         "offset-path", "offset-distance", "all"}  # fmt: skip
HIDES = {"display", "visibility", "clip-path", "mask", "overflow", "fill", "fill-rule", "content-visibility"}
_WORDS = {
    "visibility": {"visible", "hidden", "collapse"},
    "fill-rule": {"nonzero", "evenodd"},
    "clip-rule": {"nonzero", "evenodd"},
    "overflow": {"visible", "hidden", "scroll", "auto"},
    "transform-box": {"view-box", "fill-box", "content-box", "border-box", "stroke-box"},
}
_KNOWN = {*INHERITED, *OWN, *SIZES}
_SHEET_ONLY = {*SIZES, "transform", "animation", "animation-name", "transform-box"}  # no presentation attributes
_RENAMED = {"marker": ("marker-start", "marker-mid", "marker-end")}
_BESIDE = {"charset", "font-face", "keyframes", "-webkit-keyframes", "-moz-keyframes", "namespace", "page", "property",
           "counter-style", "font-feature-values", "color-profile"}  # fmt: skip
MOST_SHEET = 1 << 20
"""Maximum number of characters of the style sheets of a file."""

Style = Mapping[str, str]
Declaration = tuple[str, str, bool]
"""Property, value, and True if it is important."""


@dataclass(frozen=True, slots=True)
class _Rule:
    declarations: tuple[Declaration, ...]
    obeyed: bool = True


class Styles:
    """The styles of a file's elements."""

    def __init__(self, source: Source, root: Node) -> None:
        self.source = source
        self.css = needed("tinycss2", "svg", "SVG")
        self.selectors = needed("cssselect2", "svg", "SVG")
        self.matcher = self.selectors.Matcher()
        self.rules: dict[int, list[tuple[tuple[int, int, int], _Rule]]] = {}
        self.texts: dict[str, tuple[Declaration, ...]] = {}
        self.unsure: set[int] = set()
        self.count = 0
        self.looks_back = False
        sheets = [*_sheets(root)]
        if sum(len(sheet.text) for sheet in sheets) > MOST_SHEET:
            source.refuse(f"style sheets of more than {MOST_SHEET >> 10:,} KiB; give shorter ones", sheets[0].line)
        for sheet in sheets:
            self._read(sheet)
        if self.count:
            self._match(root)

    def declared(self, node: Node) -> dict[str, str]:
        """Return the properties that a file sets for an element, by CSS's order."""
        values = {
            key: value.strip()
            for key, value in node.attributes.items()
            if key in _KNOWN and key not in _SHEET_ONLY and _valid(key, value.strip())
        }
        inline = node.attributes.get("style")
        rules = self.rules.get(id(node), [])
        if not inline and not rules:
            return values
        own = self._declarations(inline, node) if inline else ()
        chosen = [rule.declarations for _, rule in rules if rule.obeyed]
        for important in (False, True):
            for declarations in (*chosen, own):
                values |= {key: value for key, value, mark in declarations if mark is important}
        for _, rule in rules:
            if not rule.obeyed:
                self._not_obeyed(node, rule)
        return values

    def _not_obeyed(self, node: Node, rule: _Rule) -> None:
        where = node.attributes.get("id", node.tag)
        if not any(key in MOVES or key in HIDES for key, _, _ in rule.declarations):
            self.source.note("paint", "rule of a style sheet not obeyed: it only paints", where=where)
        for key, value, _ in rule.declarations:
            if key in MOVES and node.tag != "svg":
                self.source.refuse(
                    f"{key}: {value[:60]!r} in a rule of the style sheet that is not read; write it at the element",
                    node.line,
                    place=node.tag,
                )
            if key in HIDES:
                self.unsure.add(id(node))
                self.source.note("guess", f"rule of a style sheet not obeyed: {key}", "unknown", where=where)

    # style sheets

    def _read(self, sheet: Node) -> None:
        kind, media = (sheet.attributes.get(key, "").strip().lower() for key in ("type", "media"))
        if kind not in ("", "text/css"):
            self.source.note("guess", f"style sheet of type {kind[:40]}: not read", "unknown")
            return
        rules = self.css.parse_stylesheet(sheet.text, skip_comments=True, skip_whitespace=True)
        self._rules(rules, _plain_media(media), {}, sheet)

    def _rules(self, rules: Iterable[Any], obeyed: bool, spaces: dict[str | None, str], sheet: Node) -> None:
        for rule in rules:
            self.source.spend()
            if rule.type == "qualified-rule":
                self._rule(rule, obeyed, spaces, sheet)
            elif rule.type == "at-rule":
                self._at_rule(rule, obeyed, spaces, sheet)
            elif rule.type == "error":
                self.source.note("info", "broken rule of a style sheet")

    def _at_rule(self, rule: Any, obeyed: bool, spaces: dict[str | None, str], sheet: Node) -> None:
        name = rule.lower_at_keyword
        if name == "import":
            self.source.note("guess", "style sheet of another file: not read", "unknown")
        elif name == "namespace":
            words = [token for token in rule.prelude if token.type in ("ident", "string", "url")]
            if words and words[-1].type != "ident":
                spaces[words[0].value if len(words) > 1 else None] = words[-1].value
        elif rule.content is not None and name not in _BESIDE:
            plain = name == "media" and _plain_media(self.css.serialize(rule.prelude).strip().lower())
            inner = self.css.parse_rule_list(rule.content, skip_comments=True, skip_whitespace=True)
            self._rules(inner, obeyed and plain, spaces, sheet)

    def _rule(self, rule: Any, obeyed: bool, spaces: dict[str | None, str], sheet: Node) -> None:
        self.source.spend(30)
        declarations = self._parsed(rule.content, sheet)
        text = self.css.serialize(rule.prelude)
        try:
            compiled = self.selectors.compile_selector_list(rule.prelude, namespaces=spaces)
        except (self.selectors.SelectorError, SyntaxError, RecursionError, MemoryError, ValueError):
            self._without_selector(declarations, text, sheet)
            return
        self.looks_back |= any(mark in text for mark in ("~", "+", ":"))
        for selector in compiled:
            if not selector.never_matches:
                self.count += 1
                self.matcher.add_selector(selector, _Rule(declarations, obeyed))

    def _without_selector(self, declarations: tuple[Declaration, ...], selector: str, sheet: Node) -> None:
        if any(key in MOVES for key, _, _ in declarations):
            self.source.refuse(
                f"selector {selector.strip()[:60]!r} is not read, and its rule moves shapes; write it at the elements",
                sheet.line,
            )
        if any(key in HIDES for key, _, _ in declarations):
            self.source.note("guess", "rule of a style sheet not obeyed: its selector is not read", "unknown")
        else:
            self.source.note("paint", "rule of a style sheet not obeyed: it only paints")

    def _match(self, root: Node) -> None:
        """Find the rules of each element."""
        nodes: list[Node] = []
        tree = _tree(root, nodes)
        wrapped = self.selectors.ElementWrapper.from_xml_root(tree).iter_subtree()
        for node, element in zip(nodes, wrapped, strict=True):
            self.source.spend(1 + self.count // 8 + (element.index // 8 if self.looks_back else 0))
            rules = [(match[0], match[3]) for match in self.matcher.match(element) if match[2] is None]
            if rules:
                self.rules[id(node)] = rules

    # declarations

    def _declarations(self, text: str, node: Node) -> tuple[Declaration, ...]:
        if text not in self.texts:
            self.source.spend(1 + len(text) // 64)
            self.texts[text] = self._parsed(text, node)
        return self.texts[text]

    def _parsed(self, text: Any, node: Node) -> tuple[Declaration, ...]:
        """Return the declarations that may move or hide something."""
        parsed: list[Declaration] = []
        for part in self.css.parse_blocks_contents(text, skip_comments=True, skip_whitespace=True):
            if part.type != "declaration":
                self.source.note("info", "broken declaration of a style")
                continue
            name = part.lower_name
            if name not in _KNOWN and name not in MOVES and name not in _RENAMED and name not in HIDES:
                continue
            value = self.css.serialize(part.value).strip()
            if "var(" in value:
                if name in MOVES:
                    self.source.refuse(f"{name}: {value[:60]!r}: variables are not read; write the value", node.line)
                if name in HIDES:
                    self.source.note("guess", f"value of {name} not read: a variable", "unknown")
                continue
            if name in MOVES and name not in _KNOWN and value.lower() not in ("none", "auto", "normal", "1"):
                self.source.refuse(f"{name}: {value[:60]!r} is not read; write it as transform", node.line)
            parsed += [
                (key, value, part.important)
                for key in _RENAMED.get(name, (name,))
                if key in _KNOWN and _valid(key, value)
            ]
        return tuple(parsed)


def computed(parent: Style, declared: Mapping[str, str]) -> dict[str, str]:
    """Return the values of all properties of an element below its parent.

    Examples
    --------
    >>> style = computed(ROOT, {"fill": "none", "display": "none"})
    >>> computed(style, {"fill": "initial"})["fill"], computed(style, {})["fill"], computed(style, {})["display"]
    ('', 'none', 'inline')
    """
    style = {key: parent[key] for key in INHERITED} | OWN
    for key, value in declared.items():
        word = value.lower()
        if word in ("inherit", "unset", "revert", "revert-layer", "initial"):
            taken = word == "inherit" or (word != "initial" and key in INHERITED)
            style[key] = parent.get(key, "") if taken else {**INHERITED, **OWN}.get(key, "")
        else:
            style[key] = value
    return style


ROOT: Style = INHERITED | OWN
"""Style above the root."""


def _valid(key: str, value: str) -> bool:
    """True if a value can be one of the property: others are ignored, as CSS has it."""
    word = value.lower()
    if word in ("inherit", "unset", "revert", "revert-layer", "initial"):
        return True
    return word in _WORDS[key] if key in _WORDS else bool(value)


def _plain_media(media: str) -> bool:
    return {part.strip() for part in media.split(",")} & {"", "all", "screen", "only screen"} != set()


def _sheets(root: Node) -> Iterator[Node]:
    """Yield the style sheets in the order of the file."""
    waiting = [root]
    while waiting:
        node = waiting.pop()
        if node.tag == "style":
            yield node
        waiting += reversed(node.children)


def _tree(node: Node, nodes: list[Node]) -> Element:
    """Return an element and those below it as selectors need them; list them in the order of the file."""
    nodes.append(node)
    element = Element(f"{{{node.space}}}{node.tag}" if node.space else node.tag, node.attributes)
    element.extend(_tree(child, nodes) for child in node.children)
    return element
