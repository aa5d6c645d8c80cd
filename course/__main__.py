"""Start the workbook: ``python3 -m course`` (``py -m course`` on Windows).

Only the standard library is imported before ``environment.ensure`` has seen to
it that everything else is there. This file is readable by any Python, so that
one that is too old can say so in a sentence.
"""

import sys


def main(arguments=None):
    """Run the command line and return its exit code (the ``course`` script and ``-m course``)."""
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


def _make(root, extras):
    from course import installation  # newer Python than this file needs

    installation.make(root, extras)


if __name__ == "__main__":
    sys.exit(main())
