"""Runs the programs of test/benchmarks."""
import json
import os
import subprocess

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def run(name, *arguments):
    """Builds benchmark_NAME if need be, runs it, and returns what it printed as JSON."""
    subprocess.run([os.path.join(ROOT, "scripts/build"), f"benchmark_{name}"], check=True)
    build = os.environ.get("MOCHA_BUILD", os.path.join(ROOT, "_build"))
    program = os.path.join(build, "devel/lib/mocha_ugv", f"benchmark_{name}")
    printed = subprocess.run([program, *map(str, arguments)], check=True, stdout=subprocess.PIPE, cwd=ROOT).stdout
    return json.loads(printed)


def write(result, path):
    if not path:
        return
    with open(path, "w") as file:
        json.dump(result, file, indent=2)
