"""Films of a robot that moves among obstacles, and of the point it is in the configuration space."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from os import PathLike
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from cfree.forbidden import Boundary


def save_film(
    boundaries: Sequence[Boundary],
    path: str | PathLike[str],
    *,
    seconds: float = 30.0,
    fps: int = 25,
    size: tuple[int, int] = (1280, 720),
    storyboard: str = "paper",
    progress: Callable[[float], object] | None = None,
) -> None:
    """Write a film of one scene, or of several one after the other.

    Parameters
    ----------
    boundaries : sequence of Boundary
        With the storyboard "paper" the first shows slices, a helix, a v-e and an e-v patch, the whole boundary and a
        path; the others the last two of these.
    path : path
        ``.mp4`` (needs ``pip install cfree[video]``) or ``.gif``; a file there is replaced once the film is complete.
    seconds : float
        Length of the film.
    fps : int
        Frames a second.
    size : (int, int)
        Width and height in pixels; even, as video codecs want them.
    storyboard : str
        "paper", or "path" for a motion from start to goal alone.
    progress : callable, optional
        Called with the share that is done, from 0 to 1.

    Raises
    ------
    ValueError
        If an option has no sense, or there is nothing to show of a scene.
    UnsupportedError
        If the format is unknown, or PyAV is missing.

    Notes
    -----
    Poses at contacts are exact and on the contact surface; free motions keep a clearance that makes them free. Time
    is some tenths of a second a frame of 1280 x 720. A GIF is kept in memory until it is written.

    Examples
    --------
    >>> import tempfile, cfree
    >>> pair = cfree.boundary(cfree.load_scene("examples/scenes/paper_fig9.json"))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save_film([pair], f"{folder}/pair.gif", seconds=1, fps=6, size=(320, 180))
    """
    from cfree.film.encode import check_film_path, write
    from cfree.film.reel import check_options, pictures

    check_film_path(path)
    check_options(len(boundaries), seconds, fps, size, storyboard)
    write(pictures(boundaries, seconds, fps, size, storyboard, progress), path, fps)
