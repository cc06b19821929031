"""Lidar logs in CARMEN's format."""
import gzip
import os
import pathlib
import tempfile

from benchmarks import benchmark
from mocha_scripts.complaint import Complaint


class NoLogs(Complaint):
    """A folder without logs."""


def add_argument(parser, required_words):
    parser.add_argument("--logs", metavar="DIR", nargs="?", const=given_folder(),
                        help=f"{required_words} *.log or *.log.gz in there (without DIR: those of MOCHA_DATA, or ../shared/data)")


def given_folder():
    return os.path.join(os.environ.get("MOCHA_DATA", os.path.join(benchmark.ROOT, "../shared/data")), "carmen")


def name_of(path):
    return path.name.split(".log")[0].removesuffix("-corrected")


def each(folder):
    """(name, path of the log, unpacked) of each log in a folder."""
    logs = sorted(path for path in pathlib.Path(folder).glob("*") if path.name.endswith((".log", ".log.gz")))
    if not logs:
        raise NoLogs(f"no lidar logs in {folder}")
    for path in logs:
        with tempfile.NamedTemporaryFile() as log:
            log.write(gzip.decompress(path.read_bytes()) if path.suffix == ".gz" else path.read_bytes())
            log.flush()
            yield name_of(path), log.name
