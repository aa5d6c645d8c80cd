"""The process of a submission, started as a file by its path.

Its argument says where it finds everything else.
"""

import json
import sys


def main(told: str) -> None:
    """Find the course's files and the packages, and serve the grader."""
    where = json.loads(told)
    sys.path[:] = [where["root"], *where["path"]]
    from course.sandbox.serving import serve

    serve(where)


if __name__ == "__main__":
    main(sys.argv[1])
