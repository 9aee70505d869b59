"""Rules of the map servers: the occupancy, from 0 to 100, that each of them publishes for the colours of an image.

ROS 1 (map_server) and the older nav2 (nav2_map_server, a loop over pixels) compute in doubles and want a share above
``occupied_thresh`` or below ``free_thresh``. The present nav2 computes in single precision, takes a share on a
threshold, and lets free win. "strict" is the strictest of the three.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

Rules = Literal["strict", "nav2", "nav2-old", "ros1"]
Mode = Literal["trinary", "scale", "raw"]
Server = Literal["ros1", "nav2-old", "nav2"]
Values = NDArray[np.int16]
Shares = NDArray[np.floating[Any]]
Numbers = NDArray[np.int64]

SERVERS: tuple[Server, ...] = ("ros1", "nav2-old", "nav2")
OCCUPIED, FREE, UNKNOWN = 100, 0, -1
SAVED_UNKNOWN = 205
"""The grey that map_saver writes for unknown cells."""
_NEAR = 1e-6  # a share as near to a threshold counts as on it
_DEEP = 65535  # brightness of white in `Colours`


@dataclass(frozen=True)
class Colours:
    """Colours of an image.

    Attributes
    ----------
    rgb : (n, 3) array of int
        Brightness from 0 to 65535; that of a byte b is 257 b.
    alpha : (n,) array of int or None
        The same for opacity; None if the image has no such channel.
    is_grey : bool
        True if the file has one channel of brightness.
    """

    rgb: Numbers
    alpha: Numbers | None = None
    is_grey: bool = True

    @property
    def greys(self) -> Numbers:
        """The mean of the channels in bytes."""
        mean: Numbers = (self.rgb >> 8).sum(axis=1) // 3
        return mean


@dataclass(frozen=True)
class Thresholds:
    """The values of a map's YAML that decide about its cells."""

    occupied: float
    free: float
    negate: bool = False
    mode: Mode = "trinary"


def published(rules: Rules, colours: Colours, limits: Thresholds) -> Values:
    """Return the value of each colour: 0 is free, 100 occupied, 1 to 99 in between, -1 unknown.

    Examples
    --------
    >>> black, white = Colours(np.zeros((1, 3), int)), Colours(np.full((1, 3), 65535))
    >>> limits = Thresholds(1.0, 0.0)
    >>> [int(published(rules, black, limits)[0]) for rules in ("ros1", "nav2", "strict")]
    [-1, 100, 100]
    >>> [int(published(rules, white, limits)[0]) for rules in ("ros1", "nav2", "strict")]
    [-1, 0, -1]
    """
    if rules != "strict":
        return _of_server(rules, colours, limits, strict=False)
    every = np.stack([_of_server(server, colours, limits, strict=True) for server in SERVERS])
    most: Values = every.max(axis=0)
    return np.where(most > FREE, most, every.min(axis=0))


def _of_server(server: Server, colours: Colours, limits: Thresholds, strict: bool) -> Values:
    if limits.mode == "raw":
        return _raw(server, colours, limits.negate)
    shares = _shares(server, colours, limits)
    exact = shares.dtype.type
    occupied, free = exact(limits.occupied), exact(limits.free)
    on_occupied, on_free = (abs(shares - limit) <= _NEAR for limit in (limits.occupied, limits.free))
    if server == "nav2":
        over, under = (shares >= occupied) | on_occupied, shares <= free
    else:
        over, under = shares > occupied, (shares < free) & ~on_free
    if strict:
        over |= on_occupied
    values = np.full(shares.shape, UNKNOWN, dtype=np.int16)
    if limits.mode == "scale":
        values = _between(server, shares, limits)
        if server == "ros1":
            values[_last_channel(colours) == 0] = UNKNOWN
    values[under] = FREE
    values[over & ~under if server == "nav2" else over] = OCCUPIED
    if colours.alpha is not None and (server == "nav2" or (server == "nav2-old" and limits.mode == "scale")):
        values[colours.alpha < _DEEP] = UNKNOWN
    return values


def _shares(server: Server, colours: Colours, limits: Thresholds) -> Shares:
    """Return shares of black, of white if the map is negated, in the precision of the server."""
    if server == "nav2":
        white: Shares = _luma(colours).astype(np.float32) / np.float32(255)
        return white if limits.negate else np.float32(1) - white
    deep = server == "nav2-old"
    channels = [colours.rgb[:, k] for k in range(3)]
    if colours.alpha is not None and limits.mode == "trinary":
        channels.append(colours.alpha)
    mean: Shares = np.sum([channel if deep else channel >> 8 for channel in channels], axis=0) / float(len(channels))
    if deep:
        return mean / _DEEP if limits.negate else 1.0 - mean / _DEEP
    if limits.negate:
        mean = 255 - mean
    return (255 - mean) / 255.0


def _luma(colours: Colours) -> Numbers:
    """Return the grey bytes of GraphicsMagick."""
    red, green, blue = colours.rgb.T
    grey: Numbers = (306 * red + 601 * green + 117 * blue) // 1024 // 257
    return grey


def _last_channel(colours: Colours) -> Numbers:
    """Return the channel that ROS 1 takes for alpha: without one, the last colour."""
    if colours.alpha is not None:
        return colours.alpha >> 8
    return np.ones(len(colours.rgb), dtype=np.int64) if colours.is_grey else colours.rgb[:, 2] >> 8


def _between(server: Server, shares: Shares, limits: Thresholds) -> Values:
    """Return the values of shares between the thresholds."""
    if limits.occupied <= limits.free:
        return np.full(shares.shape, UNKNOWN, dtype=np.int16)
    exact = shares.dtype.type
    ratio = (shares - exact(limits.free)) / exact(limits.occupied - limits.free)
    if server == "ros1":
        values = np.trunc(99 * ratio)
    elif server == "nav2-old":
        values = np.rint(ratio * 100.0)
    else:
        values = np.floor(ratio * exact(100) + exact(0.5))
    return np.clip(values, FREE, OCCUPIED).astype(np.int16)


def _raw(server: Server, colours: Colours, negate: bool) -> Values:
    if server == "nav2":
        grey = _luma(colours)
    else:
        mean = (colours.rgb >> 8).sum(axis=1) / 3.0
        grey = np.trunc(255 - mean if negate and server == "ros1" else mean).astype(np.int64)
        if server == "nav2-old":
            grey = np.floor(colours.rgb.sum(axis=1) / 3.0 / _DEEP * 255 + 0.5).astype(np.int64)
    most = 127 if server == "ros1" else OCCUPIED  # ROS 1 publishes more than 100, which its costmap takes for lethal
    return np.where(grey <= most, np.minimum(grey, OCCUPIED), UNKNOWN).astype(np.int16)
