"""Write frames into a file: MP4 with PyAV, GIF with Pillow; whole or not at all."""

from __future__ import annotations

import gc
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from fractions import Fraction
from itertools import chain
from os import PathLike
from pathlib import Path
from types import FrameType

import numpy as np
from numpy.typing import NDArray

from cfree.errors import UnsupportedError
from cfree.formats.text.atomic import checked_suffix, replacing

Image = NDArray[np.uint8]

SUFFIXES = (".mp4", ".gif")


def check_film_path(path: str | PathLike[str]) -> str:
    """Return the suffix of a film that can be written here.

    Raises
    ------
    UnsupportedError
        If the format is another one, or it is MP4 and PyAV is not installed.

    Examples
    --------
    >>> check_film_path("parking.GIF")
    '.gif'
    >>> check_film_path("parking.avi")
    Traceback (most recent call last):
        ...
    cfree.errors.UnsupportedError: parking.avi: no film format; name the file .mp4 or .gif
    """
    suffix = checked_suffix(path, "film", SUFFIXES)
    if suffix == ".mp4":
        try:
            import av  # noqa: F401
        except ImportError:
            raise UnsupportedError(
                f"{path}: MP4 needs PyAV: pip install 'cfree[video]'; or name the file .gif"
            ) from None
    return suffix


def write(frames: Iterator[Image], path: str | PathLike[str], fps: int) -> None:
    """Write frames of equal size as they come.

    Parameters
    ----------
    frames : iterator of (height, width, 3) uint8
        At least one frame. Width and height must be even for MP4.
    path : path
        ``.mp4`` or ``.gif``; a file there is replaced once the film is complete.
    fps : int
        Frames a second; a GIF's are rounded to hundredths of a second.
    """
    save = {".mp4": _save_mp4, ".gif": _save_gif}[check_film_path(path)]
    with replacing(path) as unfinished, _interrupted(frames) as pictures:
        save(pictures, unfinished, fps)


@contextmanager
def _interrupted(frames: Iterator[Image]) -> Iterator[Iterator[Image]]:
    """Yield the frames, ended by Ctrl-C even if a drawing library clears the exception."""
    handler = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(handler):
        yield frames
        return
    interrupted = threading.Event()

    def note(number: int, frame: FrameType | None) -> None:
        interrupted.set()
        handler(number, frame)

    def until_interrupted() -> Iterator[Image]:
        for frame in frames:
            if interrupted.is_set():
                raise KeyboardInterrupt
            yield frame

    signal.signal(signal.SIGINT, note)
    try:
        yield until_interrupted()
    finally:
        signal.signal(signal.SIGINT, handler)


def _save_mp4(frames: Iterator[Image], path: Path, fps: int) -> None:
    import av

    first = next(frames)
    container = av.open(str(path), "w", format="mp4", options={"movflags": "faststart"})
    stream = container.add_stream("libx264", rate=Fraction(fps), options={"crf": "17", "preset": "medium"})
    try:
        stream.height, stream.width = first.shape[:2]
        stream.pix_fmt = "yuv420p"
        for frame in chain([first], frames):
            container.mux(stream.encode(av.VideoFrame.from_ndarray(np.ascontiguousarray(frame), format="rgb24")))
        container.mux(stream.encode(None))
    finally:
        container.close()
        del container, stream
        gc.collect()  # a codec that lives until Python ends hangs or crashes there


def _save_gif(frames: Iterator[Image], path: Path, fps: int) -> None:
    from PIL import Image as Pillow

    pictures = (
        Pillow.fromarray(frame).quantize(256, method=Pillow.Quantize.FASTOCTREE, dither=Pillow.Dither.NONE)
        for frame in frames
    )
    first = next(pictures)
    duration = max(20, round(100 / fps) * 10)
    with path.open("wb") as file:
        first.save(file, "GIF", save_all=True, append_images=pictures, duration=duration, loop=0)
