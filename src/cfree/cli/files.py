"""Input and output files of commands: scenes, boundaries and answers; and a progress bar."""

from __future__ import annotations

import errno
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from cfree.cli import drawing
from cfree.cli.options import refuse
from cfree.cli.reading import MOST_LINES, made, report
from cfree.cli.terminal import status
from cfree.formats.text.archive import is_archive

if TYPE_CHECKING:
    from cfree.cli.folders import FolderPlanner
    from cfree.forbidden.boundary import Boundary
    from cfree.formats.shapes import Shapes
    from cfree.paths.path import Path as Motions
    from cfree.paths.preferences import Preferences
    from cfree.planning.curved import CurvedPlanner
    from cfree.planning.goals import AllSeparated
    from cfree.planning.planner import Planner
    from cfree.planning.separation import Separated
    from cfree.scene.scene import Scene
    from cfree.vehicles.vehicle import Vehicle


Curves = Literal["all", "rounded", "none"]
"""Round shapes that stay: all, those whose boundary is exact, or none. Polygons within --tolerance replace others."""


def read_scene(source: Path, curves: Curves = "all") -> Scene:
    """Read the scene in a file with the options on the command line, and report its record of reading."""
    scene = scene_of(*read_shapes(source), source)
    return scene if curves == "all" else without_curves(scene, source, keep_rounded=curves == "rounded")


def read_shapes(source: Path) -> tuple[Shapes, Any]:
    """Read the shapes in a file, and the robot of --robot, if there is one, with the options on the command line."""
    from cfree.formats import scene_file

    wanted = drawing.options_of_reading()
    with status() as say:
        say("reading ...")
        shapes = scene_file.read_shapes(source, wanted, lambda steps: say(f"reading, {steps:,} pieces of curves ..."))
        return shapes, drawing.robot(wanted)


def scene_of(shapes: Shapes, robot: Any, source: Path, most: int | None = MOST_LINES) -> Scene:
    """Make the scene of shapes, and report its record of reading; refuse options that had no effect on it."""
    scene = made(drawing.framed(shapes), source, robot, drawing.pivot(), most)
    drawing.keep_form(shapes.form)
    drawing.refuse_unused((shapes.form, *([robot.form] if hasattr(robot, "form") else [])), curved=scene.curved)
    return scene


def read_source(source: Path, curves: Curves = "rounded") -> Scene | Boundary:
    """Read the boundary in a file, or the scene, and report the record of reading."""
    if is_archive(source):
        from cfree.formats.boundaries.boundary_file import load_boundary

        drawing.refuse_all("only for files that are read as scenes, and this is a boundary")
        boundary = load_boundary(source)
        report(boundary.scene.reading, source)
        return boundary
    return read_scene(source, curves)


def without_curves(scene: Scene, source: Path, *, keep_rounded: bool = False, remedy: str = "--tolerance") -> Scene:
    """Replace round shapes by polygons around them, within --tolerance, and report them; rounded ones may stay."""
    from cfree.formats.conversion import as_exact, straightened
    from cfree.scene.reading import together
    from cfree.scene.scene import with_reading

    if not scene.curved:
        return scene
    straight, notes = (as_exact if keep_rounded else straightened)(scene, drawing.tolerance(), remedy=remedy)
    if not notes:
        return scene
    report(notes, Path(f"polygons of {source}"))
    return with_reading(straight, together(straight.reading, notes))


def computed(
    source: Scene | Boundary, threads: int | None, max_seconds: float | None = None, max_memory: float | None = None
) -> Boundary:
    """Compute the boundary of a scene; return a boundary as it is."""
    from cfree.errors import LaboriousSceneError
    from cfree.forbidden.boundary import Boundary, boundary
    from cfree.forbidden.labour import GO_ON

    if isinstance(source, Boundary):
        return source
    try:
        with bar("boundary") as progress:
            return boundary(source, threads=threads, max_seconds=max_seconds, max_memory=max_memory, progress=progress)
    except LaboriousSceneError as error:
        go_on = "cfree boundary --max-seconds inf -o FILE to go on; other commands take FILE"
        raise LaboriousSceneError(str(error).replace(GO_ON, go_on), pairs=error.pairs) from None


def answer_for(scene: Scene, file: Path) -> Motions | Separated | AllSeparated:
    """Read an answer for this scene from a file.

    Raises
    ------
    ValueError
        If it is for another scene, in the words of `cfree verify`.
    """
    from cfree.formats.files import load
    from cfree.paths.path import Path as Motions
    from cfree.planning.goals import AllSeparated
    from cfree.planning.separation import Separated
    from cfree.verify.answers import other_scene

    answer = load(file)
    if not isinstance(answer, Motions | Separated | AllSeparated):
        raise ValueError(f"{file}: no path and no proof; give an answer written by cfree plan -o")
    if finding := other_scene(scene, answer):
        raise ValueError(f"{file}: {finding}")
    return answer


def planner_of(
    source: Path,
    max_seconds: float | None,
    preferences: Preferences,
    vehicle: Vehicle | Literal["any"] | None = None,
) -> Planner | CurvedPlanner | FolderPlanner:
    """Make a planner for the scene in a file, with its free space if the file is a boundary; or for a folder."""
    from cfree.planning.planner import Planner
    from cfree.scene.scene import vehicle_for

    if source.is_dir() or is_archive(source):
        refuse("only for scenes, whose boundary is not yet computed", "max_seconds")
        drawing.refuse_all("only for files that are read as scenes, and this is a boundary")
    if source.is_dir():
        from cfree.cli.folders import FolderPlanner

        planner: Planner | FolderPlanner = FolderPlanner(source, preferences, vehicle)
        report(planner.scene.reading, source)
    elif is_archive(source):
        from cfree.formats.boundaries.boundary_file import load_boundary
        from cfree.free.space import free_space

        boundary = load_boundary(source)
        scene = boundary.scene
        space = None
        if not scene.curved:  # planners among round shapes find their own cells
            with bar("cells"):
                space = free_space(boundary)
        planner = Planner(scene, space, preferences=preferences, phase=bar, vehicle=vehicle_for(scene, vehicle))
        report(scene.reading, source)
    else:
        scene = read_scene(source)
        driver = vehicle_for(scene, vehicle)
        planner = Planner(scene, max_seconds=max_seconds, preferences=preferences, phase=bar, vehicle=driver)
    if isinstance(planner, Planner) and planner.scene.curved:
        from cfree.planning.curved import CurvedPlanner

        return CurvedPlanner(planner, drawing.tolerance())
    return planner


@contextmanager
def bar(name: str) -> Iterator[Callable[[float], object]]:
    """Yield a function to call with the share that is done; it is shown beside the task's name."""
    with status() as say:
        say(f"{name} ...")
        yield lambda share: say(f"{name} {share:.0%}")


def check_outputs(source: Path, wanted: dict[str, Path | None]) -> dict[str, str]:
    """Return the files to write; refuse impossible ones before a long computation rather than after it."""
    from cfree.formats.text.atomic import check_place

    files = {name: path for name, path in wanted.items() if path is not None}
    contents = dict[Path, str]()
    for name, path in files.items():
        check_place(path)
        other = contents.setdefault(path.resolve(), name)
        if other != name:
            raise ValueError(f"{path}: this would be the {other} and the {name} in one file; give two names")
        if path.exists() and source.exists() and path.samefile(source):
            raise FileExistsError(errno.EEXIST, "is the input; give another name", str(path))
        _check_name(name, path)
    return {name: str(path) for name, path in files.items()}


def _check_name(content: str, path: Path) -> None:
    """Raise an error if the name does not fit the content of the file."""
    check: Callable[[Path], object]
    match content:
        case "boundary":
            from cfree.formats.boundaries.boundary_file import check_boundary_path as check
        case "film":
            from cfree.film.encode import check_film_path as check
        case "geojson":
            from cfree.formats.boundaries.slice_geojson import check_slice_path as check
        case "layout":
            from cfree.nesting.writing import check_nesting_path as check
        case "mesh":
            from cfree.formats.boundaries.mesh_file import check_mesh_path as check
        case "page":
            from cfree.viewer.browser import check_page_path as check
        case "part" | "scene":
            from cfree.formats.scene_file import check_scene_path as check
        case "picture":
            from cfree.plot.boundary import check_picture_path as check
        case _:  # an answer's form may be an option instead
            return
    check(path)
