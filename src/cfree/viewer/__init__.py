"""A page that shows a scene, its configuration space and answers, in any browser and without a server.

`page.html` is built by ``make viewer`` from `viewer` and the C++ core, which runs in it as WebAssembly.
"""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.viewer.page_text import page as page

__getattr__, __dir__, __all__ = lazy_names(__name__, {"page_text": "page"})
