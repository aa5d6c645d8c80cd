"""Start the workbook: ``python3 -m course`` (``py -m course`` on Windows).

Only the standard library is imported before ``environment.ensure`` has seen to
it that everything else is there. This file is readable by any Python, so that
one that is too old can say so in a sentence.
"""

import sys


def main(arguments=None):
    """Run the command line and return its exit code (the ``course`` script and ``-m
    course``).
    """
    leave_current_folder()
    if sys.version_info < (3, 6):
        sys.stderr.write(
            "Python 3.11 or newer is needed, this is %d.%d. Get it from https://www.python.org "
            "and start with: python3 -m course\n" % tuple(sys.version_info[:2])
        )
        return 2
    try:
        from course import environment

        arguments = list(sys.argv[1:] if arguments is None else arguments)
        try:
            environment.ensure(arguments, _make)
            from course import cli

            return cli.run(arguments)
        except environment.SetupError as problem:
            sys.stderr.write("%s\n" % problem)
            return 2
    except KeyboardInterrupt:
        return 130


def leave_current_folder():
    """Take the current folder out of the places that modules are imported from.

    ``python3 -m`` puts it first, and so does an empty entry in PYTHONPATH; a grader's
    holds the files of students, and none of these may be imported (``json.py``,
    ``numpy.py``). The folder that this package is in comes last instead: it may be the
    current one.
    """
    before = list(sys.path)
    # What is imported here must not be found there either.
    sys.path[:] = [entry for entry in before[1:] if entry not in ("", ".")]
    import os

    def real(path):
        return os.path.normcase(os.path.realpath(path))

    try:
        here = real(os.getcwd())
    except OSError:  # deleted meanwhile
        here = None
    own = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    kept = {real(os.path.dirname(os.__file__)), None}
    entries = [e for e in before if e and (here in kept or real(e) != here)]
    if real(own) not in [real(entry) for entry in entries]:
        entries.append(own)
    sys.path[:] = entries


def _make(root, extras):
    from course import installation  # newer Python than this file needs

    installation.make(root, extras)


if __name__ == "__main__":
    sys.exit(main())
