"""Make the pictures of docs/figures.md: `python tools/figure_images.py`, with the extra `render`; 256 colours each."""

from pathlib import Path
from tempfile import TemporaryDirectory

from PIL import Image

from cfree.figures import draw_all

WIDTH = 900  # pixels of a picture of the plane or of space alone; pictures of two parts are wider
FOLDER = Path(__file__).parents[1] / "docs" / "images" / "figures"

with TemporaryDirectory() as folder:
    for file in draw_all(folder, formats=["png"], renderer="pyvista"):
        with Image.open(file) as image:
            share = WIDTH * (1 if image.width < 1200 else 1.4) / image.width
            small = image.convert("RGB").resize(
                (round(image.width * share), round(image.height * share)), Image.LANCZOS
            )
        small = small.quantize(256, Image.Quantize.MAXCOVERAGE, kmeans=2, dither=Image.Dither.NONE)
        small.save(FOLDER / file.name, optimize=True)
