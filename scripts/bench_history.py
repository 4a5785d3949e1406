"""Measurements of scripts/bench over time: a file of JSON lines, each with the commit, the machine, what was measured and its
rows. A new one is held against the last of the same machine and the same measurement."""

import datetime
import json
import platform
import subprocess

# By how much a figure may grow before it is named, as a share of what it was.
ALLOWED = {"cpu_ms_mean": 0.10, "peak_megabytes": 0.10, "ape_rmse_m": 0.05, "failed": 0.0}


def machine():
    with open("/proc/cpuinfo") as info:
        models = [line.partition(":")[2].strip() for line in info if line.startswith("model name")]
    return f"{models[0] if models else platform.machine()}, {len(models)} processors"


def commit(root):
    ended = subprocess.run(["git", "-C", root, "describe", "--always", "--dirty"], capture_output=True, text=True, check=False)
    return ended.stdout.strip() or "unknown"


def entry(rows, measurement, root):
    """A line of the file; `measurement` names what was asked for, so that like is held against like."""
    kept = [{key: row.get(key) for key in ("source", "method", *ALLOWED)} for row in rows]
    return {"commit": commit(root), "date": datetime.date.today().isoformat(), "machine": machine(),
            "measurement": measurement, "rows": kept}


def last_like(new, file):
    """The last line of the same machine and measurement, None where there is none."""
    lines = [json.loads(line) for line in file.read_text().splitlines()] if file.exists() else []
    alike = [line for line in lines if all(line[key] == new[key] for key in ("machine", "measurement"))]
    return alike[-1] if alike else None


def growth(new, old):
    """(source, method, figure, before, now, whether it grew beyond what is allowed) of every figure that both have."""
    before = {(row["source"], row["method"]): row for row in old["rows"]}
    for row in new["rows"]:
        other = before.get((row["source"], row["method"]), {})
        for figure, share in ALLOWED.items():
            was, now = other.get(figure), row.get(figure)
            if was is not None and now is not None:
                yield row["source"], row["method"], figure, was, now, now > was * (1 + share)


def add(new, file):
    """Appends `new`, prints what has changed since the last line like it, and returns whether something has become worse."""
    old = last_like(new, file)
    file.parent.mkdir(parents=True, exist_ok=True)
    with file.open("a") as out:
        out.write(json.dumps(new) + "\n")
    if old is None:
        print(f"{file}: the first measurement of its kind on this machine")
        return False
    print(f"since {old['commit']} of {old['date']}:")
    changes = list(growth(new, old))
    for source, method, figure, was, now, worse in changes:
        print(f"  {source} {method} {figure}: {was:.4g} -> {now:.4g}{'  WORSE' if worse else ''}")
    return any(worse for *_, worse in changes)
