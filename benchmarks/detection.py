"""Broad phases on 100,000 moving boxes, each frame whole: moved, updated, sorted pairs in arrays.

The scenes have a constant number of pairs a box: cubes with centres uniform in a cube, and
cubes in clusters of a hundred, of which there are more where there are more cubes. From
frame to frame each cube moves by about a fifth of its side.

Ours makes its boxes of new centres and returns all pairs sorted. coal and python-fcl keep a
dynamic AABB tree: every object is moved by a call from Python, the tree is updated, and asked
for its pairs; coal's stay in C++, since its binding gives none of them out, fcl's come by a
callback. coal is also timed without its calls per object. cKDTree answers for equal cubes
alone: it is built anew, asked for the centres within a side of each other in the maximum
norm, and its pairs are sorted.

A world of as many oriented boxes is asked for its contacts: anew, and in a frame in which one
in a hundred has moved.
"""

from __future__ import annotations

import importlib.util
import itertools
import time
from collections.abc import Callable

import numpy as np
from scipy.spatial import cKDTree

from benchmarks.measure import Row, ratio, seconds
from course.arrays import Array
from course.detection import CollisionWorld, broad_phase, method_for
from course.detection.choosing import METHODS
from course.shapes import AABB, OBB

COUNT = 100_000
SIZES = (1_000, 3_000, 10_000, 30_000, 100_000, 300_000)
#: The default may be this much slower than the best of ours, and grow no faster than so.
SLOWER, EXPONENT = 1.2, 1.1
#: A coherent frame of a world is to be so many times as quick as a fresh one.
COHERENT = 5.0
#: Those that are timed against the default; all pairs of 100,000 boxes take minutes.
OURS = ("sweep_and_prune", "uniform_grid", "kd_tree", "sphere_tree", "bvh")

#: Runs a frame; the seconds of each that were spent inside; how many pairs there are at given centres.
Peer = tuple[Callable[[], object], list[float], Callable[[Array], int]]


def rows() -> list[Row]:
    """The rows of this module."""
    made = []
    for name, scene, goals in (
        ("uniform", uniform, {"coal": 4.0, "fcl": 8.0}),
        ("clustered", clustered, {"coal": 2.0, "fcl": 4.0}),
    ):
        frames, side = _frames(scene)
        made += _peers(name, frames, side, goals)
        made.append(_scipy(name, frames, side))
        made.append(_limit(name, frames[0], side))
    scenes = {"uniform": uniform, "clustered": clustered, "mixed 1:1000": mixed, "one axis": on_one_axis}  # fmt: skip
    made += [_best_of_ours(name, scene) for name, scene in scenes.items()]
    made.append(_coherent())
    return [*made, _growth("uniform", uniform), _growth("clustered", clustered)]


def uniform(n: int, rng: np.random.Generator) -> tuple[Array, Array | float]:
    """Centres, and the side that makes two pairs a box."""
    return rng.uniform(0, 1, (n, 3)), 0.8 * n ** (-1 / 3)


def clustered(n: int, rng: np.random.Generator) -> tuple[Array, Array | float]:
    groups = n // 100
    middle = rng.uniform(0, 20 * groups ** (1 / 3), (groups, 3))
    return middle[rng.integers(groups, size=n)] + rng.normal(size=(n, 3)), 0.6


def mixed(n: int, rng: np.random.Generator) -> tuple[Array, Array | float]:
    side = 10 ** rng.uniform(0, 3, (n, 1)) * rng.uniform(0.5, 1, (n, 3))
    return rng.uniform(0, 400 * n ** (1 / 3), (n, 3)), side


def on_one_axis(n: int, rng: np.random.Generator) -> tuple[Array, Array | float]:
    center = np.zeros((n, 3))
    center[:, 0] = rng.uniform(0, n, n)
    return center, 1.5


def boxes_of(center: Array, side: Array | float) -> AABB:
    return AABB(center - 0.5 * np.asarray(side), center + 0.5 * np.asarray(side))


def _frames(scene: Callable[..., tuple[Array, Array | float]]) -> tuple[list[Array], float]:  # fmt: skip
    rng = np.random.default_rng(7)
    center, side = scene(COUNT, rng)
    step = 0.2 * float(np.max(side)) * rng.normal(size=center.shape)
    return [center, center + step], float(np.max(side))


def _peers(
    name: str, frames: list[Array], side: float, goals: dict[str, float]
) -> list[Row]:
    made = []
    turn = itertools.cycle(frames)

    def ours() -> object:
        return broad_phase(boxes_of(next(turn), side))

    for peer, goal in goals.items():
        label = f"{name}, {COUNT} moved boxes: {peer} / ours"
        if importlib.util.find_spec(peer) is None:
            made.append(Row(label, float("nan"), goal, f"{peer} is not installed"))
            continue
        frame, inside, pairs = (_coal if peer == "coal" else _fcl)(frames, side)
        quotient, theirs, mine = ratio(frame, ours, repeats=4)
        _require_same(pairs(frames[0]), len(broad_phase(boxes_of(frames[0], side))))
        remark = f"{theirs * 1e3:.0f} against {mine * 1e3:.1f} ms a frame"
        made.append(Row(label, quotient, goal, remark))
        if peer == "coal":
            alone = min(inside)
            remark = f"{alone * 1e3:.0f} against {mine * 1e3:.1f} ms a frame"
            label = f"{name}: coal's update and collide alone / ours, whole"
            made.append(Row(label, alone / mine, None, remark))
    return made


def _require_same(theirs: int, mine: int) -> None:
    if theirs != mine:
        raise ValueError(f"pairs: expected {mine}, as ours are; got {theirs}")


def _coal(frames: list[Array], side: float) -> Peer:
    """A frame of coal's tree, what of it is spent inside, and how many pairs there are at given places."""
    import coal

    shape = coal.Box(side, side, side)
    objects = [coal.CollisionObject(shape) for _ in range(COUNT)]
    manager = coal.DynamicAABBTreeCollisionManager()
    inside: list[float] = []

    def placed(center: Array) -> int:
        for thing, place in zip(objects, center, strict=True):
            thing.setTranslation(place)
            thing.computeAABB()
        begin = time.perf_counter()
        manager.update()
        found = coal.CollisionCallBackCollect(100 * COUNT)
        found.init()
        manager.collide(found)
        inside.append(time.perf_counter() - begin)
        return int(found.numCollisionPairs())

    for thing, place in zip(objects, frames[0], strict=True):
        thing.setTranslation(place)
        thing.computeAABB()
        manager.registerObject(thing)
    manager.setup()
    turn = itertools.cycle(frames)
    return lambda: placed(next(turn)), inside, placed


def _fcl(frames: list[Array], side: float) -> Peer:
    """A frame of python-fcl's tree, nothing, and how many pairs there are at given places."""
    import fcl

    shape = fcl.Box(side, side, side)
    objects = [fcl.CollisionObject(shape) for _ in range(COUNT)]
    for thing, place in zip(objects, frames[0], strict=True):
        thing.setTranslation(place)
    manager = fcl.DynamicAABBTreeCollisionManager()
    manager.registerObjects(objects)
    manager.setup()

    def placed(center: Array) -> int:
        for thing, place in zip(objects, center, strict=True):
            thing.setTranslation(place)
        manager.update()
        found: list[object] = []

        def keep(a: object, b: object, data: object) -> bool:
            found.append((a, b))
            return False

        manager.collide(None, keep)
        return len(found)

    turn = itertools.cycle(frames)
    return lambda: placed(next(turn)), [], placed


def _scipy(name: str, frames: list[Array], side: float) -> Row:
    turn, theirs = itertools.cycle(frames), itertools.cycle(frames)

    def tree() -> object:
        found = cKDTree(next(theirs)).query_pairs(side, p=np.inf, output_type="ndarray")
        return found[np.lexsort((found[:, 1], found[:, 0]))]

    def ours() -> object:
        return broad_phase(boxes_of(next(turn), side))

    quotient, spent, mine = ratio(tree, ours, repeats=3)
    remark = f"{spent * 1e3:.0f} against {mine * 1e3:.1f} ms a frame"
    return Row(f"{name}: SciPy's cKDTree / ours", quotient, None, remark)


def _limit(name: str, center: Array, side: float) -> Row:
    """Sorting the keys of the boxes and writing the pairs, which nobody can do without."""
    from course.detection.pair_loops import radix_order, sorted_pairs

    boxes = boxes_of(center, side)
    pairs = broad_phase(boxes).astype(np.int32)
    keys = (pairs.size * np.random.default_rng(0).random(COUNT)).astype(np.int64)
    bare = lambda: (radix_order(keys, 22), sorted_pairs(pairs, COUNT))  # noqa: E731
    quotient, least, mine = ratio(bare, lambda: broad_phase(boxes))
    remark = f"{least * 1e3:.1f} of {mine * 1e3:.1f} ms; {len(pairs) / COUNT:.2f} pairs a box"  # fmt: skip
    return Row(f"{name}: keys sorted and pairs written / ours", quotient, None, remark)


def _best_of_ours(name: str, scene: Callable[..., tuple[Array, Array | float]]) -> Row:
    boxes = boxes_of(*scene(COUNT, np.random.default_rng(3)))
    spent = {}
    for method in OURS:
        once = _seconds(lambda m=method: METHODS[m](boxes))  # type: ignore[misc]
        spent[method] = once
    mine = spent[method_for(boxes)]
    best = min(spent, key=lambda m: spent[m])
    told = ", ".join(f"{m} {t * 1e3:.0f}" for m, t in spent.items())
    remark = f"{told} ms; default {method_for(boxes)}"
    return Row(
        f"{name}: best of ours / default", spent[best] / mine, 1 / SLOWER, remark
    )


def _seconds(work: Callable[[], object]) -> float:
    """As ``seconds``, but what takes long is run once."""
    work()
    begin = time.perf_counter()
    work()
    once = time.perf_counter() - begin
    return once if once > 1.0 else min(once, seconds(work))


def _growth(name: str, scene: Callable[..., tuple[Array, Array | float]]) -> Row:
    """The exponent of the time against the number of boxes, fitted to six sizes."""
    spent = []
    for n in SIZES:
        boxes = boxes_of(*scene(n, np.random.default_rng(5)))
        spent.append(seconds(lambda b=boxes: broad_phase(b)))  # type: ignore[misc]
    exponent = float(np.polyfit(np.log(SIZES), np.log(spent), 1)[0])
    told = ", ".join(f"{t * 1e6 / n:.2f}" for n, t in zip(SIZES, spent, strict=True))
    remark = f"N^{exponent:.2f}; {told} us a box from {SIZES[0]} to {SIZES[-1]}"
    return Row(f"{name}: {EXPONENT} / exponent of growth", EXPONENT / exponent, 1.0, remark)  # fmt: skip


def _coherent() -> Row:
    """Contacts of a world that has just been filled against those of the next frame, its moves included."""
    rng = np.random.default_rng(7)
    center, side = uniform(COUNT, rng)
    box = OBB(np.zeros((COUNT, 3)), np.eye(3), np.full(3, 0.5 * side))
    fresh, frames = [], []
    for _ in range(3):
        world = CollisionWorld()
        handles = world.add(box, body=np.arange(COUNT))
        world.move(handles, np.eye(3), center)
        fresh.append(_once(world.contacts))
        for _ in range(3):
            some = np.sort(rng.choice(COUNT, COUNT // 100, replace=False))
            place = center[some] + 0.2 * np.max(side) * rng.normal(size=(some.size, 3))

            def frame(moved=handles[some], place=place, world=world) -> object:
                world.move(moved, np.eye(3), place)
                return world.contacts()

            frames.append(_once(frame))
    counters = world.counters
    remark = (
        f"{min(fresh) * 1e3:.0f} against {min(frames) * 1e3:.0f} ms; {counters.contacts} "
        f"contacts; {counters.boxes.tested} of {counters.pairs} pairs tested"
    )
    quotient = min(fresh) / min(frames)
    return Row(f"{COUNT} boxes: a fresh world / 1 % moved", quotient, COHERENT, remark)


def _once(work: Callable[[], object]) -> float:
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin
