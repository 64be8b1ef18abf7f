"""The machine that times belong to."""
import os
import pathlib
import platform
import re


def machine():
    """Model of processor, cores, memory and kernel; no name of the machine itself."""
    def first(path, pattern):
        try:
            found = re.search(pattern, pathlib.Path(path).read_text(), re.MULTILINE)
        except OSError:
            found = None
        return found[1] if found else "unknown"

    memory = first("/proc/meminfo", r"^MemTotal:\s*(\d+)")
    return {"processor": first("/proc/cpuinfo", r"^model name\s*: (.*)$"),
            "cores": os.cpu_count(),
            "memory_gib": round(int(memory) / 2 ** 20, 1) if memory.isdigit() else None,
            "kernel": platform.release(), "load": round(os.getloadavg()[0], 2)}
