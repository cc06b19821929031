"""Where the package is, where to write, and how its programs are called."""
import pathlib

_ABOVE = pathlib.Path(__file__).resolve().parents[2]
HAS_SOURCES = (_ABOVE / "config").is_dir()
# What is installed is PREFIX/lib/mocha_ugv/mocha_scripts, and its configuration PREFIX/share/mocha_ugv.
ROOT = str(_ABOVE if HAS_SOURCES else _ABOVE.parent / "share/mocha_ugv")
OUT = str(_ABOVE / "out" if HAS_SOURCES else pathlib.Path("out"))
CALLED = "scripts/" if HAS_SOURCES else "rosrun mocha_ugv "
