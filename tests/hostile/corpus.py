"""All families of the corpus, and what each of them needs."""

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
