"""What is wrong with what a user gave, in a line: scripts print it, and no traceback."""


class Complaint(Exception):
    pass


def in_a_line(error):
    """An exception, without what it says of the file twice."""
    return getattr(error, "strerror", None) or " ".join(str(error).split())
