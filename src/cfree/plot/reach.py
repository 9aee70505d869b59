"""Pictures of maps of reach, and of audited floor plans."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cfree.analysis.audit import Audit, Door, Result
from cfree.analysis.reach_map import ReachMap
from cfree.arguments import checked
from cfree.palette import AHEAD, BACK, CATEGORIES, FORBIDDEN, GREY, INK, LOST, SEQUENTIAL, paler
from cfree.plot.boundary import around, new_axes, new_figure, plain, set_window
from cfree.plot.workspace import draw_robot, draw_surroundings, path_of, rings_of_geometry
from cfree.scene.smooth import smooth
from cfree.words import counted, near

PIXELS = 700  # along the longer side
ACROSS = 2  # panels beside each other
DOORS: dict[Result, tuple[str, str]] = {
    "passes": (AHEAD, "passes"),
    "around": (BACK, "another way only"),
    "blocked": (LOST, "cannot pass: proved"),
    "no room": (GREY, "no room on one side"),
}


@checked
def plot_reach(reached: ReachMap, ax: Axes | None = None) -> Axes:
    """Draw the positions that a machine reaches, coloured by the share of orientations at which it does.

    Parameters
    ----------
    reached : ReachMap
    ax : matplotlib axes, optional

    Returns
    -------
    matplotlib axes
        Positions that are free at some orientation, but not reached, are grey. Starts are drawn as the robot.

    Examples
    --------
    >>> from cfree import Scene, reach
    >>> scene = Scene([(0, 0), (1, 0), (0, 1)], workspace=[(0, 0), (4, 0), (4, 3), (0, 3)])
    >>> plot_reach(reach(scene, [(1, 1, 0)], 8)).get_title()
    'reached at a share of 8 orientations'
    """
    from matplotlib.patches import PathPatch

    scene, count = smooth(reached.scene), len(reached.theta)
    ax = ax or new_axes((8.5, 6), (0.09, 0.11, 0.86, 0.81))
    boxes = draw_surroundings(ax, scene)
    x0, y0, x1, y1 = reached.extent
    size = max(x1 - x0, y1 - y0) / PIXELS
    counts = reached.counts(size)
    rows, columns = counts.shape
    import shapely

    free = path_of(rings_of_geometry(shapely.union_all(list(reached.free))))
    ax.add_patch(PathPatch(free, facecolor=FORBIDDEN, edgecolor="none", zorder=1.2))
    place = (x0, x0 + columns * size, y0, y0 + rows * size)
    shares = np.ma.masked_equal(counts, 0) / count
    image = ax.imshow(shares, extent=place, cmap=SEQUENTIAL, vmin=0, vmax=1, zorder=1.5, interpolation="nearest")
    boxes += [draw_robot(ax, scene, pose, faint=False) for pose in reached.starts]
    set_window(ax, around(boxes), scene.units)
    bar = ax.figure.colorbar(image, ax=ax, shrink=0.8)
    bar.set_ticks([0, 0.25, 0.5, 0.75, 1], labels=["0", "1/4", "1/2", "3/4", "all"])
    ax.set_title(f"reached at a share of {counted(count, 'orientation')}")
    return ax


@checked
def plot_audit(audited: Audit) -> Figure:
    """Draw an audited floor plan for each machine: rooms, and doors by their results, with missing widths.

    Parameters
    ----------
    audited : Audit

    Returns
    -------
    matplotlib figure

    Examples
    --------
    >>> from cfree import Scene, audit
    >>> walls = [[(4, 0), ("4.2", 0), ("4.2", 1), (4, 1)], [(4, "1.8"), ("4.2", "1.8"), ("4.2", 5), (4, 5)]]
    >>> chair = [("-0.6", "-0.35"), ("0.6", "-0.35"), ("0.6", "0.35"), ("-0.6", "0.35")]
    >>> rooms = Scene(chair, walls, workspace=[(0, 0), (9, 0), (9, 5), (0, 5)])
    >>> [ax.get_title() for ax in plot_audit(audit(rooms, {"wheelchair": chair})).axes]
    ['wheelchair: passes 1 of 1 door']
    """
    machines = [*audited.machines]
    across = min(ACROSS, len(machines))
    down = math.ceil(len(machines) / across)
    figure = new_figure((1 + 6.5 * across, 0.4 + 5.2 * down))
    figure.set_layout_engine("constrained", rect=(0, 0.03, 1, 0.94))
    grid = figure.subplots(down, across, squeeze=False)
    for ax, machine in zip(grid.flat, machines, strict=False):
        _draw_machine(ax, audited, machine)
    for ax in [*grid.flat][len(machines) :]:
        ax.set_axis_off()
    return figure


def _draw_machine(ax: Axes, audited: Audit, machine: str) -> None:
    from matplotlib.lines import Line2D
    from matplotlib.patches import PathPatch
    from matplotlib.patheffects import withStroke

    scene = smooth(audited.machines[machine])
    boxes = draw_surroundings(ax, scene, frame=False)
    halo = [withStroke(linewidth=2.5, foreground="white")]
    for k, (name, room) in enumerate(audited.rooms.items()):
        colour = paler(CATEGORIES[k % len(CATEGORIES)], 0.8)
        ax.add_patch(PathPatch(path_of(rings_of_geometry(room)), facecolor=colour, edgecolor="none", zorder=0.8))
        if name != "outside":
            point = room.representative_point()
            ax.text(point.x, point.y, name, ha="center", va="center", fontsize=8, color=GREY, zorder=4)
    doors = [door for door in audited.doors if door.machine == machine]
    start = next((door.start for door in doors if door.start is not None), None)
    if start is not None:
        draw_robot(ax, scene, start, faint=True, mark=False)
    for door in doors:
        (x, y), (u, v) = door.ends
        colour, _ = DOORS[door.result]
        ax.plot([x, u], [y, v], color=colour, linewidth=4, solid_capstyle="butt", zorder=5)
        ax.text(
            *door.middle, _label(door), ha="center", va="bottom", fontsize=9, color=INK, zorder=6, path_effects=halo
        )
    set_window(ax, around(boxes), scene.units)
    kinds = [result for result in DOORS if any(door.result == result for door in doors)]
    handles = [Line2D([], [], color=DOORS[kind][0], linewidth=4, label=DOORS[kind][1]) for kind in kinds]
    if handles:
        ax.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=len(handles), fontsize=9)
    passed = sum(door.result == "passes" for door in doors)
    ax.set_title(plain(f"{machine}: passes {passed} of {counted(len(doors), 'door')}"))


def _label(door: Door) -> str:
    """Return the width of a door, and how much of it is missing."""
    missing = f"\n{near(door.missing.hi, 10 * door.missing.hi)} missing" if door.missing else ""
    return f"{near(door.width, door.width)}{missing}"
