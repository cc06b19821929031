#!/usr/bin/python3
"""The fleet panel in rviz, used by the mouse of an X server that nobody sees, with two robots in simulation.

    rviz_panel_test.py PROGRAM     (built of test/rviz_panel/panel_clicks.cpp)"""
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
from mocha_scripts.session import Session  # noqa: E402

WORLD = str(ROOT / "test/worlds/room_for_two.yaml")
SCREEN = "1640x900x24"


def start_screen():
    """An X server of its own: the process, and its display."""
    read, write = os.pipe()
    screen = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", SCREEN, "-nolisten", "tcp"], pass_fds=[write], stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as pipe:
        return screen, ":" + pipe.readline().strip()


def main(program):
    screen, display = start_screen()
    try:
        with tempfile.TemporaryDirectory() as out:
            os.environ["ROS_HOME"] = out
            view = os.path.join(out, "fleet.rviz")
            subprocess.run([ROOT / "scripts/fleet_view", "--world", WORLD, "--write", view], check=True)
            with Session("fleet_sim.launch", {"world": WORLD, "rate": 3.0, "send_goals": "false"}, os.path.join(out, "fleet.log")) as session:
                if not session.wait_for_launch():
                    print(session.last_words())
                    return 1
                environment = {**os.environ, "DISPLAY": display, "LIBGL_ALWAYS_SOFTWARE": "1", "QT_X11_NO_MITSHM": "1", "XDG_CONFIG_HOME": out, "HOME": out}
                return subprocess.run([program, view], env=environment, timeout=400.0, check=False).returncode
    finally:
        screen.terminate()
        screen.wait()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
