"""Write maps of reach: a ROS map (YAML and PNG), or GeoJSON with a region for each orientation.

Grey 254 is reached, 205 free but not reached, 0 not free: free, unknown and occupied to a map server in trinary mode.

| feature | geometry | properties |
|---|---|---|
| orientation | MultiPolygon | role "reached", theta in radians, degrees |
| all of them | MultiPolygon | role "reached", which: "some", "every" or "turning" |

Coordinates are those of the scene, not degrees on the globe.
"""

from __future__ import annotations

import json
import math
from os import PathLike
from pathlib import Path
from typing import Any, get_args

from cfree.analysis.reach_map import ReachMap, Which
from cfree.formats.text.atomic import checked_suffix, replacing


def save_reach(
    reached: ReachMap, path: str | PathLike[str], resolution: float | None = None, which: Which = "some"
) -> None:
    """Write a map of reach; ``reach.yaml`` also writes the image ``reach.png``."""
    if check_reach_path(path) == ".geojson":
        with replacing(path) as unfinished:
            unfinished.write_text(json.dumps(reach_geojson(reached)) + "\n", encoding="utf-8")
        return
    from PIL import Image

    image, size, (x0, y0, _, _) = reached.image(resolution, which), reached.resolution(resolution), reached.extent
    with replacing(image_of(path)) as unfinished:
        Image.fromarray(image).save(unfinished, format="PNG")
    lines = [f"image: {json.dumps(image_of(path).name)}", "mode: trinary", f"resolution: {size!r}"]
    lines += [f"origin: [{x0!r}, {y0!r}, 0.0]", "negate: 0", "occupied_thresh: 0.65", "free_thresh: 0.196"]
    with replacing(path) as unfinished:
        unfinished.write_text("\n".join(lines) + "\n", encoding="utf-8")


def reach_geojson(reached: ReachMap) -> dict[str, Any]:
    """Return the feature collection of a map of reach.

    Examples
    --------
    >>> from cfree.analysis.reach_map import reach
    >>> from cfree.scene.scene import Scene
    >>> scene = Scene([(0, 0), (1, 0), (0, 1)], workspace=[(0, 0), (4, 0), (4, 3), (0, 3)])
    >>> features = reach_geojson(reach(scene, [(1, 1, 0)], 4))["features"]
    >>> [feature["properties"].get("which", feature["properties"].get("degrees")) for feature in features]
    [0.0, 90.0, 180.0, 270.0, 'some', 'every', 'turning']
    """
    features = [
        _feature(region, theta=theta, degrees=math.degrees(theta))
        for theta, region in zip(reached.theta.tolist(), reached.reached, strict=True)
    ]
    features += [_feature(getattr(reached, which), which=which) for which in get_args(Which)]
    return {"type": "FeatureCollection", "features": features}


def check_reach_path(path: str | PathLike[str]) -> str:
    """Return the suffix of a file that `save_reach` can write."""
    return checked_suffix(path, "map", (".yaml", ".geojson"))


def image_of(path: str | PathLike[str]) -> Path:
    """Return the name of the image beside a map's YAML."""
    return Path(path).with_suffix(".png")


def _feature(region: Any, **properties: Any) -> dict[str, Any]:
    import shapely

    polygons = [part for part in shapely.get_parts(region).tolist() if part.geom_type == "Polygon"]
    whole = shapely.orient_polygons(shapely.MultiPolygon(polygons))
    return {
        "type": "Feature",
        "properties": {"role": "reached", **properties},
        "geometry": shapely.geometry.mapping(whole),
    }
