"""Read and write every value in files of its own kind; report all faults of a file with their places.

Each part imports only from those before it:

1. `text/`: a file's text, the places in it, its faults; files replaced as a whole.
2. `shapes.py`: what a file of shapes holds, before it is a scene.
3. `scenes/`: the JSON scene.
4. `drawings/`: drawings, maps and other files of shapes, one file a format.
5. `readers.py`: the reader for each file.
6. `scene_file.py`: `load_scene`, `load_shapes` and `save_scene`.
7. `conversion.py`: `convert`.
8. `boundaries/`: boundaries, their tables, meshes and slices.
9. `answers/`: paths and separations.
10. `files.py`: `save` and `load`.
"""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.formats.shapes import Shapes as Shapes

__getattr__, __dir__, __all__ = lazy_names(__name__, {"shapes": "Shapes"})
