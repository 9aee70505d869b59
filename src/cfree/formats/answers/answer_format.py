"""Read a path or a separation from a JSON value; report its faults in our own words.

Import this module inside functions.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, get_args

from pydantic import BaseModel, ValidationError

from cfree.formats.answers.answer_rules import Faults, completed, effect_faults, leeway_of, path_faults
from cfree.formats.answers.path_format import PathModel
from cfree.formats.answers.separation_format import AllSeparatedModel, SeparationModel
from cfree.formats.answers.stuck_format import StuckModel
from cfree.formats.answers.unreachable_format import UnreachableModel
from cfree.formats.scenes.scene_format import report
from cfree.formats.text.findings import Findings, InvalidFileError, whole
from cfree.formats.text.json_positions import Path as Place
from cfree.paths.path import Path
from cfree.planning.goals import AllSeparated
from cfree.planning.proof import Proof

Model = PathModel | SeparationModel | StuckModel | UnreachableModel | AllSeparatedModel
_MODELS: dict[str, type[Model]] = {
    "path": PathModel, "separated": SeparationModel, "stuck": StuckModel, "unreachable": UnreachableModel,
    "all separated": AllSeparatedModel,
}  # fmt: skip


@dataclass(frozen=True)
class Read:
    """An answer as read from a file.

    Attributes
    ----------
    answer : Path, Separated, Stuck, Unreachable or AllSeparated
    decimals : "free", "approximate" or None
        The claim about decimals beside exact numbers; None if there are only decimals.
    leeway : Fraction or None
        The clearance of the exact path that makes the path of the decimals free; None if none is enough.
    """

    answer: Path | Proof | AllSeparated
    decimals: str | None = None
    leeway: Fraction | None = None


def answer_from_json(findings: Findings, data: Any) -> Read:
    """Read the answer in a decoded JSON value; raise all its problems through `findings`."""
    kind = data.get("answer") if isinstance(data, dict) else None
    if isinstance(data, dict) and "robot" in data and kind is None:
        raise InvalidFileError(findings.file, [whole("a scene, no answer; give a file that cfree plan -o wrote")])
    if not isinstance(kind, str) or kind not in _MODELS:
        named = isinstance(data, dict) and "answer" in data
        fault = 'no answer: "answer" is missing'
        fault = 'expected "path", "separated", "stuck", "unreachable" or "all separated", got {got}' if named else fault
        findings.under(("answer",) if named else (), f"{fault}; give a file that `save` of a path or a proof wrote")
        findings.fail_if_any()
    kind_of_model = _MODELS[str(kind)]
    try:
        model = kind_of_model.model_validate(data)
    except ValidationError as error:
        for item in error.errors(include_url=False, include_input=False):
            path = item["loc"]
            if path[:1] in (("motions",), ("proofs",)) and len(path) > 2:
                path = (*path[:2], *path[3:])  # without the tag of the union
            if item["type"].startswith("union_tag") and path[:1] == ("proofs",):
                findings.under(path, 'expected a proof with "answer": "separated", "stuck" or "unreachable", got {got}')
            elif item["type"].startswith("union_tag"):
                kinds = '"translation", "rotation" or "slide"'
                findings.under(path, f'expected a motion with "type": {kinds}, got {{got}}')
            elif item["type"] == "literal_error":
                findings.under(path, f"expected {item['ctx']['expected']}, got {{got}}".replace("'", '"'))
            elif item["type"] in ("model_type", "model_attributes_type"):
                findings.under(path, "expected an object {...}, got {got}")
            else:
                report(findings, path, item, lambda place: _keys_at(kind_of_model, place))
        findings.fail_if_any()
        raise
    for place, message in _faults(model, data):
        findings.under(place, message)
    findings.fail_if_any()
    if not isinstance(model, PathModel):
        return Read(model.result)
    return Read(completed(model), model.decimals, leeway_of(model, data) if model.decimals == "free" else None)


def _faults(model: Model, data: Any) -> Faults:
    if isinstance(model, PathModel):
        yield from path_faults(model, data)
    elif isinstance(model, SeparationModel | StuckModel | UnreachableModel):
        yield from effect_faults(model, Path(model.ends[0], ()), data)
    else:
        for k, proof in enumerate(model.proofs):
            yield from ((("proofs", k, *place), text) for place, text in _faults(proof, data["proofs"][k]))


def _keys_at(model: type[BaseModel], place: Place) -> list[str]:
    """Return the keys of the object at a place."""
    models = {model}
    for step in (step for step in place if isinstance(step, str)):
        fields = [field for m in models for key, field in m.model_fields.items() if step in (key, field.alias)]
        models = {inner for field in fields for inner in _models(field)}
    return [f.alias or key for m in sorted(models, key=lambda m: m.__name__) for key, f in m.model_fields.items()]


def _models(field: Any) -> Iterator[type[BaseModel]]:
    """Yield the models in a field's type."""
    todo = [field.annotation]
    while todo:
        kind = todo.pop()
        if isinstance(kind, type) and issubclass(kind, BaseModel):
            yield kind
        todo += get_args(kind)
