"""Conditions of SVG elements: branches of a switch for languages, features and extensions."""

from __future__ import annotations

from cfree.formats.drawings.source import Source
from cfree.formats.drawings.xml_tree import Node

FEATURES = ("http://www.w3.org/TR/SVG", "org.w3c.svg")
"""Beginnings of the names of features that each reader has."""


def applies(source: Source, node: Node) -> bool:
    """True if the conditions of an element hold.

    Examples
    --------
    >>> applies(Source("a.svg"), Node("g", {"systemLanguage": "de, en-GB"}, 1))
    True
    """
    texts = node.attributes
    if "systemLanguage" in texts:
        own = source.reading.language.lower()
        tags = [tag.strip().lower() for tag in texts["systemLanguage"].split(",")]
        if not any(tag == own or tag.startswith(f"{own}-") for tag in tags):
            return False
    if "requiredFeatures" in texts:
        features = texts["requiredFeatures"].split()
        if not features or not all(feature.startswith(FEATURES) for feature in features):
            return False
    return "requiredExtensions" not in texts
