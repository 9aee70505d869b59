"""Examples that hypothesis draws are the same in every run of continuous integration, new ones elsewhere.

Without slow tests they are a quarter as many.
"""

import os
import signal

import pytest
from hypothesis import settings

settings.register_profile("anywhere", deadline=None)
settings.register_profile("ci", deadline=None, derandomize=True)
settings.load_profile("ci" if os.environ.get("CI") else "anywhere")


def pytest_configure(config: pytest.Config) -> None:
    if config.getoption("markexpr") == "not slow":
        settings.register_profile("quick", settings(), max_examples=25)
        settings.load_profile("quick")


# programs that tests interrupt inherit what is done with SIGINT, and background jobs are started with it ignored
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
