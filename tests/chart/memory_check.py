"""Checks that the memory of a chart does not grow with its rows.

    memory_check.py PROGRAM SQUARE MATHIEU

Runs PROGRAM chart on SQUARE (a closed form, so that it is quick), and by surrogate on MATHIEU, with few rows and with
ten times as many, for every kind of file, and compares the largest resident set sizes. The layers of the larger chart alone would take
LAYERS_MB more if they were kept.
"""

import os
import subprocess
import sys
import tempfile

import numpy

COLUMNS, ROWS, TIMES = 400, 400, 10
LAYERS = {"csv": "verdict,growth", "npy": "growth", "npz": "verdict,growth", "h5": "verdict,growth"}
LAYERS_MB = COLUMNS * ROWS * (TIMES - 1) * 8 / 2**20  # of one layer: 11 MB
HEADER_BYTES = 128  # of NPY 1.0
ALLOWED_MB = LAYERS_MB / 3  # arenas of the allocator differ by some pages from run to run


def axes(scene, rows):
    if "meissner" in scene:
        return ["--x", f"hill.mean=-1:5:{COLUMNS}", "--y", f"hill.amplitude=0:6:{rows}"]
    return ["--x", f"mathieu.delta=-1:5:{COLUMNS}", "--y", f"mathieu.epsilon=0:6:{rows}", "--method", "surrogate"]


def peak_megabytes(program, scene, rows, output):
    """The largest resident set of one run. That of this process at the fork counts, too, but is smaller."""
    arguments = [program, "chart", scene, *axes(scene, rows), "--layers", LAYERS[output.rsplit(".", 1)[1]], "--threads", "2", "--quiet", "-o", output]
    child = subprocess.Popen(arguments)
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode not in (0, 1):  # 1: some cells are unresolved
        sys.exit(f"{' '.join(arguments)}: exit code {child.returncode}")
    return usage.ru_maxrss / 2**10


def grows(program, scene):
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        for kind in LAYERS:
            output = os.path.join(folder, f"chart.{kind}")
            few = peak_megabytes(program, scene, ROWS, output)
            many = peak_megabytes(program, scene, TIMES * ROWS, output)
            failed = failed or many - few > ALLOWED_MB
            print(f"{kind}: {few:.1f} MB for {ROWS} rows, {many:.1f} MB for {TIMES * ROWS}")
            if kind == "npy":  # the last strip is lower than the others, the file as long as its header says
                shape = numpy.load(output).shape
                data = os.path.getsize(output) - HEADER_BYTES
                if shape != (TIMES * ROWS, COLUMNS) or data != 8 * TIMES * ROWS * COLUMNS:
                    sys.exit(f"{output}: shape {shape}, {data} bytes of data")
    return failed


def main(program, *scenes):
    failed = [grows(program, scene) for scene in scenes]
    sys.exit(1 if any(failed) else 0)


if __name__ == "__main__":
    main(*sys.argv[1:])
