"""The ways a study can fail. The exit status of each is that of mpm_par."""

DONE = 0
BAD_INPUT = 2
NUMERICAL_FAILURE = 3
FILE_FAILURE = 4
INTERRUPTED = 130

# Statuses that the same input gives again: such a run is done, though it failed.
REPEATABLE = (DONE, BAD_INPUT, NUMERICAL_FAILURE)


class InputError(Exception):
    """The user's input is wrong. One line: place, what is wrong (and why), remedy."""


class NoResult(Exception):
    """Not one run gave a figure."""
