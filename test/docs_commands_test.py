#!/usr/bin/python3
"""Runs the commands of README.md and docs/: every line in a box, and every call of ROS in the text, as a reader would, in a home folder of its
own. What is put in their place to do so, and what is not run and why, is listed below; a command that is neither run nor listed is a fault. That
scripts/ in the text know their options, test/docs_test.py checks by their --help."""
import getpass
import math
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import xmlrpc.client

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "test"), str(ROOT / "test/rostest"), str(ROOT / "scripts")]
import docs_test  # noqa: E402
from mocha_scripts.session import free_port  # noqa: E402
from waiting import wait_until  # noqa: E402

SPOKEN = re.compile(r"(\w+=\S+ )?(rosrun|roslaunch|rostopic|rosservice|rosparam) \S+ \S+")

NOT_RUN = {
    "scripts/test": "runs this test",
    "scripts/test -R test_planning": "runs what runs beside this test",
    "scripts/test --sanitize": "builds for half an hour",
    "scripts/test --sanitize thread": "builds for half an hour",
    "scripts/build_arm64": "loads and builds for half an hour",
    "scripts/build_arm64 --test": "loads and builds for half an hour",
    "scripts/build_arm64 --test test_fleet": "loads and builds for half an hour",
    "qemu-aarch64-static -L ~/.cache/mocha_ugv/bookworm_arm64_sysroot build/arm64/devel/lib/mocha_ugv/base_emulator": "needs what scripts/build_arm64 makes",
    "scripts/package": "loads and builds for a quarter of an hour, and tries what it has made itself",
    "scripts/package --arm64": "the same",
    "scripts/package --on trixie": "the same",
    "sudo apt install ./mocha-ugv_*.deb ./mocha-ugv-common_*.deb ./mocha-ugv-tools_*.deb ./mocha-ugv-rviz_*.deb": "needs what scripts/package makes, which tries it",
    "sudo apt install ./mocha-ugv_*.deb ./mocha-ugv-common_*.deb": "the same",
    "rosrun mocha_ugv demo": "is of the packages; test/packages/try_packages runs it",
    "rosrun mocha_ugv install_robot --robot ugv3 --mapping true --workspace ~/lidar_ws/devel --lidar-launch ~/lidar.launch": "the same",
    "git archive HEAD | ssh ugv3.local 'mkdir -p mocha_ugv && tar x -C mocha_ugv'": "needs a robot",
    "cd mocha_ugv": "is where the scripts are run here",
    "sudo reboot": "would",
    "journalctl -fu mocha_ugv": "needs the service on a robot",
    "ROS_MASTER_URI=http://ugv3:11311 rosrun mocha_ugv fleet_view": "needs a display and a robot; test/rviz_panel_test.py has both",
    ". _build/devel/setup.bash": "is done where this test runs",
    ". ~/mocha_ugv/_build/devel/setup.bash": "is done where this test runs",
    "cd ~/my_robot": "is where all of the walkthrough runs here",
    "scripts/build": "has been done where this test runs",
}

SPILL = "{zones: [{name: spill, area: {points: [{x: 2, y: 1}, {x: 4, y: 1}, {x: 4, y: 2}]}, max_speed: 0}]}"

# What is run in place of what stands there, and why.
USER = "daemon" if getpass.getuser() == "root" else getpass.getuser()
INSTEAD = (
    (r"(~/mocha_ugv/)?scripts/demo\b", "/usr/bin/python3 -m mocha_scripts.demo --headless --rate 0 --out out"),  # without a build, a display, the clock
    (r"scripts/fleet_key", f"{ROOT}/scripts/fleet_key"),
    (r"scripts/install_robot", f"{ROOT}/scripts/install_robot --root $HOME --user {USER}"),  # writes below there
    (r"rviz:=true", "rviz:=false"),  # no display
    (r"lcm_url:=udpm\S*", "lcm_url:="),  # no route for multicast; test/netns and drives by LCM use it
    (r"/tmp/ugv\d_base", "$HOME/base"),  # another run on this machine may have its own there
    (r"base_emulator$", "base_emulator _link:=$HOME/base"),
    (r"/home/pi/", "$HOME/"),
    (r"world:=FILE", f"world:={ROOT}/config/worlds/two_swap.yaml"),
    (r"bag:=FILE", "bag:=out/drive.bag"),
    (r"^roscore$", "roscore -p $PORT"),
    (r"^python3", "/usr/bin/python3"),
    (r"~/mocha_ugv/examples", f"{ROOT}/examples"),
    (r"~/mocha_ugv/config", f"{ROOT}/config"),
    (r"^scripts/plan3d config", f"/usr/bin/python3 -m mocha_scripts.plan3d {ROOT}/config"),  # without a build
    (r"map_file:=config", f"rviz:=false map_file:={ROOT}/config"),
)


def all_commands(texts):
    """Those that are to be run or listed."""
    for text in texts.values():
        yield from docs_test.boxed_commands(text)
        yield from (command for command in docs_test.spoken_commands(text) if SPOKEN.match(command))


def gaps(said, taken, listed):
    yield from (f"{command}: neither run nor listed" for command in sorted(said - taken - set(listed)))
    yield from (f"{command}: listed, and no page says so" for command in sorted(set(listed) - said))
    yield from (f"{command}: listed, and run" for command in sorted(taken & set(listed)))


def files(page):
    """The files that a page shows: a name in code type that ends a line with a colon, and the box that follows."""
    text = (ROOT / page).read_text()
    return dict(re.findall(r"`([\w.]+)`[^`\n]*:\n\n```\w+\n(.*?)^```$", text, re.DOTALL | re.MULTILINE))


class Desk:
    """A home folder and a roscore's port, and what was started there. It ends all of that."""

    def __init__(self, name):
        self._folder = tempfile.TemporaryDirectory(prefix=f"mocha_docs_{name}_", ignore_cleanup_errors=True)
        self.home = pathlib.Path(self._folder.name)
        port = str(free_port())
        self._master = f"http://localhost:{port}"
        paths = [str(ROOT / "scripts"), os.environ.get("PYTHONPATH", "")]
        self.environment = {**os.environ, "HOME": str(self.home), "ROS_HOME": str(self.home / ".ros"), "ROS_MASTER_URI": self._master, "PORT": port,
                            "ROS_HOSTNAME": "localhost", "PYTHONUNBUFFERED": "1", "PYTHONPATH": ":".join(filter(None, paths)),
                            "PATH": "/usr/bin:/bin:/usr/sbin:/sbin"}
        self._started = []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in reversed(self._started):
            self.end(process)
        for pid in self.left_over():  # what roslaunch has started anew while it was ended
            os.kill(pid, signal.SIGKILL)
        self._folder.cleanup()

    def left_over(self):
        """Processes that know the master of this desk."""
        mark = f"ROS_MASTER_URI={self._master}".encode()
        for folder in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                if mark in (folder / "environ").read_bytes().split(b"\0"):
                    yield int(folder.name)
            except OSError:
                continue  # somebody else's, or gone

    def _popen(self, command, output):
        for pattern, other in INSTEAD:
            command = re.sub(pattern, lambda _, other=other: other, command)
        command = command.replace("$HOME", self.environment["HOME"])  # also where it is quoted
        process = subprocess.Popen(["bash", "-c", command], cwd=self.home, env=self.environment, stdout=output, stderr=subprocess.STDOUT, text=True,
                                   start_new_session=True)
        self._started.append(process)
        return process

    def run(self, command, says="", patience_s=90.0):
        """To its end, which has to be a good one; what it says has to hold a text."""
        process = self._popen(command, subprocess.PIPE)
        try:
            output, _ = process.communicate(timeout=patience_s)
        except subprocess.TimeoutExpired:
            raise AssertionError(f"{command}: does not end in {patience_s:.0f} s") from None
        if process.returncode != 0 or says not in output:
            raise AssertionError(f"{command}: ended with {process.returncode}, and said:\n{output}")
        return output

    def start(self, command):
        """What runs on; its words go to a file."""
        log = self.home / f"{len(self._started)}.log"
        with open(log, "w") as file:
            process = self._popen(command, file)
        process.log = log
        process.command = command
        return process

    def await_words(self, process, holds, what):
        """Until what a process has said so far, a text, is as it should be."""
        def looks_so():
            text = process.log.read_text()
            if process.poll() is not None and not holds(text):
                raise AssertionError(f"{process.command}: ended with {process.returncode}, and said:\n{text}")
            return holds(text)

        wait_until(looks_so, lambda: f"{process.command}: {what() if callable(what) else what}; what was said:\n{self.last_words()}", 90.0)

    def last_words(self):
        """Of all that was started and runs on."""
        return "\n".join(f"--- {path.name}\n{path.read_text()[-2000:]}" for path in sorted(self.home.glob("*.log")))

    def nodes(self):
        try:
            with xmlrpc.client.ServerProxy(self._master) as master:
                _, _, state = master.getSystemState("/docs")
        except OSError:
            return set()
        return {node for kind in state for _, names in kind for node in names}

    def start_roscore(self, command="roscore"):
        self.await_words(self.start(command), lambda _: "/rosout" in self.nodes(), "is not there")

    def launch(self, command):
        """Starts it, and returns when all its nodes have been there: some end when they are done."""
        missing = set(self.run(re.sub("^roslaunch", "roslaunch --nodes", command)).split())
        if not missing:
            raise AssertionError(f"{command}: starts nothing")
        if "/launch_agents" in missing:  # no node: it starts those of the robots
            missing ^= {"/launch_agents", "/ugv1/perception", "/ugv2/perception"}

        def are_there(_):
            missing.difference_update(self.nodes())
            return not missing

        process = self.start(command)
        self.await_words(process, are_there, lambda: f"{missing} are not there")
        return process

    def end(self, process):
        """As Ctrl-C does, with all that it has started."""
        for number, patience_s in ((signal.SIGINT, 30.0), (signal.SIGKILL, 5.0)):  # roslaunch gives its nodes 17 s
            if process.poll() is None:
                os.killpg(process.pid, number)
                try:
                    process.wait(patience_s)
                except subprocess.TimeoutExpired:
                    continue


def last_place(text):
    """The newest x and y that `rostopic echo` of a position has printed."""
    return [float(values[-1]) for values in (re.findall(rf"^{axis}: (\S+)$", text, re.MULTILINE) for axis in "xy") if values]


def last_sentence(text):
    return (re.findall(r'^"(.*)"$', text, re.MULTILINE) or [""])[-1]


def is_at(place):
    return lambda text: len(last_place(text)) == 2 and math.dist(last_place(text), place) < 0.2


# --- the scenes: what readers do. `take` gives the words of a page back, and counts them as run ---

def walk_through(take):
    """docs/own_robot.md: a model, a world and a base of one's own, the way to a goal, a map, and the way in it."""
    shown = files("docs/own_robot.md")
    with Desk("own") as desk:
        desk.run(take("mkdir -p ~/my_robot"))
        desk.home /= "my_robot"
        for name, text in shown.items():
            (desk.home / name).write_text(text)
        desk.run(take("~/mocha_ugv/scripts/demo --world my_room.yaml"), "demo: passed")
        desk.start_roscore(take("roscore"))
        base = desk.start(take("ROS_NAMESPACE=my_robot python3 my_base.py"))
        desk.await_words(base, lambda _: "/my_robot/my_base" in desk.nodes(), "no base")
        stack = desk.launch(take("roslaunch mocha_ugv robot.launch robot:=my_robot model:=my_robot.yaml base:=false lcm_url:=topics mapping:=true"))
        watch = take("rostopic echo /my_robot/localized_pose/pose/pose/position")
        goal = "rostopic pub -1 /my_robot/move_base_simple/goal geometry_msgs/PoseStamped '{header: {frame_id: map}, pose: {position: {x: %s}}}'"
        place = desk.start(watch)
        desk.await_words(place, is_at((0.0, 0.0)), "does not know where it is")
        desk.run(take(goal % "4.0, y: -1.2"))
        desk.await_words(place, is_at((4.0, -1.2)), "does not get behind the table")
        desk.run(take("rosservice call /my_robot/save_map $HOME/my_robot/my_map.yaml"), "success: True")
        desk.end(place)
        desk.end(stack)
        desk.launch(take("roslaunch mocha_ugv robot.launch robot:=my_robot model:=my_robot.yaml base:=false lcm_url:=topics map_file:=my_map.yaml"))
        place = desk.start(watch)
        desk.await_words(place, is_at((4.0, -1.2)), "does not find its place in the map")
        desk.run(take(goal % "0.0, y: -1.0"))
        desk.await_words(place, is_at((0.0, -1.0)), "does not get back")
        convert = take("python3 -c \"from PIL import Image; Image.open('plan.gif').convert('L').save('plan.pgm')\"")
        desk.run("python3 -c \"from PIL import Image; Image.open('my_map.pgm').save('plan.gif')\"")
        desk.run(convert)
        pixels = [(desk.home / name).read_bytes()[-1000:] for name in ("my_map.pgm", "plan.pgm")]
        if pixels[0] != pixels[1] or (desk.home / "plan.pgm").read_bytes()[:2] != b"P5":
            raise AssertionError("plan.pgm is another picture")


def look_after_a_robot(take):
    """docs/on_a_robot.md and others: all that is called while a robot drives, here the emulated one."""
    with Desk("robot") as desk:
        desk.start_roscore()
        desk.run("rosparam set /ugv3/base_emulator/link $HOME/base")
        desk.launch(take("roslaunch mocha_ugv emulated_robot.launch"))
        desk.launch(take("roslaunch mocha_ugv robot.launch robot:=ugv3 port:=/tmp/ugv3_base lcm_url:=topics mapping:=true rviz:=true"))
        sentences = desk.start(take("rostopic echo /ugv1/planner_status/message").replace("ugv1", "ugv3"))
        health = desk.start(take("rostopic echo /diagnostics"))
        odometry = desk.start("rostopic echo /ugv3/odom/twist/twist/linear/x")
        desk.run(take("rostopic pub -1 /ugv3/move_base_simple/goal geometry_msgs/PoseStamped "
                      "'{header: {frame_id: map}, pose: {position: {x: 6.0, y: 3.4}}}'"))
        desk.await_words(odometry, lambda text: any(float(value) > 0.2 for value in re.findall(r"^\d\S*$", text, re.MULTILINE)), "does not drive")
        desk.run(take("rosservice call /ugv3/pause true"), "success: True")
        desk.await_words(sentences, lambda text: "until it is resumed" in last_sentence(text), "is not paused")
        desk.run(take("rosservice call /ugv3/pause false"), "success: True")
        desk.await_words(sentences, lambda text: "until it is resumed" not in last_sentence(text), "stays paused")
        desk.run(take("rosservice call /ugv1/pause false").replace("ugv1", "ugv3"), "success: True")
        for command in ("rosservice call /ugv3/emergency_stop true", "rosservice call /ugv3/fleet/emergency_stop true"):
            desk.run(take(command), "success: True")
            desk.run("rostopic echo -n 1 /ugv3/emergency_stop_state", "stopped: True")
            desk.run(command.replace("true", "false"), "success: True")
            desk.run("rostopic echo -n 1 /ugv3/emergency_stop_state", "stopped: False")
        set_live = "rosrun dynamic_reconfigure dynparam set "
        desk.run(take(set_live + "/ugv3/global_planner replan_period 2.0"))
        desk.run("rosrun dynamic_reconfigure dynparam get /ugv3/global_planner", "'replan_period': 2.0")
        desk.run(take(set_live + "/fleet_simulator sensor_fault scan_frozen"))
        desk.run("rosrun dynamic_reconfigure dynparam get /fleet_simulator", "'sensor_fault': 'scan_frozen'")
        desk.run(set_live + "/fleet_simulator sensor_fault none")
        (desk.home / "zones.yaml").write_text(files("docs/on_a_robot.md")["zones.yaml"])
        zones = desk.start("rostopic echo /ugv3/zones/zones")
        for given, name in (("{path: /home/pi/zones.yaml}", "stairs"), (SPILL, "spill")):
            desk.run(take(f"rosservice call /ugv3/set_zones '{given}'"), "success: True")
            desk.await_words(zones, lambda text, name=name: f'name: "{name}"' in text, f"says nothing of {name}")
        desk.run(take("rosservice call /ugv3/set_zones '{}'"), "success: True")
        desk.run(take("rostopic pub -1 /ugv3/patrol nav_msgs/Path '{header: {frame_id: map}, poses: [{pose: {position: {x: 1.0}}}, "
                      "{pose: {position: {x: 6.0, y: 3.4}}}]}'"))
        desk.await_words(sentences, lambda text: "waypoint 1 of 2" in text, "does not patrol")
        desk.run(take("rosservice call /ugv3/save_map /home/pi/flat.bt"), "success: True")
        if not (desk.home / "flat.bt").stat().st_size:
            raise AssertionError("the map is empty")
        # There was no other drive here; test/rostest/robot_mapping_test.py has one.
        desk.run(take("rosservice call /ugv3/merge_pose_graph /home/pi/other_half.g2o"), "other_half.g2o: cannot")
        desk.run(take("rosservice call /ugv1/clear_map").replace("ugv1", "ugv3"), "success: True")
        desk.await_words(health, lambda text: "perception: sensors" in text, "says nothing of the sensors")


def start_nodes(take):
    """docs/nodes.md, own_robot.md, fleet_network.md: single nodes, the stack alone, the fleet's key."""
    shown = files("docs/own_robot.md")
    with Desk("nodes") as desk:
        (desk.home / "my_robot.yaml").write_text(shown["my_robot.yaml"])
        (desk.home / "mine.yaml").write_text(shown["mine.yaml"])
        desk.run(take("rosrun mocha_ugv perception --help"), "scan_timeout")
        desk.run(take("scripts/fleet_key ~/fleet.key"))
        desk.start_roscore()
        desk.start(take("ROS_NAMESPACE=ugv1 rosrun mocha_ugv base_emulator"))
        desk.start(take("ROS_NAMESPACE=ugv1 rosrun mocha_ugv base_driver _port:=/tmp/ugv1_base"))
        desk.run("rostopic echo -n 1 /ugv1/odom", "frame_id: \"ugv1/odom\"")
        desk.launch(take("roslaunch mocha_ugv agent.launch robot:=ugv1 model:=my_robot.yaml lcm_url:=udpm://239.255.76.67:7667?ttl=1 "
                         "fleet_key:=$HOME/fleet.key"))
        desk.end(desk.launch(take("roslaunch mocha_ugv agent.launch robot:=ugv3 model:=my_robot.yaml")))
        stack = desk.launch(take("roslaunch mocha_ugv agent.launch robot:=ugv3 parameters:=mine.yaml"))
        desk.run("rosparam get /ugv3/local_replanner/horizon", "5.0")
        desk.end(stack)
        desk.launch(take("roslaunch mocha_ugv robot.launch robot:=ugv3 cmd_vel_topic:=cmd_vel_planned"))
        desk.start(take("ROS_NAMESPACE=ugv3 rosrun topic_tools mux cmd_vel cmd_vel_planned cmd_vel_joystick mux:=cmd_vel_mux"))
        wait_until(lambda: "/ugv3/mux" in desk.nodes() or any("mux" in node for node in desk.nodes()), "no mux")
        desk.run(take("rosservice call /ugv3/cmd_vel_mux/select cmd_vel_joystick"), "prev_topic")
        desk.run(take("rosparam set /use_sim_time false"))


def drive_and_replay(take):
    """README.md, docs/scripts.md: the demo, the same by hand, and what it has recorded."""
    with Desk("demo") as desk:
        desk.run(take("scripts/demo"), "demo: passed", 240.0)
        desk.end(desk.launch(take("roslaunch mocha_ugv fleet_sim.launch world:=FILE rviz:=true")))
        desk.end(desk.launch(take("roslaunch mocha_ugv replay.launch bag:=FILE robot:=ugv1")))


def install(take):
    """docs/on_a_robot.md: the service, here written below a folder."""
    with Desk("install") as desk:
        (desk.home / "lidar_ws/devel").mkdir(parents=True)
        (desk.home / "lidar_ws/devel/setup.bash").write_text("")
        (desk.home / "lidar.launch").write_text((ROOT / "test/rostest/vendor_lidar.launch").read_text())
        (desk.home / "flat.bt").write_bytes((ROOT / "config/maps/corridor.bt").read_bytes())
        settings = desk.home / "etc/mocha_ugv/robot.env"
        desk.run(take("scripts/install_robot --robot ugv3 --mapping true --workspace ~/lidar_ws/devel --lidar-launch ~/lidar.launch --lidar-frame laser_link"))
        if "MAPPING=true" not in settings.read_text():
            raise AssertionError(f"it does not map:\n{settings.read_text()}")
        desk.run(take("scripts/install_robot --mapping false --map ~/flat.bt"))
        if "MAPPING=false" not in settings.read_text() or "flat.bt" not in settings.read_text():
            raise AssertionError(f"it does not use the map:\n{settings.read_text()}")


def use_the_library(take):
    """docs/library.md: the examples in C++ and Python."""
    with Desk("library") as desk:
        desk.run(take("cmake -S ~/mocha_ugv/examples/cpp -B plan_build"))
        desk.run(take("cmake --build plan_build"), patience_s=300.0)
        said = desk.run(take("plan_build/plan"))
        shown = re.search(r"^```text\n(.*?)^```$", (ROOT / "docs/library.md").read_text(), re.DOTALL | re.MULTILINE).group(1)
        # Which ways cannot win any more depends on how fast others were.
        if [line for line in said.splitlines() if line[:3].strip()] != [line for line in shown.splitlines() if line[:3].strip()]:
            raise AssertionError(f"docs/library.md shows other words than these:\n{said}")
        desk.run(take("python3 ~/mocha_ugv/examples/python/plan.py plan.png"), "-> cost")
        desk.run(take("python3 ~/mocha_ugv/examples/python/plan_in_space.py ~/mocha_ugv/config/maps/two_storeys.bt"), "places, the highest")


def plan_in_space(take):
    """docs/space.md."""
    with Desk("space") as desk:
        desk.run(take("scripts/plan3d config/maps/two_storeys.bt --start 2,2,1.2 --goal 10,8,4.4 --picture out/two_storeys.png --json out/two_storeys.json"),
                 "solved")
        if not all((desk.home / "out" / name).stat().st_size for name in ("two_storeys.png", "two_storeys.json")):
            raise AssertionError("it draws or writes nothing")
        desk.start_roscore()
        desk.launch(take("roslaunch mocha_ugv space.launch map_file:=config/maps/two_storeys.bt"))
        desk.run("rosservice call --wait" + take('rosservice call /plan_in_space "{start: {x: 2.0, y: 2.0, z: 1.2}, goal: {x: 10.0, y: 8.0, z: 4.4}, classes: 0}"')
                 .removeprefix("rosservice call"), "success: True")


SCENES = (walk_through, look_after_a_robot, start_nodes, drive_and_replay, install, use_the_library, plan_in_space)


class Commands(unittest.TestCase):
    def test_each_is_run_or_listed(self):
        said, taken = set(all_commands(docs_test.pages())), set()

        def take(command):
            """The same words, which a page has to have."""
            self.assertIn(command, said, "no page says so")
            taken.add(command)
            return command

        for scene in SCENES:
            begin_s = time.monotonic()
            scene(take)
            print(f"{scene.__name__}: {time.monotonic() - begin_s:.0f} s", flush=True)
        self.assertEqual(list(gaps(said, taken, NOT_RUN)), [])

    def test_gaps_are_noticed(self):
        self.assertEqual(list(gaps({"run", "listed"}, {"run"}, {"listed"})), [])
        self.assertEqual(list(gaps({"run", "new"}, {"run"}, {})), ["new: neither run nor listed"])
        self.assertEqual(list(gaps({"run"}, {"run"}, {"old"})), ["old: listed, and no page says so"])
        self.assertEqual(list(gaps({"run"}, {"run"}, {"run"})), ["run: listed, and run"])

    def test_all_commands_are_found(self):
        page = "Say `rostopic hz /scan`, `roslaunch`:\n\n```\n. setup.bash; a \\\n  b   # c\n```\n\n```yaml\nd: e\n```\n\n   ```\n   f\n   ```\n"
        self.assertEqual(list(all_commands({"page": page})), [". setup.bash; a b", "f", "rostopic hz /scan"])

    def test_a_desk_notices_what_goes_wrong(self):
        with Desk("faults") as desk:
            self.assertEqual(desk.run("echo $HOME"), f"{desk.home}\n")
            for command, says in (("false", ""), ("echo no", "yes")):
                with self.assertRaises(AssertionError):
                    desk.run(command, says)
            with self.assertRaisesRegex(AssertionError, "does not end"):
                desk.run("sleep 60", patience_s=0.1)
            with self.assertRaisesRegex(AssertionError, "ended with 3"):
                desk.await_words(desk.start("echo here; exit 3"), lambda text: "there" in text, "is not there")
        self.assertFalse(desk.home.exists())

    def test_a_desk_leaves_nothing_behind(self):
        with Desk("left") as desk:
            process = desk.start("setsid sleep 600 & echo $!")
            desk.await_words(process, lambda text: text.strip(), "is not there")
            # The shell may still be there, and a program that begins shows no environment yet.
            wait_until(lambda: len(list(desk.left_over())) == 1, "one is left", 10.0)
        wait_until(lambda: not list(desk.left_over()), "it has ended", 10.0)


if __name__ == "__main__":
    unittest.main()
