"""Where examples in docstrings are not collected: a file that needs an extra that is not installed."""

from importlib.util import find_spec

collect_ignore = [] if find_spec("ompl") else ["src/cfree/ompl.py"]
