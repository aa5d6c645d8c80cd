"""Nothing that is handed in raises a mark, harms a neighbour, stays behind or stops a batch."""

import pytest
from hostile.batch import faults_of, grade
from hostile.corpus import BOXED, OPEN, chosen

from course.grading.grade import REPAIR_SECONDS

LIMIT = 2.0
#: Honest answers may do a second's work on a machine that stalls.
PATIENT = 6.0


def faults_in(family, limit=LIMIT):
    long = sum(one.long for one in family)
    # Two at a time: a wrong answer that nothing explains is searched for its cause.
    each = 0.6 + REPAIR_SECONDS / 2
    bound = 20 + each * len(family) + 1.2 * limit * long
    batch = grade(family, limit=limit, bound=bound)
    if not batch.whole:  # what is missing has one reason
        return batch.faults
    own = [fault for one in family for fault in faults_of(one, batch.rows[one.name])]
    return batch.faults + own


def require_none(faults):
    assert not faults, f"{len(faults)} faults:\n" + "\n".join(faults)


def sample(families):
    return [one for family in families.values() for one in family if one.sample]


def test_the_corpus_is_large_and_its_names_differ():
    everything = [one for family in (OPEN | BOXED).values() for one in family]
    names = [one.name for one in everything]
    assert len(names) >= 120 and sorted(set(names)) == sorted(names)
    assert sum(one.expect == "full" for one in OPEN["honest"]) >= 34


@pytest.mark.long
def test_a_sample_of_what_needs_no_box():
    require_none(faults_in(sample(OPEN), PATIENT))


@pytest.mark.long
def test_a_sample_of_what_a_box_stops(box):
    require_none(faults_in(sample(BOXED)))


@pytest.mark.long
@pytest.mark.parametrize("family", OPEN)
def test_no_box_is_needed(family):
    limit = PATIENT if family == "honest" else LIMIT
    require_none(faults_in(chosen(OPEN[family]), limit))


@pytest.mark.long
@pytest.mark.parametrize("family", BOXED)
def test_the_box_holds(box, family):
    limit = PATIENT if family == "memory" else LIMIT
    require_none(faults_in(chosen(BOXED[family]), limit))
