"""What can be wrong with results."""


class ResultsError(Exception):
    """One sentence: place, what is wrong there, and what to do."""
