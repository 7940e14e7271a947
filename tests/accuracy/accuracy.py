"""The ratchet of the accuracy tests, and docs/extremes.md.

    check  LOG             what the tests observed (support/ratchet.hpp) against worst.csv: fails when an allowance is more
                           than 8 times the worst ever observed (or 2^-53), is not the recorded one, or a name is new or gone
    update LOG             records new names and allowances, and errors worse than before
    page   TESTS [--write] docs/extremes.md from extremes.toml, worst.csv and the tags of the test program: fails when the
                           page is another one, or writes it

worst.csv holds the worst that was ever seen, on any machine: it only grows. Whoever makes something more accurate deletes
its line, runs `update` and tightens the allowance.
"""
import argparse
import collections
import csv
import pathlib
import re
import subprocess
import sys
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SLACK = 8.0
ROUNDING = 2.0**-53  # what is met exactly today may be off by this on another machine
ROWS = [f"N{number:02}" for number in [*range(1, 23), *range(35, 53)]]

Record = collections.namedtuple("Record", "allowed observed")


def read(path):
    """{name: Record}, the worst of each name; complains of names with two allowances."""
    records, complaints = {}, []
    with open(path, encoding="utf-8", newline="") as file:
        for name, allowed, observed in csv.reader(file):
            if name == "name":
                continue
            old = records.get(name, Record(allowed, "0"))
            if float(old.allowed) != float(allowed):
                complaints.append(f"'{name}' has two allowances, {old.allowed} and {allowed}")
            records[name] = Record(allowed, max(old.observed, observed, key=float))
    return records, complaints


def check(log, worst):
    """What is wrong with a run."""
    complaints = []
    for name, now in log.items():
        allowed = float(now.allowed)
        if name not in worst:
            complaints.append(f"'{name}' is new: record it")
            continue
        ever = worst[name]
        if float(ever.allowed) != allowed:
            complaints.append(f"'{name}' allows {now.allowed}, recorded is {ever.allowed}")
        if allowed > SLACK * max(float(ever.observed), ROUNDING):
            complaints.append(f"'{name}' is slack: {now.allowed} allowed, never more than {ever.observed} observed")
    complaints += [f"'{name}' is recorded and was not observed" for name in worst if name not in log]
    return complaints


def merged(log, worst):
    """The records with those of a run: its names and allowances, the worse of both observations."""
    def worse(name):
        known = [log[name].observed] + ([worst[name].observed] if name in worst else [])
        return max(known, key=float)
    return {name: Record(log[name].allowed, worse(name)) for name in sorted(log)}


def write(records, path):
    lines = ["name,allowed,worst"]
    lines += [f"{name},{record.allowed},{float(record.observed):.4g}" for name, record in records.items()]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def tagged(program, tag):
    """[(file, test)] with this tag, by file."""
    listing = subprocess.run([program, f"[{tag}]", "--list-test-names-only", "--verbosity", "high"],
                             capture_output=True, text=True).stdout
    found = re.findall(r"^(.*)\t@.*?(tests/\S+):\d+$", listing, re.M)
    return sorted({(file, test) for test, file in found})


def section(row, text, tests, measured):
    lines = [f"### {row} {text['title']}", "", text["about"], ""]
    if "absent" in text:
        return lines + [f"Cannot occur: {text['absent']}", ""]
    lines += [f"Promise: {text['promise']}", ""]
    lines += [f"- {test} ([{pathlib.Path(file).stem}](../{file}))" for file, test in tests]
    if measured:
        lines += [""] + table({name.removeprefix(row + " "): record for name, record in measured.items()})
    return lines + [""]


def table(measured):
    lines = ["| measured | worst ever | allowed |", "|---|---|---|"]
    clean = lambda name: name.replace("|", "\\|")
    return lines + [f"| {clean(name)} | {float(r.observed):.2g} | {float(r.allowed):.2g} |" for name, r in measured.items()]


HEAD = """# The extremes

Where software of this kind breaks, what Strutt promises there, the tests that hold it and the worst that they have ever
seen. This page is generated from the tags of the tests and from what they measured
([tests/accuracy](../tests/accuracy)); a test fails when it is out of date. `strutt_tests "[N04]"` runs the tests of a
row.

A ratchet keeps the tolerances tight: an allowance may not be more than 8 times the worst error ever observed (or eight
roundings), and a measurement that was there once may not disappear.
"""

DEFECTS = """## Faults known from other programs

Each was reported of another library; these tests fail where it is present.
"""


def page(program, texts, worst):
    """The page, and what is wrong with what it is made from."""
    lines, complaints = [HEAD], []
    for row in ROWS:
        tests = tagged(program, row)
        if row not in texts:
            complaints.append(f"{row} has no text in extremes.toml")
            continue
        if bool(tests) == ("absent" in texts[row]):
            complaints.append(f"{row}: either tests with its tag, or the reason why it cannot occur")
        measured = {name: record for name, record in worst.items() if name.startswith(row + " ")}
        lines += section(row, texts[row], tests, measured)
    lines += [DEFECTS]
    lines += [f"- {test} ([{pathlib.Path(file).stem}](../{file}))" for file, test in tagged(program, "defect")]
    lines += ["", "## Other measurements", ""]
    lines += table({name: record for name, record in worst.items() if name.split(" ")[0] not in ROWS})
    return "\n".join(lines) + "\n", complaints


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("task", choices=["check", "update", "page"])
    parser.add_argument("input")
    parser.add_argument("--write", action="store_true")
    arguments = parser.parse_args()
    worst_file, page_file = HERE / "worst.csv", ROOT / "docs" / "extremes.md"
    worst, complaints = read(worst_file) if worst_file.exists() else ({}, [])
    if arguments.task == "page":
        texts = tomllib.loads((HERE / "extremes.toml").read_text(encoding="utf-8"))
        text, wrong = page(arguments.input, texts, worst)
        complaints += wrong
        if arguments.write:
            page_file.write_text(text, encoding="utf-8")
        elif not page_file.exists() or page_file.read_text(encoding="utf-8") != text:
            complaints.append(f"docs/extremes.md is out of date: {sys.argv[0]} page {arguments.input} --write")
    else:
        log, wrong = read(arguments.input)
        complaints += wrong
        if arguments.task == "update":
            write(merged(log, worst), worst_file)
        else:
            complaints += check(log, worst)
            worse = [name for name in log if name in worst and float(log[name].observed) > 1.001 * float(worst[name].observed)]
            for name in worse:
                print(f"worse than ever: '{name}' {log[name].observed}, before {worst[name].observed}")
            if complaints:
                print(f"to record this run: {sys.argv[0]} update {arguments.input}")
    for complaint in complaints:
        print(complaint, file=sys.stderr)
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
