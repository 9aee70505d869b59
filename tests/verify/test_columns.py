"""Pieces of separations all at once: what doubles, monotony and names decide is what exact numbers do."""

from __future__ import annotations

import json
import random
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from flint import fmpz_poly

import cfree
from answer_mutations import OF_SEPARATIONS, mutants
from answers import separations
from cfree import FormatError, Scene, Separated
from cfree.exact.algebraic import roots, sign
from cfree.verify.closing import numbered
from cfree.verify.columns import Angles, Columns, Span, primitive, signs_at
from cfree.verify.polygons import Ring, tile
from cfree.verify.separation import _reader, separation_findings
from cfree.verify.trapezoids import Reader
from cfree.verify.world import World


class Undecided(Columns):
    """Columns that leave all to exact numbers."""

    def __init__(self, reader: Reader) -> None:
        super().__init__(reader)
        self.named[:] = self.proved[:] = False


def found(scene: Scene, proof: Separated) -> list[tuple[str, str]]:
    findings = separation_findings(proof, World(scene), lambda _: None)
    return [(finding.kind, finding.where) for finding in findings]


@pytest.mark.slow
@pytest.mark.parametrize("k", [0, 1, *(pytest.param(k, marks=pytest.mark.long) for k in (2, 3, 4))])
def test_faults_are_those_that_exact_numbers_find(k: int, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    scene, good = separations()[k]
    rng, file, kinds = random.Random(k), tmp_path / "answer.json", set[str]()
    for mutate in OF_SEPARATIONS:
        for bad in mutants(rng, good, mutate, 1):
            file.write_text(json.dumps(bad))
            try:
                proof = cfree.load(file)
            except FormatError:
                continue
            faults = found(scene, proof)
            with monkeypatch.context() as patch:
                patch.setattr("cfree.verify.separation.Columns", Undecided)
                assert found(scene, proof) == faults, mutate.__name__
            kinds.update(kind for kind, _ in faults)
    assert len(kinds) >= 2


def test_few_pieces_and_ends_are_left_to_exact_numbers() -> None:
    for scene, proof in separations():
        small = Scene(proof.robot or scene.robot, scene.obstacles, bounds=proof.bounds, workspace=scene.workspace)
        columns = Columns(_reader(proof.pieces, small))
        assert columns.proved.mean() > 0.7
        angles, numbers = columns.angles, numbered(columns.angles)
        named: dict[int, set[object]] = {}
        for k, number in enumerate(numbers):
            of = fmpz_poly(angles.rows[k].tolist())
            (root,) = (root for root, _ in roots(of, Fraction(angles.lo[k]), Fraction(angles.hi[k])))
            end = root.value in (1, -1)
            named.setdefault(number, set()).add((end, angles.chart[k] == (root.value == -1)) if end else root.key)
        assert all(len(keys) == 1 for keys in named.values())


def test_contacts_of_other_kinds_have_no_names() -> None:
    scene, proof = separations()[0]
    for wrong in (0, 3, 9):
        kind = proof.pieces.kind.copy()
        kind[0] = wrong
        small = Scene(proof.robot, scene.obstacles)
        columns = Columns(_reader(replace(proof.pieces, kind=kind), small))
        assert not columns.named[0] and columns.named[1:].all()


def test_signs_on_intervals_are_exact() -> None:
    """Of polynomials with roots at, near and far from the ends; `signs_at` against exact values."""
    rng = random.Random(5)
    for _ in range(200):
        near = [Fraction(rng.randrange(-64, 65), 64) + Fraction(rng.randrange(-3, 4), 2**50) for _ in range(4)]
        poly = fmpz_poly([1])
        for root in near[: rng.randrange(1, 5)]:
            poly *= fmpz_poly([-root.numerator, root.denominator])
        row = np.array([[int(c) for c in poly.coeffs()] + [0] * (4 - poly.degree())], object)
        lo, hi = sorted(float(x) for x in rng.sample(near, 2))
        here = np.array([lo])
        assert signs_at(row, here) == sign(row[0].tolist(), Fraction(lo))
        span = Span(here, np.array([hi]))
        for place in (lo, hi, Fraction(lo) + Fraction(rng.randrange(9), 2**150)):
            (claimed,) = span.signs_near(span.taylor(row), np.array([place], object)).tolist()
            assert claimed in (0, sign(row[0].tolist(), Fraction(place)))
        for order in (0, 1, 2):
            (claimed,) = Span(here, np.array([hi])).signs(row, order).tolist()
            if claimed:
                assert not roots(poly, Fraction(lo), Fraction(hi))
                assert sign([int(c) for c in poly.coeffs()], Fraction(lo)) == claimed
            poly = poly.derivative()


def test_primitive_polynomials_of_one_root_are_equal() -> None:
    rows = np.array([[2, 3, 3, 3, 1], [-4, -6, -2, 0, 0], [0, 0, 0, 0, 0]], object)
    assert primitive(rows).tolist() == [[2, 3, 1, 0, 0], [2, 3, 1, 0, 0], [0] * 5]
    assert primitive(rows[1:2, :3]).tolist() == [[2, 3, 1, 0, 0]]


def test_multiples_of_the_polynomial_of_an_angle_vanish_there() -> None:
    angles = Angles.__new__(Angles)
    angles.rows = np.array([[2, 3, 1, 0, 0], [2, 3, 1, 0, 0], [-1, 1, 0, 0, 0], [0] * 5], object)
    angles.ends = np.array([0, 0, 1, 0])
    multiples = np.array([[2, 3, 3, 3, 1], [-4, -6, -2, 0, 0], [5, 0, -5, 0, 0], [1, 0, 0, 0, 0]], object)
    assert angles.is_root(multiples, np.arange(4)).tolist() == [True, True, True, False]
    others = np.array([[2, 3, 3, 3, 2], [2, 3, 2, 0, 0], [5, 0, 5, 0, 0], [0, 1, 0, 0, 0]], object)
    assert not angles.is_root(others, np.arange(4)).any()


def test_pieces_that_overlap_or_leave_something_out_do_not_tile() -> None:
    square: Ring = [(0, 0), (4, 0), (4, 4), (0, 4)]
    halves: list[Ring] = [[(0, 0), (4, 0), (4, 4)], [(0, 0), (4, 4), (0, 4)]]
    cut: list[Ring] = [[(0, 0), (4, 0), (2, 2)], [(4, 0), (4, 4), (2, 2)], [(0, 0), (4, 4), (0, 4)]]
    assert tile(halves, [square]) and tile(cut, [square])
    for wrong in (halves[:1], [*halves, halves[0]], [halves[0], halves[1][::-1]], [square, square], [cut[0], *halves]):
        assert not tile(wrong, [square])
