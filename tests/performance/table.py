"""The table of figures: stored as JSON, printed as Markdown, compared with an older one."""
import json
from dataclasses import dataclass, field

# More of these is worse. Ratios and counts describe, and are not judged.
JUDGED = {"time", "memory", "instructions"}
WORSE_BY = 0.10


@dataclass
class Comparison:
    """What became of the figures since another table."""
    worse: list = field(default_factory=list)      # (name, before, after), worst first
    better: list = field(default_factory=list)     # the same, best first
    missing: list = field(default_factory=list)    # names that are there no more
    added: list = field(default_factory=list)      # names that were not there
    remarks: list = field(default_factory=list)    # what was not compared, and why

    def text(self):
        lines = list(self.remarks)
        for title, rows in (("worse", self.worse), ("better", self.better)):
            lines += [f"{title}: {name}: {before:.4g} -> {after:.4g} ({after / before - 1:+.0%})"
                      for name, before, after in rows]
        lines += [f"no longer measured: {name}" for name in self.missing]
        if not self.worse:
            lines.append(f"no figure is more than {WORSE_BY:.0%} worse")
        return "\n".join(lines)


def compare(new, old):
    """Judges every figure that both tables have; more than 10 % worse is worse."""
    result = Comparison()
    before = {row["name"]: row for row in old["figures"]}
    after = {row["name"]: row for row in new["figures"]}
    result.missing = [name for name in before if name not in after]
    result.added = [name for name in after if name not in before]
    judged = set(JUDGED)
    here, there = new["about"]["machine"]["model"], old["about"]["machine"]["model"]
    if here != there:
        judged.discard("time")
        result.remarks.append(f"times are not compared: this machine is '{here}', the stored table's "
                              f"'{there}'")
    for key in ("compiler", "flags"):
        if new["about"]["build"][key] != old["about"]["build"][key]:
            result.remarks.append(f"{key}: '{old['about']['build'][key]}' then, "
                                  f"'{new['about']['build'][key]}' now")
    for name, row in after.items():
        if name not in before or row["kind"] not in judged or not before[name]["value"]:
            continue
        ratio = row["value"] / before[name]["value"]
        if ratio > 1 + WORSE_BY:
            result.worse.append((name, before[name]["value"], row["value"]))
        elif ratio < 1 - WORSE_BY:
            result.better.append((name, before[name]["value"], row["value"]))
    result.worse.sort(key=lambda entry: -entry[2] / entry[1])
    result.better.sort(key=lambda entry: entry[2] / entry[1])
    return result


def about_text(table):
    machine, build = table["about"]["machine"], table["about"]["build"]
    return "\n".join([
        f"- machine: {machine['model']}, {machine['cores']} cores, cache {machine['cache']}, "
        f"{machine['memory_gib']} GiB, Linux {machine['kernel']}",
        f"- program: mpm_par {build['version']}, git {build['git']}",
        f"- compiler: {build['compiler']}, {build['build']}, vectors {build['vectors']}, "
        f"`{build['flags']}`",
        f"- load of the machine before and after: {table['about']['load'][0]:.2f} and "
        f"{table['about']['load'][1]:.2f}"])


def value_text(value):
    if value == int(value) and abs(value) < 1e15:
        return str(int(value))
    return f"{value:.3g}" if abs(value) < 100 else f"{value:.0f}"


def spread_text(row):
    return f"{row['spread']:.0%}" if row["samples"] > 1 else "-"


def markdown(rows):
    lines = ["| figure | median | unit | +- | samples |", "|---|---|---|---|---|"]
    lines += [f"| {row['name']} | {value_text(row['value'])} | {row['unit']} | "
              f"{spread_text(row)} | {row['samples']} |"
              for row in rows]
    return "\n".join(lines)


def catalogue(rows, prefix):
    """Figures named PREFIX/DIMENSION/WHAT/SHAPE/SCHEME/MATERIAL as a table of what over schemes."""
    found = {}
    for row in rows:
        parts = row["name"].split("/")
        if parts[0] == prefix and len(parts) == 6:
            found.setdefault((parts[1], parts[2], parts[3], parts[5]), {})[parts[4]] = row["value"]
    if not found:
        return ""
    schemes = ["flip", "pic", "apic", "tpic"]
    lines = ["| | | shape function | material | " + " | ".join(schemes) + " |",
             "|---|---|---|---|" + "---|" * len(schemes)]
    for key, values in found.items():
        cells = [value_text(values[scheme]) if scheme in values else "-" for scheme in schemes]
        lines.append("| " + " | ".join([*key, *cells]) + " |")
    return "\n".join(lines)


def read(path):
    return json.loads(path.read_text())


def write(table, path):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(table, indent=1) + "\n")
