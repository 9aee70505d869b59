"""Make the pictures of docs/from-your-file.md and docs/forklift.md: `python tools/file_images.py`.

The former show one file with several options each, the latter the truck's path.
"""

from io import BytesIO
from pathlib import Path
from typing import Any

from PIL import Image

import cfree

ROOT = Path(__file__).parents[1]
FILES, FOLDER = ROOT / "examples" / "drawings", ROOT / "docs" / "images" / "files"
WIDTH, COLUMNS = 420, 2  # pixels of a panel, panels beside each other
Panels = dict[str, dict[str, Any]]
PICTURES: dict[str, tuple[str, Panels]] = {
    "svg": (
        "floor.svg",
        {
            "no option": {},
            "--role walls=ignore": {"roles": {"walls": "ignore"}},
            "--strokes drawn": {"strokes": "drawn"},
            "--strokes drawn\n--role doors=ignore": {"strokes": "drawn", "roles": {"doors": "ignore"}},
        },
    ),
    "dxf-join": (
        "plate.dxf",
        {
            "no option": {},
            "--join 0.2": {"join": 0.2},
            "--join 0.3": {"join": 0.3},
            "--join 0.3 --join-holes": {"join": 0.3, "join_holes": True},
        },
    ),
    "dxf-walls": (
        "floor.dxf",
        {
            "no option": {},
            "--role A-WALL=workspace": {"roles": {"A-WALL": "workspace"}},
            "--strokes 100": {"strokes": 100.0},
            "--strokes 100\n--role A-DOOR=ignore": {"strokes": 100.0, "roles": {"A-DOOR": "ignore"}},
        },
    ),
    "map": (
        "saved.yaml",
        {
            "no option": {},
            "--free-thresh 0.196": {"free_thresh": 0.196},
            "--free-thresh 0.196\n--unknown free": {"free_thresh": 0.196, "unknown": "free"},
            "--free-thresh 0.196\n--despeckle 3": {"free_thresh": 0.196, "despeckle": 3},
        },
    ),
    "geojson": (
        "site.geojson",
        {"--repair": {"repair": True}, "--repair --strokes 0.3": {"repair": True, "strokes": 0.3}},
    ),
    "robots": (
        "",
        {
            "nav2_params.yaml": {},
            "nav2_params.yaml --padding 0.1": {"padding": 0.1},
            "robot.urdf": {},
            "robot.urdf --role lidar=ignore": {"roles": {"lidar": "ignore"}},
        },
    ),
    "nesting": ("nest.json", {"no option": {}, '--role "item 1=robot"': {"roles": {"item 1": "robot"}}}),
}
"""Names of the pictures, their files, and the options of each panel by the words of the command line."""


def panel(file: str, title: str, options: dict[str, Any]) -> Image.Image:
    """Return the picture of a file as it is read with these options."""
    figure = cfree.load_shapes(FILES / (file or title.split()[0]), **options).plot()
    (ax,) = figure.axes
    ax.set_title(title, fontsize=15, family="monospace")
    data = BytesIO()
    figure.savefig(data, dpi=100, bbox_inches="tight")
    image = Image.open(data).convert("RGB")
    return image.resize((WIDTH, round(image.height * WIDTH / image.width)), Image.Resampling.LANCZOS)


def picture(file: str, panels: Panels) -> Image.Image:
    """Return the panels of a file in rows."""
    images = [panel(file, title, options) for title, options in panels.items()]
    rows = [images[k : k + COLUMNS] for k in range(0, len(images), COLUMNS)]
    heights = [max(image.height for image in row) for row in rows]
    whole = Image.new("RGB", (WIDTH * COLUMNS, sum(heights)), "white")
    for k, row in enumerate(rows):
        for column, image in enumerate(row):
            whole.paste(image, (WIDTH * column, sum(heights[:k])))
    return whole.quantize(64, kmeans=2, dither=Image.Dither.NONE)


def forklift() -> Image.Image:
    """Return the picture of the truck's path among the racks."""
    maps = ROOT / "examples" / "maps"
    scene = cfree.load_shapes(maps / "racks.yaml", despeckle=2).scene(robot=cfree.load_shapes(maps / "forklift.yaml"))
    start, goal = ("8.475", 4, "90deg"), ("11.075", "8.3", "-90deg")
    path = cfree.plan(scene, start, goal, vehicle=cfree.DifferentialDrive(axle=("0.6", 0)), clearance="0.1")
    data = BytesIO()
    path.plot().savefig(data, dpi=90, bbox_inches="tight")
    return Image.open(data).convert("RGB").quantize(128, kmeans=2, dither=Image.Dither.NONE)


if __name__ == "__main__":
    FOLDER.mkdir(exist_ok=True)
    for name, (file, panels) in PICTURES.items():
        picture(file, panels).save(FOLDER / f"{name}.png", optimize=True)
    forklift().save(FOLDER.parent / "forklift.png", optimize=True)
