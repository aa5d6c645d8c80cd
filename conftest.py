"""For every pytest run: no window, one BLAS thread, nothing kept in the user's home, also without `course test`."""

import atexit
import os
import shutil
import sys
import tempfile
from pathlib import Path

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(name, "1")  # before NumPy is imported
if "IPYTHONDIR" not in os.environ:
    scratch = tempfile.mkdtemp(prefix="course-pytest-")
    atexit.register(shutil.rmtree, scratch, ignore_errors=True)
    for name in (
        "JUPYTER_CONFIG_DIR",
        "JUPYTER_DATA_DIR",
        "JUPYTER_RUNTIME_DIR",
        "IPYTHONDIR",
    ):
        os.environ[name] = str(Path(scratch) / name.lower())
os.environ.setdefault(
    "MPLCONFIGDIR", str(Path(__file__).parent / ".pytest_cache" / "matplotlib")
)
sys.modules.setdefault(
    "rfc3987_syntax", None
)  # seconds at every import of nbformat, see course/cli.py
