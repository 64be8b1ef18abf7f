"""Figures of the compiled benchmarks: passes, laws, sort, whole steps, halo sums."""
import json
import re
import tempfile
from pathlib import Path

from measuring import figure, run


def google_benchmark(build, program, pattern, repeat, ranks=1):
    """Name -> counter -> samples."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out.json"
        run([build.program(program), f"--benchmark_out={out}", "--benchmark_out_format=json",
             f"--benchmark_repetitions={repeat}", f"--benchmark_filter={pattern}"], ranks)
        rows = json.loads(out.read_text())["benchmarks"]
    samples = {}
    for row in rows:
        if row["run_type"] != "iteration":
            continue
        name = re.sub(r"/(iterations:\d+|repeats:\d+|real_time)", "", row["name"])
        for counter in ("ns_per_particle", "ns_per_node"):
            if counter in row:
                samples.setdefault(name, {}).setdefault(counter, []).append(row[counter])
    return samples


def figures(samples, prefix):
    unit = {"ns_per_particle": "ns/particle", "ns_per_node": "ns/shared node"}
    return [figure(f"{prefix}/{name}", values, unit[counter])
            for name, counters in samples.items() for counter, values in counters.items()]


def measure_kernels(build, repeat, quick):
    pattern = "2d/(law|sort|.*gimp/flip)" if quick else "."
    return figures(google_benchmark(build, "kernel_benchmark", pattern, repeat), "kernel")


def measure_steps(build, repeat, quick):
    pattern = "2d/step_musl/gimp/flip" if quick else "."
    return figures(google_benchmark(build, "step_benchmark", pattern, repeat), "step")


def measure_halo(build, repeat, _quick):
    return figures(google_benchmark(build, "halo_benchmark", ".", repeat, ranks=2), "two ranks")
