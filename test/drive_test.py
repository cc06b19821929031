#!/usr/bin/python3
"""Drives the robots of a world through the whole stack, as scripts/demo does: all arrive, without contact, and the centres of no two
robots ever come closer than the paper's safety distance.

    drive_test.py WORLD [OPTION ...]     (a file in config/worlds or test/worlds, without .yaml, and options of scripts/demo)"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SAFETY_DISTANCE_M = 0.8  # of the paper's Table III: two radii and 0.2 m
LIMIT_S = 240.0  # simulated


def file_of(world):
    path, = [path for folder in ("config/worlds", "test/worlds") if (path := ROOT / folder / f"{world}.yaml").exists()]
    return str(path)


def faults(results):
    for robot in results["robots"]:
        if not robot["reached"]:
            yield f"{robot['name']} did not arrive"
        if robot["contacts"]:
            yield f"{robot['name']} touched something"
    if not results["robots"]:
        yield "no robot drove"
    elif results["min_separation_m"] is not None and results["min_separation_m"] < SAFETY_DISTANCE_M:
        yield f"two robots came as close as {results['min_separation_m']:.3f} m"


def main(world, options):
    with tempfile.TemporaryDirectory() as out:
        table = os.path.join(out, "table.json")
        environment = dict(os.environ, ROS_HOME=out, PYTHONPATH=f"{ROOT}/scripts:{os.environ.get('PYTHONPATH', '')}")
        demo = subprocess.run(["/usr/bin/python3", "-m", "mocha_scripts.demo", "--headless", "--rate", "0", "--no-plots",
                               "--world", file_of(world), "--limit", str(LIMIT_S), "--json", table, "--out", out, *options],
                              env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=600.0)
        print(demo.stdout)
        with open(table) as file:
            found = list(faults(json.load(file)))
        for fault in found:
            print(f"drive_test: {world}: {fault}")
        return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
