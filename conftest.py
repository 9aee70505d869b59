"""Where examples in docstrings are not collected: a file that needs an extra that is not installed."""

from importlib.util import find_spec

NEEDED = {"ompl": "src/cfree/ompl.py", "anywidget": "src/cfree/viewer/widget.py"}
collect_ignore = [path for name, path in NEEDED.items() if find_spec(name) is None]
