"""What commands read and where they write: scenes and boundaries in files, and a bar that says what takes long."""

from __future__ import annotations

import errno
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from cfree.cli.options import refuse
from cfree.cli.terminal import status
from cfree.formats.text.archive import is_archive

if TYPE_CHECKING:
    from cfree.cli.folders import FolderPlanner
    from cfree.forbidden.boundary import Boundary
    from cfree.paths.path import Path as Motions
    from cfree.paths.preferences import Preferences
    from cfree.planning.curved import CurvedPlanner
    from cfree.planning.goals import AllSeparated
    from cfree.planning.planner import Planner
    from cfree.planning.separation import Separated
    from cfree.scene.scene import Scene


def read_source(source: Path) -> Scene | Boundary:
    """The boundary in a file, or the scene."""
    from cfree.formats.scene_file import load_scene

    if is_archive(source):
        from cfree.formats.boundaries.boundary_file import load_boundary

        return load_boundary(source)
    with bar("reading"):
        return load_scene(source)


def computed(
    given: Scene | Boundary, threads: int | None, max_seconds: float | None = None, max_memory: float | None = None
) -> Boundary:
    """The boundary of a scene, unless it is one already."""
    from cfree.forbidden.boundary import Boundary, boundary

    if isinstance(given, Boundary):
        return given
    with bar("boundary") as progress:
        return boundary(given, threads=threads, max_seconds=max_seconds, max_memory=max_memory, progress=progress)


def answer_for(scene: Scene, file: Path) -> Motions | Separated | AllSeparated:
    """The answer in a file, if it is one for this scene.

    Raises
    ------
    ValueError
        In the words of `cfree verify`, if it is for another.
    """
    from cfree.formats.files import load
    from cfree.paths.path import Path as Motions
    from cfree.planning.goals import AllSeparated
    from cfree.planning.separation import Separated
    from cfree.verify.answers import other_scene

    found = load(file)
    if not isinstance(found, Motions | Separated | AllSeparated):
        raise ValueError(f"{file}: no path and no proof; give what cfree plan -o has written")
    if finding := other_scene(scene, found):
        raise ValueError(f"{file}: {finding}")
    return found


def planner_of(
    source: Path, max_seconds: float | None, preferences: Preferences, tolerance: float | None
) -> Planner | CurvedPlanner | FolderPlanner:
    """For the scene in a file, with its free space if the file is a boundary; or for a folder."""
    from cfree.formats.scene_file import load_scene
    from cfree.planning.curved import CurvedPlanner
    from cfree.planning.planner import Planner

    if source.is_dir() or is_archive(source):
        refuse("of scenes, whose boundary is not yet computed", "max_seconds")
    if source.is_dir():
        from cfree.cli.folders import FolderPlanner

        found: Planner | FolderPlanner = FolderPlanner(source, preferences)
    elif is_archive(source):
        from cfree.formats.boundaries.boundary_file import load_boundary
        from cfree.free.space import free_space

        with bar("cells"):
            space = free_space(load_boundary(source))
        found = Planner(space.boundary.scene, space, preferences=preferences, phase=bar)
    else:
        with bar("reading"):
            scene = load_scene(source)
        found = Planner(scene, max_seconds=max_seconds, preferences=preferences, phase=bar)
        if scene.curved:
            return CurvedPlanner(found, tolerance)
    if tolerance is not None:
        raise ValueError(f"--tolerance: {tolerance}, of scenes with round shapes; leave it out")
    return found


@contextmanager
def bar(name: str) -> Iterator[Callable[[float], object]]:
    """Yield a function to call with the share that is done, which is shown beside what is being done."""
    with status() as say:
        say(f"{name} ...")
        yield lambda share: say(f"{name} {share:.0%}")


def check_outputs(source: Path, wanted: dict[str, Path | None]) -> dict[str, str]:
    """The files to write; what cannot be written is refused before a long computation rather than after it."""
    from cfree.formats.text.atomic import check_place

    files = {name: path for name, path in wanted.items() if path is not None}
    for name, path in files.items():
        check_place(path)
        if path.exists() and source.exists() and path.samefile(source):
            raise FileExistsError(errno.EEXIST, "is the input; give another name", str(path))
        _check_name(name, path)
    return {name: str(path) for name, path in files.items()}


def _check_name(content: str, path: Path) -> None:
    """Raise an error if the name says something else than what will be in the file."""
    check: Callable[[Path], object]
    match content:
        case "boundary":
            from cfree.formats.boundaries.boundary_file import check_boundary_path as check
        case "film":
            from cfree.film.encode import check_film_path as check
        case "geojson":
            from cfree.formats.boundaries.slice_geojson import check_slice_path as check
        case "mesh":
            from cfree.formats.boundaries.mesh_file import check_mesh_path as check
        case "page":
            from cfree.viewer.browser import check_page_path as check
        case "part" | "scene":
            from cfree.formats.scene_file import check_scene_path as check
        case "picture":
            from cfree.plot.boundary import check_picture_path as check
        case _:  # an answer's form may be given beside its name
            return
    check(path)
