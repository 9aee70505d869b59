"""Write the tutorials of `examples/gallery` as notebooks, into `examples/notebooks`: ``make notebooks``.

Blocks of a tutorial begin with ``# %%``, then text in comments, then code. In its notebook a cell ends with its figure,
and the page is a widget.
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

EXAMPLES = Path(__file__).parents[1] / "examples"
NEEDS = "This notebook needs `pip install 'cfree[notebook]'`, and the files of the folder `examples`, which it is in."


def notebooks() -> dict[str, str]:
    """Return the text of the notebook of each tutorial, by its file name."""
    tutorials = sorted((EXAMPLES / "gallery").glob("plot_*.py"))
    return {path.stem.removeprefix("plot_") + ".ipynb": notebook(path.read_text()) for path in tutorials}


def notebook(script: str) -> str:
    """Return the notebook of a tutorial.

    Examples
    --------
    >>> cells = json.loads(notebook('\"\"\"\\nTitle\\n=====\\n\\nText.\\n\"\"\"\\nfigure = draw(1)\\n'))["cells"]
    >>> cells[0]["source"][:3], cells[-1]["source"]
    (['# Title\\n', '\\n', 'Text.\\n'], ['figure = draw(1)\\n', 'figure'])
    """
    _, title, rest = script.split('"""', 2)
    first, *blocks = re.split(r"^# %%.*\n", rest, flags=re.M)
    cells = [_cell("markdown", f"{_markdown(title)}\n\n{NEEDS}"), *_code("%matplotlib inline"), *_code(first)]
    for block in blocks:
        lines = block.splitlines()
        code = next((k for k, line in enumerate(lines) if not line.startswith("#")), len(lines))
        text = "\n".join(line.removeprefix("#").removeprefix(" ") for line in lines[:code])
        cells += [_cell("markdown", _markdown(text)), *_code("\n".join(lines[code:]))]
    for k, cell in enumerate(cells):
        cell["id"] = f"cell-{k}"
    kernel = {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}}
    return json.dumps({"cells": cells, "metadata": kernel, "nbformat": 4, "nbformat_minor": 5}, indent=1) + "\n"


def _markdown(text: str) -> str:
    """Return the Markdown of headings, paragraphs and code in reStructuredText."""
    text = re.sub(r"^(.+)\n=+$", r"# \1", text.strip(), flags=re.M)
    return re.sub(r"^(.+)\n-+$", r"## \1", text, flags=re.M).replace("``", "`")


def _code(text: str) -> list[dict[str, Any]]:
    """Return the cell of code, which ends with its figure or the page; none without code."""
    if not (text := text.strip()):
        return []
    text = re.sub(r"^page = cfree\.viewer\.page\(", "cfree.widget(", text, flags=re.M)
    return [_cell("code", f"{text}\nfigure" if re.search(r"^figure = ", text, re.M) else text)]


def _cell(kind: str, text: str) -> dict[str, Any]:
    cell: dict[str, Any] = {"cell_type": kind, "id": "", "metadata": {}, "source": text.splitlines(keepends=True)}
    return cell | ({"execution_count": None, "outputs": []} if kind == "code" else {})


if __name__ == "__main__":
    for name, text in notebooks().items():
        (EXAMPLES / "notebooks" / name).write_text(text)
