"""Says what a test of the package lacks, and ends it, before anything else is imported."""
import importlib
import sys


def modules(*names):
    for name in names:
        try:
            importlib.import_module(name)
        except ImportError:
            print(f"skipped: {sys.executable} has no {name} (sh jobscripts/install_packages.sh)")
            sys.exit(0)
