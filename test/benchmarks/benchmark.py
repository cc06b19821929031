"""Runs the programs of test/benchmarks."""
import json
import os
import subprocess
import sys

from mocha_scripts.complaint import Complaint

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def build(name):
    """The path of benchmark_NAME, built if need be."""
    subprocess.run([os.path.join(ROOT, "scripts/build"), f"benchmark_{name}"], check=True)
    folder = os.environ.get("MOCHA_BUILD", os.path.join(ROOT, "_build"))
    return os.path.join(folder, "devel/lib/mocha_ugv", f"benchmark_{name}")


def call(program, *arguments):
    """What the program printed as JSON."""
    ran = subprocess.run([program, *map(str, arguments)], check=False, stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=ROOT, text=True)
    sys.stderr.write(ran.stderr if ran.returncode == 0 else "")
    if ran.returncode != 0:
        words = ran.stderr.strip().splitlines()
        raise Complaint(words[-1] if words else f"{os.path.basename(program)} ended with {ran.returncode}")
    return json.loads(ran.stdout)


def run(name, *arguments):
    """Builds benchmark_NAME if need be, runs it, and returns what it printed as JSON."""
    return call(build(name), *arguments)


def write(result, path):
    if not path:
        return
    with open(path, "w") as file:
        json.dump(result, file, indent=2)
