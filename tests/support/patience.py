"""How long a test waits before it takes a program to hang."""
import os


def seconds(limit):
    """`limit`, many times as long where sanitizers slow the program down."""
    return limit * float(os.environ.get("MPM_PATIENCE", "1"))
