"""Read and write every value in files of its own kind; report all faults of a file with their places.

Each part imports only from those before it:

1. `text/`: a file's text, the places in it, its faults; files replaced as a whole.
2. `units.py`: names of units of length, and factors between them.
3. `fitting.py`: scale and reference point of shapes and poses.
4. `padding.py`: robots padded as nav2 pads them.
5. `shapes.py`: the content of a file of shapes, before it is a scene.
6. `scenes/`: the JSON scene.
7. `drawings/`: drawings, maps and other files of shapes, one file a format.
8. `readers.py`: the reader for each file.
9. `scene_file.py`: `load_scene`, `load_shapes` and `save_scene`.
10. `conversion.py`: `convert`.
11. `boundaries/`: boundaries, their tables, meshes and slices.
12. `answers/`: paths and separations.
13. `files.py`: `save` and `load`.
"""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.formats.shapes import Shapes as Shapes

__getattr__, __dir__, __all__ = lazy_names(__name__, {"shapes": "Shapes"})
