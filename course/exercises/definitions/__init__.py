"""One module a lesson, each with a `LESSON`."""
