"""The stage's program for the browser: linted, and its arithmetic tested by Node's own runner.

Needs Node, and what ``npm install --prefix tests/workbook/stage/js`` brings.
"""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
TESTS = "tests/workbook/stage/js"
PROGRAM = "course/workbook/stage/js"

pytestmark = pytest.mark.node


def run(*command):
    return subprocess.run(
        command, cwd=ROOT, capture_output=True, text=True, timeout=300
    )


def test_its_arithmetic_is_right():
    files = sorted(str(p.relative_to(ROOT)) for p in (ROOT / TESTS).glob("*.test.js"))
    done = run("node", "--test", *files)
    assert done.returncode == 0, done.stdout + done.stderr
    counted = re.search(r"^# pass (\d+)$", done.stdout, re.MULTILINE)
    assert counted and int(counted[1]) >= 20


def test_it_is_linted():
    linter = f"{TESTS}/node_modules/.bin/eslint"
    done = run(linter, "-c", f"{TESTS}/eslint.config.js", "--max-warnings", "0", PROGRAM, TESTS)  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
