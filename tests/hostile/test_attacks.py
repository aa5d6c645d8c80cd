"""The attacks of the corpus are attacks: where nothing protects, each does the harm that it is there for."""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest
from hostile.corpus import BOXED, chosen
from hostile.submission import attack
from hostile.surroundings import SECRET, SEED

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
def test_each_does_its_harm_where_nothing_protects(box, family):
    verified = [one for one in chosen(BOXED[family]) if one.works_bare]
    done = harms_done(verified)
    failed = {n.name: done[n.name] for n in verified if n.harm not in done[n.name]}
    assert failed == {}
    assert len(verified) >= 5


@pytest.mark.long
def test_an_innocent_answer_does_no_harm_there(box):
    done = harms_done([attack("innocent", "print(x)"), attack("raises", "1 / 0")])
    assert [set(harms) for harms in done.values()] == [{"said"}, {"said"}]
