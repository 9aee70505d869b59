"""Links that open the page with a scene: the fragment after the page's address, as `viewer/src/state.ts` reads it."""

from __future__ import annotations

import base64
import json
import zlib

import cfree
from cfree.viewer.page_text import text_for_page, words

MOST = 8192  # characters of a link; a longer one is refused, as by the page


def fragment(scene: cfree.Scene) -> str:
    """Return the fragment of a link that opens the page with a scene.

    Examples
    --------
    >>> fragment(cfree.Scene([(0, 0), (1, 0), (0, 1)]))[:3]
    '#s='
    """
    start = scene.start or cfree.Pose(0, 0)
    state = {"source": text_for_page(scene), "robot": words(start), "start": words(start)}
    if scene.goal is not None:
        state["goal"] = words(scene.goal)
    packing = zlib.compressobj(9, zlib.DEFLATED, -zlib.MAX_WBITS)
    packed = packing.compress(json.dumps(state).encode()) + packing.flush()
    code = base64.urlsafe_b64encode(packed).decode().rstrip("=")
    if len(code) > MOST:
        raise ValueError(
            f"{scene}: its link has {len(code):,} characters; give a scene with a link of {MOST:,} at most"
        )
    return f"#s={code}"
