"""Answers in files: a path, or a proof that there is none. `docs/answer-format.md` describes them."""

from __future__ import annotations

from os import PathLike
from pathlib import Path as FilePath
from typing import TYPE_CHECKING

from cfree.arguments import checked
from cfree.paths.path import Path
from cfree.planning.separation import Separated

if TYPE_CHECKING:
    from cfree.formats.answer_format import Read


@checked
def load_answer(path: str | PathLike[str]) -> Path | Separated:
    """Read a path or a separation from a JSON file.

    Raises
    ------
    FormatError
        Place, value and remedy of every fault; also if the motions of a path do not lead to the goal, or the decimals
        beside exact numbers put the robot elsewhere.

    Examples
    --------
    >>> import tempfile
    >>> from cfree import Pose, Scene, Translation
    >>> square = Scene([(0, 0), (1, 0), (1, 1), (0, 1)])
    >>> way = Path(Pose(0, 0, {"tau": "1/3"}), [Translation(("1/3", 2))], scene=square)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     way.save(f"{folder}/way.json")
    ...     load_answer(f"{folder}/way.json") == way
    True
    """
    return read_answer(path).answer


def read_answer(path: str | PathLike[str]) -> Read:
    """The same, and what the file says of its decimals."""
    from cfree.formats.answer_format import answer_from_json
    from cfree.formats.findings import Findings, read_text
    from cfree.formats.json_text import read_json

    file = FilePath(path)
    findings = Findings(str(file), read_text(file))
    return answer_from_json(findings, read_json(findings))
