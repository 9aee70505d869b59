"""Replace files as a whole or not at all; check their names before anything is computed."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from cfree.errors import UnsupportedError


def checked_suffix(path: str | os.PathLike[str], what: str, suffixes: Sequence[str]) -> str:
    """Return the suffix of a file's name in small letters, if it is one of `suffixes`.

    Raises
    ------
    UnsupportedError
        If it is another.

    Examples
    --------
    >>> checked_suffix("parking.GLB", "mesh", [".glb", ".ply"])
    '.glb'
    >>> checked_suffix("parking.dae", "mesh", [".glb", ".ply", ".obj"])
    Traceback (most recent call last):
        ...
    cfree.errors.UnsupportedError: parking.dae: no mesh format; name the file .glb, .ply or .obj
    """
    suffix = Path(path).suffix.lower()
    if suffix not in suffixes:
        *others, last = suffixes
        names = f"{', '.join(others)} or {last}" if others else last
        raise UnsupportedError(f"{os.fspath(path)}: no {what} format; name the file {names}")
    return suffix


def check_place(path: str | os.PathLike[str]) -> None:
    """Raise an OSError with the reason if it is already certain that no file can be written there."""
    target = Path(path)
    if target.is_dir():
        raise IsADirectoryError(errno.EISDIR, "is a directory; give the name of a file", str(path))
    folder = target.parent
    if not folder.exists():
        raise FileNotFoundError(errno.ENOENT, "there is no such folder; make it, or give another", str(folder))
    if not folder.is_dir() or not os.access(folder, os.W_OK | os.X_OK):
        raise PermissionError(errno.EACCES, f"cannot be made in {folder}; give another place", str(path))


@contextmanager
def replacing(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Yield a new empty file that replaces `path` once the block ends without an error.

    If the system supports it, the file has no name before, so that a killed process leaves nothing; its suffix then
    differs from that of `path`. An existing `path` that is no regular file, such as ``/dev/stdout``, is written
    directly.

    Raises
    ------
    OSError
        If there is no such folder, or the file cannot be written; it names `path`.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with replacing(f"{folder}/note.txt") as unfinished:
    ...         _ = unfinished.write_text("all of it")
    ...     Path(f"{folder}/note.txt").read_text()
    'all of it'
    """
    check_place(path)
    target = Path(os.path.realpath(path))
    unfinished = target
    try:
        if os.path.exists(path) and not os.path.isfile(path):
            unfinished = Path(path)
            yield unfinished
        else:
            with _beside(target) as unfinished:
                yield unfinished
    except OSError as error:
        if error.errno is None or error.filename not in (None, str(unfinished)):
            raise
        raise OSError(error.errno, error.strerror, str(path)) from error


@contextmanager
def _beside(target: Path) -> Iterator[Path]:
    """Yield a new file in the same folder, which is renamed to `target` at the end."""
    spare = target.with_name(f".{target.stem[:50]}.{os.urandom(4).hex()}{target.suffix}")
    nameless = getattr(os, "O_TMPFILE", None)
    try:
        handle = os.open(target.parent, os.O_RDWR | nameless, 0o666) if nameless else -1
    except OSError:  # not on every file system
        handle = -1
    try:
        if handle < 0:
            spare.touch(exist_ok=False)
            unfinished = spare
        else:
            unfinished = Path(f"/proc/self/fd/{handle}")
        yield unfinished
        if target.exists():
            unfinished.chmod(target.stat().st_mode & 0o777)
        if handle >= 0:
            os.link(unfinished, spare, src_dir_fd=handle)  # with a folder given the system follows the link
        spare.replace(target)
    finally:
        spare.unlink(missing_ok=True)
        if handle >= 0:
            os.close(handle)
