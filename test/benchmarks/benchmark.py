"""Runs the programs of test/benchmarks."""
import json
import os
import subprocess

from mocha_scripts.complaint import Complaint

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def build(name):
    """The path of benchmark_NAME, built if need be."""
    subprocess.run([os.path.join(ROOT, "scripts/build"), "--test", f"benchmark_{name}"], check=True)
    folder = os.environ.get("MOCHA_BUILD", os.path.join(ROOT, "_build"))
    return os.path.join(folder, "devel/lib/mocha_ugv", f"benchmark_{name}")


def call(program, *arguments):
    """What the program printed as JSON. What it says besides, its progress or what is wrong, is seen at once."""
    ran = subprocess.run([program, *map(str, arguments)], check=False, stdout=subprocess.PIPE, cwd=ROOT)
    if ran.returncode != 0:
        raise Complaint(f"{os.path.basename(program)} ended with {ran.returncode}")
    return json.loads(ran.stdout)


def run(name, *arguments):
    """Builds benchmark_NAME if need be, runs it, and returns what it printed as JSON."""
    return call(build(name), *arguments)


def write(result, path):
    if not path:
        return
    with open(path, "w") as file:
        json.dump(result, file, indent=2)
