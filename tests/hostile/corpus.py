"""All families of the corpus, and what each of them needs."""

import os

from hostile import (
    against_grader,
    broken_files,
    cell_tricks,
    exits,
    floods,
    honest,
    loops,
    lying_objects,
    memory,
    names,
    network,
    patched,
    processes,
    reading,
    reference,
    writing,
)

OPEN = {
    "honest": honest.FAMILY,
    "cell tricks": cell_tricks.FAMILY,
    "patched libraries": patched.FAMILY,
    "lying objects": lying_objects.FAMILY,
    "reference": reference.FAMILY,
    "exits": exits.FAMILY,
    "loops": loops.FAMILY,
    "floods": floods.FAMILY,
    "broken files": broken_files.FAMILY,
    "names": names.FAMILY,
}
#: What only a box of the operating system stops.
BOXED = {
    "writing": writing.FAMILY,
    "reading": reading.FAMILY,
    "processes": processes.FAMILY,
    "network": network.FAMILY,
    "memory": memory.FAMILY,
    "against the grader": against_grader.FAMILY,
}

#: With this in the environment every submission is graded; without, a family's sample
#: and this many others, spread over it evenly.
WHOLE = os.environ.get("COURSE_HOSTILE") == "whole"
MOST = 12


def chosen(family):
    """The submissions of a family that are graded where its sample was graded before."""
    rest = list(family) if WHOLE else [one for one in family if not one.sample]
    if WHOLE or len(rest) <= MOST:
        return rest
    return [rest[index * len(rest) // MOST] for index in range(MOST)]
