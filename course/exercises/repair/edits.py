"""All changes of a source, in the order in which they are tried, none twice."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import combinations

from course.exercises.repair.missing import longer, longer_by_two, longer_by_vectors
from course.exercises.repair.names import other_name
from course.exercises.repair.places import Code, Edit, patched
from course.exercises.repair.statements import statement_edits
from course.exercises.repair.taken_for import other
from course.exercises.repair.too_many import shorter

#: Something too many is tried first, something missing last: what is added could be anything.
STAGES = (1, 2, 3, 4, 5)
_GENERATORS = (
    (1, shorter),
    (1, other),
    (2, other_name),
    (3, longer),
    (4, longer_by_vectors),
    (5, longer_by_two),
)
#: What a batch asks for in every line that is not ready for one.
_OF_A_BATCH = ("an axis missing", "@ of a matrix and a batch of vectors")


def edits_of(code: Code) -> list[Edit]:
    """Every change of one place or statement, then of several alike places, sorted by stage."""
    found = dict[tuple[object, ...], Edit]()
    singles = list(_expression_edits(code))
    for edit in [
        *singles,
        *statement_edits(code),
        *_in_each(code, singles),
        *_in_some(singles),
    ]:
        if edit.applied(code.source) != code.source:
            found.setdefault(tuple(sorted(edit.patches)), edit)
    return sorted(found.values(), key=lambda e: e.stage)


def _expression_edits(code: Code) -> Iterator[Edit]:
    for place in code.places():
        start, end = code.span(place.node)
        for stage, generator in _GENERATORS:
            for kind, text in generator(code, place):
                bare = (
                    kind == "the order of the results"
                    or stage == 2
                    and text.isidentifier()
                )
                if kind == "brackets" and not _only_brackets(
                    code.source[start:end], text
                ):
                    kind = "brackets around another part"
                new = text if bare else f"({text})"
                yield Edit(kind, stage, ((start, end, new),), place.node.lineno)


def _only_brackets(old: str, new: str) -> bool:
    """Whether two texts are the same but for brackets."""
    one, other = (re.sub(r"[()\s]", "", text) for text in (old, new))
    return one == other


def _in_each(code: Code, singles: list[Edit]) -> Iterator[Edit]:
    """The same change in each of two to four places that are alike but for a twin's sign: both bodies, say."""
    groups: dict[tuple[str, str, str], list[Edit]] = {}
    for edit in singles:
        if edit.stage < 3 or edit.kind in (
            "a square missing",
            "a factor missing",
            "a matrix missing",
        ):
            ((start, end, text),) = edit.patches
            alike = (
                edit.kind,
                without_twin(code.source[start:end]),
                without_twin(text),
            )
            groups.setdefault(alike, []).append(edit)
    for members in groups.values():
        by_place = {e.patches[0][:2]: e for e in members}
        spans = sorted(by_place)
        apart = all(a[1] <= b[0] for a, b in zip(spans, spans[1:], strict=False))
        if 2 <= len(spans) <= 4 and apart:
            chosen = [by_place[s] for s in spans]
            patches = tuple(e.patches[0] for e in chosen)
            yield Edit(chosen[0].kind, chosen[0].stage, patches, chosen[0].line)


def _in_some(singles: list[Edit]) -> Iterator[Edit]:
    """What a batch asks for, in two or three places at once."""
    for kind in _OF_A_BATCH:
        some = [e for e in singles if e.kind == kind and _is_small(e)]
        for count in (2, 3):
            for chosen in combinations(some[:12], count):
                patches = sorted(e.patches[0] for e in chosen)
                pairs = zip(patches, patches[1:], strict=False)
                if all(a[1] <= b[0] for a, b in pairs):
                    yield Edit(kind, chosen[0].stage, tuple(patches), chosen[0].line)


def _is_small(edit: Edit) -> bool:
    """Whether a name gets an axis, or it is no axis at all."""
    name = edit.patches[0][2].removeprefix("(np.asarray(").removesuffix(")[..., None])")
    return edit.kind != "an axis missing" or name.isidentifier()


def without_twin(text: str) -> str:
    """A text in which twins look the same: x_a and x_b, v_a_dot and v_b_dot, arm1 and arm2, i and j."""
    return re.sub(
        r"(?<=[A-Za-z])_?(a|b|1|2|i|j)\b|_(a|b|1|2|i|j)(?=_)|\b(i|j|k|l)\b", "?", text
    )


__all__ = ["STAGES", "Code", "Edit", "edits_of", "patched", "without_twin"]
