"""One thing wrong in an answer, and `verify` says so, or it is still true; `answer_mutations.py` prints the table."""

from __future__ import annotations

import json

import pytest

import cfree.verify
from answer_mutations import (
    OF_DISTANCES,
    OF_PATHS,
    OF_SEPARATIONS,
    OF_SLIDES,
    Mutation,
    tried,
    verdict,
)
from answers import corridor, distances, rounded, separations, tee, text_of


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize(
    "mutate", [*OF_PATHS, *OF_SLIDES, *OF_SEPARATIONS, *OF_DISTANCES], ids=lambda mutate: mutate.__name__
)
def test_one_wrong_thing_is_rejected_or_still_true(mutate: Mutation) -> None:
    """That what is verified is true, by the core, is asserted on the way."""
    found = tried(mutate, 3)
    still_true = found.pop("", 0)
    assert found.total() >= (2 if mutate.__name__ == "claim_more_or_less" else max(3, still_true)), found


@pytest.mark.slow
def test_what_is_right_is_verified() -> None:
    for scene, answer in (corridor(), rounded(), tee(), *separations(), *distances()):
        assert verdict(scene, json.loads(text_of(answer))) == ""
        assert cfree.verify.answer(scene, answer).proved
