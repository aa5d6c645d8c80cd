"""What each phase of a world's last ``contacts`` did, and what it was spared."""

from __future__ import annotations

from dataclasses import dataclass, fields


@dataclass(frozen=True)
class Phase:
    """One phase of one frame.

    Args:
        tested: how many it looked at.
        dismissed: how many of these went no further.
        saved: how many it need not look at, because the last frame's answer holds.
    """

    tested: int = 0
    dismissed: int = 0
    saved: int = 0


@dataclass(frozen=True)
class Counters:
    """The phases of one frame in their order; what one does not dismiss the next one tests.

    Planes go from the boxes to the narrow phase at once.

    Args:
        broad: colliders (parts of compounds singly) that asked for partners; saved are
            those that are still inside their wide boxes. Of its pairs those are dismissed
            that may not touch.
        boxes: pairs by their own boxes; saved are pairs of which neither has moved.
        spheres: pairs by their bounding spheres.
        oriented: pairs by the boxes along their own axes.
        axes: pairs that had a separating axis, and those that still have it.
        narrow: pairs of shapes; dismissed are those without a contact.
        pairs: pairs that are kept for the next frame.
        calls: how often the narrow phase was called, once for each pair of kinds.
        contacts: how many contacts there are.
    """

    broad: Phase = Phase()
    boxes: Phase = Phase()
    spheres: Phase = Phase()
    oriented: Phase = Phase()
    axes: Phase = Phase()
    narrow: Phase = Phase()
    pairs: int = 0
    calls: int = 0
    contacts: int = 0

    def __str__(self) -> str:
        rows = [f"{'':10}{'tested':>10}{'dismissed':>10}{'saved':>10}"]
        for name in (f.name for f in fields(self)):
            value = getattr(self, name)
            if isinstance(value, Phase):
                numbers = (value.tested, value.dismissed, value.saved)
                rows.append(f"{name:10}" + "".join(f"{n:10}" for n in numbers))
        rows.append(f"{self.pairs} pairs kept, {self.calls} calls, {self.contacts} contacts")  # fmt: skip
        return "\n".join(rows)
