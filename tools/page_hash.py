"""Print the hash of the sources of the page; C++ counts as its tokens, without comments and white space.

    python tools/page_hash.py

`viewer/inputs.txt` lists the files and folders. The page holds the hash of its own sources.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
TOKEN = re.compile(
    r"""(?P<skip> \s+ | //[^\n]* | /\*.*?\*/ )
    | R"(?P<mark>[^\s()\\]*)\(.*?\)(?P=mark)"
    | "(?:\\.|[^"\\])*" | '(?:\\.|[^'\\])+'
    | [A-Za-z_]\w* | \.?\d(?:['\w.]|(?<=[eEpP])[+-])* | .""",
    re.DOTALL | re.VERBOSE,
)


def tokens(text: str) -> Iterator[str]:
    """Tokens of C++ in their order.

    Examples
    --------
    >>> [*tokens('int x = 1\\'000;  // a thousand')]
    ['int', 'x', '=', "1'000", ';']
    """
    for match in TOKEN.finditer(text):
        if match["skip"] is None:
            yield match[0]


def inputs() -> list[Path]:
    """All sources of the page."""
    listed = [ROOT / name for name in (ROOT / "viewer" / "inputs.txt").read_text().split("\n") if name]
    files = [file for entry in listed for file in (entry.rglob("*") if entry.is_dir() else [entry]) if file.is_file()]
    return sorted(files, key=lambda file: file.relative_to(ROOT).as_posix())


def page_hash() -> str:
    """SHA-256 of names and contents."""
    whole = hashlib.sha256()
    for file in inputs():
        content = file.read_bytes()
        if file.suffix in (".cpp", ".hpp"):
            content = "\n".join(tokens(content.decode())).encode()
        whole.update(f"{file.relative_to(ROOT).as_posix()}\0{hashlib.sha256(content).hexdigest()}\n".encode())
    return whole.hexdigest()


if __name__ == "__main__":
    print(page_hash())
