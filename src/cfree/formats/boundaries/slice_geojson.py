"""Write slices as GeoJSON: the forbidden region, and the contact segments with the features that touch.

Coordinates are those of the scene, not degrees on the globe.

| feature | geometry | properties |
|---|---|---|
| region | Polygon or MultiPolygon | role "forbidden", theta in radians; among round shapes error |
| contact | LineString, forbidden on its left | role "contact", patch, kind, robot, obstacle, obstacle_feature |

Arcs are chords; `error` is the greatest distance between the two.

`robot` and `obstacle_feature` are the vertices that touch, or the first vertices of edges that touch; `obstacle` is a
name.
"""

from __future__ import annotations

import json
from os import PathLike
from typing import Any

from cfree.forbidden.patch import Patches
from cfree.forbidden.slice import Slice
from cfree.formats.text.atomic import checked_suffix, replacing


def slice_geojson(cut: Slice) -> dict[str, Any]:
    """Return the feature collection of a slice.

    Examples
    --------
    >>> from cfree.forbidden.boundary import boundary
    >>> from cfree.formats.scene_file import load_scene
    >>> cut = boundary(load_scene("examples/scenes/paper_fig9.json")).slice("30deg")
    >>> region, *contacts = slice_geojson(cut)["features"]
    >>> region["properties"]["role"], contacts[0]["properties"]["obstacle"], len(contacts)
    ('forbidden', 'triangle', 10)
    """
    import shapely

    region = shapely.geometry.mapping(shapely.orient_polygons(cut.forbidden))
    of_arcs = {"error": cut.error} if cut.boundary.scene.curved else {}
    features = [_feature(region, role="forbidden", theta=cut.theta, **of_arcs)]
    patches = Patches(cut.boundary)
    for ends, k in zip(cut.lines, cut.patches.tolist(), strict=True):
        patch = patches[k]
        features.append(
            _feature(
                {"type": "LineString", "coordinates": ends.tolist()},
                role="contact",
                patch=k,
                kind=patch.kind,
                robot=patch.robot.index,
                obstacle=patch.obstacle.name,
                obstacle_feature=patch.obstacle.index,
            )
        )
    return {"type": "FeatureCollection", "features": features}


def save_slice(cut: Slice, path: str | PathLike[str]) -> None:
    """Write a slice as GeoJSON, whole or not at all."""
    check_slice_path(path)
    with replacing(path) as unfinished:
        unfinished.write_text(json.dumps(slice_geojson(cut)) + "\n", encoding="utf-8")


def check_slice_path(path: str | PathLike[str]) -> str:
    """Return the suffix of a file that `save_slice` can write."""
    return checked_suffix(path, "slice", (".geojson", ".json"))


def _feature(geometry: Any, **properties: Any) -> dict[str, Any]:
    return {"type": "Feature", "properties": properties, "geometry": geometry}
