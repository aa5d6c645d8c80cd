"""Nothing that is handed in raises a mark, harms a neighbour, stays behind or stops a batch."""

import os
import shutil
import subprocess
import sys

import pytest
from hostile.batch import faults_of, grade
from hostile.corpus import BOXED, OPEN

LIMIT = 2.0
#: With this in the environment every submission is graded; without, a family's sample
#: and this many others, spread over it evenly.
WHOLE = os.environ.get("COURSE_HOSTILE") == "whole"
MOST = 12
#: Honest answers may do a second's work on a machine that stalls.
PATIENT = 6.0
PROBE = ["bwrap", "--unshare-all", "--die-with-parent", "--ro-bind", "/", "/", "true"]


def why_no_box() -> str:
    """Why no box of the operating system can be had here; empty where one can."""
    if not sys.platform.startswith("linux") or shutil.which("bwrap") is None:
        return "bubblewrap is not there"
    tried = subprocess.run(PROBE, capture_output=True, text=True, timeout=60)
    return (
        "bubblewrap cannot run here: " + tried.stderr.strip()
        if tried.returncode
        else ""
    )


@pytest.fixture(scope="session")
def box():
    """Skips what only a box of the operating system can stop, where there is none."""
    if reason := why_no_box():
        pytest.skip(reason)


def faults_in(family, limit=LIMIT):
    long = sum(one.long for one in family)
    bound = 20 + 0.6 * len(family) + 1.2 * limit * long
    batch = grade(family, limit=limit, bound=bound)
    if not batch.whole:  # what is missing has one reason
        return batch.faults
    own = [fault for one in family for fault in faults_of(one, batch.rows[one.name])]
    return batch.faults + own


def none(faults):
    assert not faults, f"{len(faults)} faults:\n" + "\n".join(faults)


def chosen(family):
    """The submissions of a family that are graded where its sample was graded before."""
    rest = list(family) if WHOLE else [one for one in family if not one.sample]
    if WHOLE or len(rest) <= MOST:
        return rest
    return [rest[index * len(rest) // MOST] for index in range(MOST)]


def sample(families):
    return [one for family in families.values() for one in family if one.sample]


def test_the_corpus_is_large_and_its_names_differ():
    everything = [one for family in (OPEN | BOXED).values() for one in family]
    names = [one.name for one in everything]
    assert len(names) >= 120 and sorted(set(names)) == sorted(names)
    assert sum(one.expect == "full" for one in OPEN["honest"]) >= 34


@pytest.mark.slow
def test_a_sample_of_what_needs_no_box():
    none(faults_in(sample(OPEN), PATIENT))


@pytest.mark.slow
def test_a_sample_of_what_a_box_stops(box):
    none(faults_in(sample(BOXED)))


@pytest.mark.long
@pytest.mark.parametrize("family", OPEN)
def test_no_box_is_needed(family):
    assert (
        faults_in(chosen(OPEN[family]), PATIENT if family == "honest" else LIMIT) == []
    )


@pytest.mark.long
@pytest.mark.parametrize("family", BOXED)
def test_the_box_holds(box, family):
    none(faults_in(chosen(BOXED[family]), PATIENT if family == "memory" else LIMIT))
