import pytest

from cfree import errors


@pytest.mark.parametrize(
    ("kind", "builtin"),
    [
        (errors.InvalidPolygonError, ValueError),
        (errors.InvalidPoseError, ValueError),
        (errors.InvalidVehicleError, ValueError),
        (errors.FormatError, ValueError),
        (errors.UnsupportedError, NotImplementedError),
        (errors.InvariantError, RuntimeError),
    ],
)
def test_every_error_is_a_cfree_error_and_a_builtin_one(kind: type[Exception], builtin: type[Exception]) -> None:
    assert issubclass(kind, errors.CfreeError)
    assert issubclass(kind, builtin)


def test_errors_carry_their_place() -> None:
    polygon = errors.InvalidPolygonError("hole 0: edges 2 and 5 cross", ring=1, edges=(2, 5))
    assert (polygon.ring, polygon.edges) == (1, (2, 5))
    file = errors.FormatError("bad", path="a.json", line=3, column=7)
    assert (file.path, file.line, file.column) == ("a.json", 3, 7)
    assert "report" in str(errors.InvariantError("sides differ", state=[1]))
