"""Runs of cases with seeds, for the scripts beside it: a run that is there is not run again, one that was cut off is resumed."""
import csv
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


def read_rows(path):
    """Rows of a CSV file by the names of its columns; lines that begin with # are comments."""
    with open(path, newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def folder_of(out, name, seed):
    return pathlib.Path(out) / f"{name}_seed{seed}"


def run(case, seed, options, name=None, changes=()):
    """Runs or resumes one case; gives what its summary says. changes: key=value, beside options.set."""
    out = folder_of(options.out, name or pathlib.Path(case).stem, seed)
    summary = out / "summary.json"
    if not summary.exists():
        if out.exists():
            command = ["resume", str(out), "--threads", str(options.threads)]
        else:
            command = ["run", str(case), "--seed", str(seed), "--threads", str(options.threads), "--out", str(out)]
            command += [word for change in [*options.set, *changes] for word in ("--set", change)]
        done = subprocess.run([options.packbed, *command, "--quiet"], capture_output=True, text=True)
        if done.returncode not in (0, 1):  # 1: the audit failed, and the table says so
            sys.exit(f"{case}, seed {seed}:\n{done.stderr}")
    return case, seed, json.loads(summary.read_text())


def add_options(parser, out, side_by_side=2):
    parser.add_argument("--set", action="append", default=[], help="key=value, for all")
    parser.add_argument("--threads", type=int, default=1, help="of each run")
    parser.add_argument("--side-by-side", type=int, default=side_by_side, help="runs at a time")
    parser.add_argument("--out", default=out)
    parser.add_argument("--packbed", default=str(ROOT / "tools" / "packbed"), help="program to run")
