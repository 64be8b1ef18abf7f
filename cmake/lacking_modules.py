"""Names those of the modules in its argument, "yaml, numpy", that this Python cannot import."""
import importlib
import sys


def lacking(name):
    try:
        importlib.import_module(name)
    except Exception:  # a module that is there and broken serves as little as none
        return True
    return False


print(", ".join(name for name in sys.argv[1].split(", ") if lacking(name)))
