"""Examples that hypothesis draws are the same in every run of continuous integration, new ones elsewhere.

Without slow tests they are a quarter as many. Of tests with many cases some may be left out: see `--one-of`.
"""

import os
import signal
from zlib import crc32

import pytest
from hypothesis import settings

settings.register_profile("anywhere", deadline=None)
settings.register_profile("ci", deadline=None, derandomize=True)
settings.load_profile("ci" if os.environ.get("CI") else "anywhere")


def pytest_addoption(parser: pytest.Parser) -> None:
    said = "of a test's cases run the first, and about one of N of the others, the same in every run"
    parser.addoption("--one-of", type=int, metavar="N", default=1, help=said)


@pytest.hookimpl(trylast=True)  # after the choice by marks
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    of, seen, chosen, left = config.getoption("--one-of"), set(), [], []
    for item in items:
        test = item.nodeid.partition("[")[0]
        is_chosen = test not in seen or crc32(item.nodeid.encode()) % of == 0
        (chosen if is_chosen else left).append(item)
        seen.add(test)
    if left:
        items[:] = chosen
        config.hook.pytest_deselected(items=left)


def pytest_configure(config: pytest.Config) -> None:
    if config.getoption("markexpr") == "not slow":
        settings.register_profile("quick", settings(), max_examples=25)
        settings.load_profile("quick")


# programs that tests interrupt inherit what is done with SIGINT, and background jobs are started with it ignored
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
