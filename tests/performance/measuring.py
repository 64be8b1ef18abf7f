"""The machine, the program under test, and runs of it: pinned, timed, with their peak memory."""
import os
import platform
import re
import shutil
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]

# What Open MPI needs to run as root, and one thread per rank (jobscripts/environment.sh).
MPI_ENVIRONMENT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                   "OMPI_MCA_rmaps_base_oversubscribe": "1",
                   "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe",
                   "OMPI_MCA_mpi_yield_when_idle": "1", "OMPI_MCA_btl": "self,vader",
                   "OMPI_MCA_btl_vader_single_copy_mechanism": "none", "OMP_NUM_THREADS": "1"}


class RunFailed(RuntimeError):
    pass


def machine():
    """What figures of another machine may not be compared with, and what may explain them."""
    cpu = Path("/proc/cpuinfo").read_text()
    fields = dict(re.findall(r"^(model name|cpu family|model|stepping|cache size)\s*: (.*)$", cpu,
                             re.MULTILINE))
    memory = re.search(r"MemTotal:\s*(\d+)", Path("/proc/meminfo").read_text())[1]
    return {"model": "{model name}, family {cpu family} model {model} stepping {stepping}"
                     .format_map(fields),
            "cores": os.cpu_count(), "cache": fields.get("cache size", "unknown"),
            "memory_gib": round(int(memory) / 2**20, 1), "kernel": platform.release()}


def load():
    """Processes that wanted to run in the last minute: near 0 on a quiet machine."""
    return os.getloadavg()[0]


class Build:
    """A build folder with mpm_par and, where they were asked for, the benchmarks."""

    def __init__(self, folder):
        self.folder = Path(folder).resolve()
        self.mpm_par = self.program("mpm_par")

    def program(self, name):
        program = self.folder / name
        if not program.exists():
            raise RunFailed(f"{program} is not there. Build with -DMPM_BUILD_BENCHMARKS=ON.")
        return program

    def about(self):
        """Version, git hash, compiler and vector unit from --version, flags from the cache."""
        lines = subprocess.run([self.mpm_par, "--version"], check=True, capture_output=True,
                               text=True, env=environment()).stdout.splitlines()
        about = dict(line.split(maxsplit=1) for line in lines if " " in line)
        cache = (self.folder / "CMakeCache.txt").read_text()
        find = dict(re.findall(r"^(CMAKE_BUILD_TYPE|CMAKE_CXX_FLAGS|MPM_VECTOR):\w+=(.*)$", cache,
                               re.MULTILINE))
        flags = subprocess.run(["grep", "-m1", "-o", '"command": .*',
                                str(self.folder / "compile_commands.json")],
                               capture_output=True, text=True).stdout
        options = [word for word in flags.split() if re.match(r"-(O|march|m|f)", word)]
        return {"version": about["mpm_par"], "git": about["git"], "compiler": about["compiler"],
                "build": find.get("CMAKE_BUILD_TYPE", ""), "vectors": about.get("vectors", ""),
                "flags": " ".join([*options, find.get("CMAKE_CXX_FLAGS", "")]).strip()}


def environment():
    return {**os.environ, **MPI_ENVIRONMENT}


def pinned(command, ranks, oversubscribed=False, core=None):
    """On this core, or on cores of its own, the last ones (the first serves interrupts); before
    others where the account may ask for it."""
    cores = os.cpu_count()
    words = ["nice", "-n", "-10"] if os.geteuid() == 0 else []
    if oversubscribed:
        binding = ["--bind-to", "none"]
    else:
        chosen = ",".join(map(str, range(max(0, cores - ranks), cores) if core is None else [core]))
        words += ["taskset", "-c", chosen] if shutil.which("taskset") else []
        binding = ["--bind-to", "core"] if ranks > 1 else ["--bind-to", "none"]
    if ranks > 1:
        words += ["mpirun", "-n", str(ranks), *binding]
    return words + [str(word) for word in command]


def run(command, ranks=1, oversubscribed=False, core=None):
    """Runs to the end; returns seconds and the peak resident memory of its largest process, bytes.
    """
    with tempfile.TemporaryFile() as output:
        start = time.monotonic()
        process = subprocess.Popen(pinned(command, ranks, oversubscribed, core), env=environment(),
                                   stdin=subprocess.DEVNULL, stdout=output,
                                   stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        seconds = time.monotonic() - start
        if process.returncode != 0:
            output.seek(0)
            raise RunFailed(" ".join(map(str, command)) + "\n" +
                            output.read().decode(errors="replace")[-3000:])
    return seconds, 1024 * usage.ru_maxrss


# valgrind 3.19 does not know `vmovq` from register to register as a store, which the assembler takes
# where that is a byte shorter. As a load it is the same instruction.
ASSEMBLER = r"""#!/bin/sh
for file; do
  case "$file" in
    *.s) sed -i -E 's/\tvmovq\t(%xmm[0-9]+, %xmm)/\t{load} vmovq\t\1/' "$file" ;;
  esac
done
exec as "$@"
"""


def avx2_build(build):
    """The same sources for AVX2: what valgrind can follow, and the same instructions anywhere."""
    folder = build.folder / "performance" / "avx2"
    assembler = folder / "assembler" / "as"
    assembler.parent.mkdir(parents=True, exist_ok=True)
    assembler.write_text(ASSEMBLER)
    assembler.chmod(0o755)
    for command in (["cmake", "-S", PROJECT, "-B", folder, "-DCMAKE_BUILD_TYPE=Release",
                     "-DMPM_VECTOR=avx2", "-DMPM_BUILD_TESTS=OFF",
                     f"-DCMAKE_CXX_FLAGS=-B{assembler.parent}"],
                    ["cmake", "--build", folder, "--target", "mpm_par", "-j", str(os.cpu_count())]):
        built = subprocess.run(list(map(str, command)), capture_output=True, text=True)
        if built.returncode != 0:
            raise RunFailed(" ".join(map(str, command)) + "\n" + built.stderr[-3000:])
    return Build(folder)


def instructions(command):
    """Of one run in one process, simulated, fifty times slower: for small cases. None without
    valgrind."""
    if not shutil.which("valgrind"):
        return None
    counted = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null",
                              *map(str, command)],
                             env=environment(), capture_output=True, text=True)
    if counted.returncode != 0:
        raise RunFailed(" ".join(map(str, command)) + "\n" + counted.stderr[-3000:])
    return int(re.search(r"Collected : (\d+)", counted.stderr)[1])


def figure(name, samples, unit, kind="time", **more):
    """A row of the table: the median of the samples, and half their range over it."""
    middle = statistics.median(samples)
    spread = (max(samples) - min(samples)) / 2 / middle if middle else 0.0
    return {"name": name, "value": middle, "unit": unit, "spread": spread,
            "samples": len(samples), "kind": kind, **more}
