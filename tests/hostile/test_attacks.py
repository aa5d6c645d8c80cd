"""The attacks of the corpus are attacks: where nothing protects, each does the harm that it is there for."""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest
from hostile.corpus import BOXED
from hostile.surroundings import SECRET, SEED
from hostile.test_hostile import box, chosen  # noqa: F401

UNPROTECTED = Path(__file__).with_name("unprotected.py")
OUTER = ["bwrap", "--unshare-all", "--die-with-parent", "--new-session", "--ro-bind", "/",
         "/", "--dev", "/dev", "--proc", "/proc", "--size", "3000000000", "--tmpfs", "/tmp",
         "--bind"]  # fmt: skip


def harms_done(family):
    """What each attack did in a grader without protection, inside an outer box."""
    with tempfile.TemporaryDirectory(prefix="bare-") as name:
        root = Path(name).resolve()
        sources = {one.name: one.source for one in family}
        (root / "attacks").write_text(json.dumps(sources))
        environment = {"PATH": os.environ["PATH"], "GRADER_TOKEN": SECRET,
                       "PYTHONPATH": str(UNPROTECTED.parents[2])}  # fmt: skip
        command = [*OUTER, name, name, sys.executable, str(UNPROTECTED), name, SEED]
        subprocess.run(command, env=environment, check=True, timeout=600)
        return json.loads((root / "done").read_text())


@pytest.mark.long
@pytest.mark.parametrize("family", BOXED)
def test_each_does_its_harm_where_nothing_protects(box, family):  # noqa: F811
    verified = [one for one in chosen(BOXED[family]) if one.works_bare]
    done = harms_done(verified)
    assert {
        one.name: done[one.name] for one in verified if one.harm not in done[one.name]
    } == {}
    assert len(verified) >= 5
