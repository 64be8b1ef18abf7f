"""What a person sees of a command in a terminal."""
import contextlib
import os
import pty
import subprocess


def on_terminal(command, folder):
    """(status, what is shown), where all output of the command in the folder is that of one terminal."""
    ours, theirs = pty.openpty()
    with subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=theirs, stderr=theirs) as run:
        os.close(theirs)
        shown = b""
        with contextlib.suppress(OSError):  # which says that nobody writes any more
            while piece := os.read(ours, 4096):
                shown += piece
    os.close(ours)
    return run.returncode, shown.decode().replace("\r\n", "\n")
