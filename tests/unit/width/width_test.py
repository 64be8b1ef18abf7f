"""The same block in every vector width that this processor has: equal to rounding.

    width_test.py baseline=PROGRAM avx2=PROGRAM avx512=PROGRAM
"""
import re
import subprocess
import sys

# What the compiler may use for a width, in the words of /proc/cpuinfo.
NEEDS = {"baseline": set(),
         "avx2": {"avx2", "fma", "bmi1", "bmi2", "f16c", "movbe", "abm"},
         "avx512": {"avx2", "fma", "bmi1", "bmi2", "f16c", "movbe", "abm", "avx512f", "avx512bw",
                    "avx512cd", "avx512dq", "avx512vl"}}
LANES = {"baseline": 2, "avx2": 4, "avx512": 8}

# Widths sum in another order, and with or without fused multiply-add: 1e-16 in each operation of 100
# steps. Stresses follow differences of velocities, so they carry most. Measured, relative to the
# largest value: positions 6e-16, stresses 3e-14, energies 1e-15. A lane that takes another one's
# value is off by 1e-3 and more.
TOLERANCE = {"position": 1e-14, "stress": 1e-12, "energy": 1e-13}


def features():
    with open("/proc/cpuinfo") as cpu:
        return set(re.search(r"^flags\s*: (.*)$", cpu.read(), re.MULTILINE)[1].split())


def numbers(text):
    """Case -> kind -> list of values."""
    cases = {}
    for line in text.splitlines()[1:]:
        name, kind, *values = line.split()
        values = [float(value) for value in values]
        case = cases.setdefault(name, {"position": [], "stress": [], "energy": []})
        if kind == "particle":
            case["position"] += values[:2]
            case["stress"] += values[2:]
        else:
            case["energy"] += values
    return cases


def differences(reference, other):
    """Largest difference of each case and kind, relative to the largest value."""
    assert reference.keys() == other.keys()
    for case, kinds in reference.items():
        for kind, values in kinds.items():
            assert len(values) == len(other[case][kind]) > 0
            scale = max(map(abs, values))
            yield case, kind, max(abs(a - b) for a, b in zip(values, other[case][kind])) / scale


def main():
    programs = dict(argument.split("=", 1) for argument in sys.argv[1:])
    present = features()
    results = {}
    for width, program in programs.items():
        missing = NEEDS[width] - present
        if missing:
            print(f"left out: {width}, this processor has no {' '.join(sorted(missing))}")
            continue
        text = subprocess.run([program], check=True, capture_output=True, text=True).stdout
        assert text.startswith(f"width {LANES[width]}\n"), f"{width} has {text.splitlines()[0]}"
        results[width] = numbers(text)
    if len(results) < 2:
        print("skipped: this processor has one vector width only")
        return 0
    faults = 0
    for width in list(results)[1:]:
        worst = {}
        for case, kind, difference in differences(results["baseline"], results[width]):
            worst[kind] = max(worst.get(kind, 0), difference)
            if not difference <= TOLERANCE[kind]:
                print(f"{width}, {case}: {kind} differs from baseline by {difference:.2g} of the "
                      f"largest (at most {TOLERANCE[kind]:g})")
                faults += 1
        print(width, {kind: f"{value:.1e}" for kind, value in worst.items()})
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
