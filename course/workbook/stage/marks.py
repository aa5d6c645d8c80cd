"""What pictures in SVG are made of: polygons, arrows, lines with their number, words."""

from __future__ import annotations

import html
from typing import Any

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from course.arrays import Array
from course.workbook.plots.figure import PALETTE

INK, SOFT, FIXED = "#16191d", "#5b6470", "#c9cfd6"


def shaded(color: str, lit: float) -> str:
    red, green, blue = (int(color[i : i + 2], 16) for i in (1, 3, 5))
    return "#" + "".join(f"{min(255, round(lit * c)):02x}" for c in (red, green, blue))


def hull(points: Array) -> Array:
    if len(points) < 3:
        return points
    try:
        return np.asarray(points[ConvexHull(points).vertices])
    except QhullError:  # all on a line
        along = points @ (points[-1] - points[0])
        return points[[along.argmin(), along.argmax()]]


def outline(points: Array, radius: float, color: str) -> str:
    if len(points) == 1:
        x, y = points[0]
        return (
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{max(radius, 0.5):.1f}" fill="{color}" '
            f'stroke="{INK}"/>'
        )
    around = polygon(points, color, f"{2 * radius + 1.5:.1f}", INK)
    return around + polygon(points, color, f"{2 * radius:.1f}")


def polygon(points: Array, fill: str, wide: str = "0.5", edge: str = "") -> str:
    listed = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return (
        f'<polygon points="{listed}" fill="{fill}" stroke="{edge or fill}" '
        f'stroke-width="{wide}" stroke-linejoin="round"/>'
    )


def arrow(start: Array, tip: Array, color: str) -> str:
    length = float(np.linalg.norm(tip - start))
    if length < 0.5:
        return ""
    along = (tip - start) / length
    aside = np.array([-along[1], along[0]])
    head = min(11.0, 0.6 * length)
    neck = tip - head * along
    points = np.array([tip, neck + 0.42 * head * aside, neck - 0.42 * head * aside])
    (x, y), (a, b) = start, neck
    return (
        f'<path d="M{x:.1f} {y:.1f}L{a:.1f} {b:.1f}" stroke="{color}" '
        f'stroke-width="{min(2.4, 0.38 * head):.1f}"/>{polygon(points, color, "0")}'
    )


def segments(shown: Any, index: int, screen: Any) -> list[str]:
    color = PALETTE[shown.color]
    ends = (np.asarray(shown.start)[index], np.asarray(shown.end)[index])
    return [
        f'<path d="M{x:.1f} {y:.1f}L{a:.1f} {b:.1f}" stroke="{color}" stroke-width="2"/>'
        for (x, y), (a, b) in zip(*map(screen, ends), strict=True)
    ]


def text(
    place: Array, words: str, color: str, weight: str, anchor: str = "middle", behind: str = "#fff"
) -> str:  # fmt: skip
    """Words at a place, with a rim of what is behind them: lines may run there."""
    x, y = place
    return (
        f'<text x="{x:.1f}" y="{y + 5:.1f}" text-anchor="{anchor}" fill="{color}" '
        f'stroke="{behind}" stroke-width="3" paint-order="stroke" '
        f'font-weight="{weight}">{html.escape(words)}</text>'
    )


def ink_on(color: str) -> str:
    """Black or white, whichever is read better on a colour (WCAG's contrast)."""
    channels = np.array([int(color[i : i + 2], 16) / 255 for i in (1, 3, 5)])
    linear = np.where(
        channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4
    )
    light = float(linear @ [0.2126, 0.7152, 0.0722]) + 0.05
    return "#ffffff" if 1.05 / light >= light / 0.055 else "#111418"


def line(points: Array, color: str, wide: float, alpha: float = 1.0) -> str:
    """A line through points (k, 2)."""
    listed = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    faint = f' stroke-opacity="{alpha:g}"' if alpha < 1 else ""
    return f'<polyline points="{listed}" fill="none" stroke="{color}" stroke-width="{wide:.1f}"{faint}/>'


def head(neck: Array, tip: Array, half: float, color: str) -> str:
    """The head of an arrow, ``half`` as wide; a disc where it is seen from its end."""
    along = tip - neck
    length = float(np.linalg.norm(along))
    disc = (
        f'<circle cx="{neck[0]:.1f}" cy="{neck[1]:.1f}" r="{half:.1f}" fill="{color}"/>'
    )
    if length < half:
        return disc
    aside = half * np.array([-along[1], along[0]]) / length
    return polygon(np.array([tip, neck + aside, neck - aside]), color)


def round_ball(middle: Array, radius: float, color: str, toward: Array) -> str:
    """A ball lit from one side, ``toward`` it on the canvas (unit vector or shorter)."""
    (x, y), (a, b) = middle, middle + 0.35 * radius * toward
    return (
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius:.1f}" fill="{shaded(color, 0.72)}"/>'
        f'<circle cx="{(x + a) / 2:.1f}" cy="{(y + b) / 2:.1f}" r="{0.8 * radius:.1f}" fill="{shaded(color, 0.86)}"/>'
        f'<circle cx="{a:.1f}" cy="{b:.1f}" r="{0.55 * radius:.1f}" fill="{color}"/>'
    )
