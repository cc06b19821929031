#!/usr/bin/python3
"""scripts/install_robot, writing below a directory instead of into the system: settings, service, network, clock and serial line, what it
keeps when it is run again, what it refuses, and what it takes away."""
import getpass
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

import roslaunch.config
import roslaunch.xmlloader

ROOT = pathlib.Path(__file__).resolve().parent.parent
USER = "daemon" if getpass.getuser() == "root" else getpass.getuser()
UNIT = "etc/systemd/system/mocha_ugv.service"
SETTINGS = "etc/mocha_ugv/robot.env"
CLOCK = "etc/chrony/conf.d/mocha_ugv.conf"
NAMED = ("--robot", "ugv3", "--mapping", "true")
ROUTE = "etc/NetworkManager/dispatcher.d/50-mocha_ugv"
BOOT = "boot/firmware/config.txt"


class InstallRobot(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.root = pathlib.Path(directory.name)

    script = ROOT / "scripts/install_robot"

    def install(self, *arguments, expect=0):
        command = [self.script, "--root", self.root, "--user", USER, *arguments]
        result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=self.root)
        self.assertEqual(result.returncode, expect, result.stdout)
        return result.stdout

    def read(self, path):
        return (self.root / path).read_text()

    def write(self, path, text="", mode=0o644):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        file.chmod(mode)
        return str(file)

    def key(self):
        path = self.write("fleet.key", mode=0o600)
        shutil.chown(path, USER)
        return path

    def settings(self):
        return dict(line.split("=", 1) for line in self.read(SETTINGS).splitlines() if not line.startswith("#"))

    def files(self):
        return {str(path.relative_to(self.root)) for path in self.root.rglob("*") if path.is_file()}

    def command(self):
        """What the service starts, as systemd reads it."""
        command = re.search(r"^ExecStart=((?:.*\\\n)*.*)$", self.read(UNIT), re.MULTILINE).group(1).replace("\\\n", " ")
        for name, value in self.settings().items():
            command = command.replace("${%s}" % name, value)
        return shlex.split(command)

    def launched(self):
        """The same, as roslaunch reads it."""
        enter, roslaunch_name, package, launch_file, *arguments = self.command()
        self.assertEqual([enter, roslaunch_name, package], ["/opt/mocha_ugv/env.sh", "roslaunch", "mocha_ugv"])
        config = roslaunch.config.ROSLaunchConfig()
        roslaunch.xmlloader.XmlLoader().load(str(ROOT / "launch" / launch_file), config, argv=arguments, verbose=False)
        return config

    # --- what it writes ---

    def test_settings_reach_the_nodes(self):
        map_file, key = self.write("flat.bt"), self.key()
        parameters = self.write("parameters.yaml", "{local_replanner: {horizon: 5.0}}")
        lidar = self.write("lidar.launch", (ROOT / "test/rostest/vendor_lidar.launch").read_text())
        self.install("--robot", "ugv5", "--model", "rover", "--priority", "-2", "--port", "/dev/ttyUSB1", "--robot-type", "3",
                     "--map", "flat.bt", "--pose-graph", "flat.g2o", "--key", key, "--lidar-launch", lidar, "--lidar-topic", "/scan", "--lidar-frame", "laser_link", "--lcm-url", "topics",
                     "--parameters", parameters)
        config = self.launched()
        values = {name: parameter.value for name, parameter in config.params.items()}
        self.assertEqual([values["/ugv5/base_driver/" + name] for name in ("port", "robot_model", "robot_type")], ["/dev/ttyUSB1", "rover", 3])
        self.assertEqual(values["/ugv5/scan_localizer/pose_graph_file"], str(pathlib.Path(map_file).with_suffix(".g2o")))
        self.assertEqual((values["/ugv5/scan_localizer/map_file"], values["/ugv5/trajectory_broadcaster/priority"]), (map_file, -2))
        self.assertEqual(values["/ugv5/local_replanner/horizon"], 5.0)
        broadcaster = "/ugv5/trajectory_broadcaster/"
        self.assertEqual((values[broadcaster + "fleet_key"], values[broadcaster + "lcm_url"]), (key, ""))
        nodes = {node.name: node for node in config.nodes}
        self.assertLessEqual({"vendor_lidar", "lidar_frame"}, set(nodes))
        self.assertIn(["/ugv5/scan", "/scan"], nodes["perception"].remap_args)

    def test_service_says_all_that_the_launch_file_asks(self):
        asked = {argument.get("name") for argument in ElementTree.parse(ROOT / "launch/robot.launch").findall("arg") if not argument.get("value")}
        self.install(*NAMED)
        self.assertEqual(set(re.findall(r'"(\w+):=', self.read(UNIT))), asked - {"rviz"})

    def test_defaults_are_those_of_the_launch_file(self):
        self.install(*NAMED)
        given = roslaunch.config.ROSLaunchConfig()
        roslaunch.xmlloader.XmlLoader().load(str(ROOT / "launch/robot.launch"), given, argv=["robot:=ugv3", "mapping:=true"], verbose=False)
        installed = self.launched()
        self.assertEqual({name: value.value for name, value in installed.params.items()},
                         {name: value.value for name, value in given.params.items()})
        self.assertEqual({node.name for node in installed.nodes}, {node.name for node in given.nodes})

    def test_service_is_sound(self):
        if not shutil.which("systemd-analyze"):
            self.skipTest("no systemd-analyze")
        self.install(*NAMED)
        self.write("unit/mocha_ugv.service", self.read(UNIT).replace("/opt/mocha_ugv/env.sh", "/usr/bin/env"))
        verdict = subprocess.run(["systemd-analyze", "verify", "--man=no", self.root / "unit/mocha_ugv.service"], text=True,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertNotIn("mocha_ugv.service:", verdict.stdout)
        self.assertIn(f"User={USER}\n", self.read(UNIT))

    def test_run_again_it_changes_what_is_named(self):
        self.install(*NAMED, "--priority", "4", "--clock", "ugv1.local")
        files = {path: self.read(path) for path in self.files()}
        self.install(*NAMED)
        self.assertEqual({path: self.read(path) for path in self.files()}, files)
        self.install("--priority", "5", "--clock", "")
        self.assertEqual((self.settings()["ROBOT"], self.settings()["PRIORITY"]), ("ugv3", "5"))
        self.assertEqual(set(files) - self.files(), {CLOCK})
        self.write(SETTINGS, self.read(SETTINGS) + "ROS_HOSTNAME=ugv3.local\n")
        self.install()
        self.assertEqual(self.settings()["ROS_HOSTNAME"], "ugv3.local")

    def test_multicast_route(self):
        self.install(*NAMED, "--interface", "wlan1")
        self.assertTrue(os.access(self.root / ROUTE, os.X_OK))
        for arguments, routed in ((["wlan1", "up"], True), (["wlan1", "down"], False), (["eth0", "up"], False)):
            script = self.read(ROUTE).replace("/etc/", f"{self.root}/etc/").replace("ip route", "echo route")
            output = subprocess.run(["sh", "-c", script, "dispatcher", *arguments], stdout=subprocess.PIPE, text=True, check=True).stdout
            self.assertEqual(output, "route replace 224.0.0.0/4 dev wlan1\n" if routed else "")

    def test_clock(self):
        self.install(*NAMED)
        self.assertNotIn(CLOCK, self.files())
        self.install("--clock", "ugv1.local")
        self.assertIn("server ugv1.local iburst", self.read(CLOCK))
        self.install("--clock", "self")
        self.assertIn("local stratum", self.read(CLOCK))

    def test_serial_line(self):
        self.write("proc/device-tree/model", "Raspberry Pi 4 Model B Rev 1.4\0")
        self.write(BOOT, "[cm4]\notg_mode=1\n")
        self.assertIn("raspi-config nonint do_serial_cons 1", self.install(*NAMED))
        self.assertEqual(self.settings()["PORT"], "/dev/serial0")
        self.assertEqual(self.read(BOOT), "[cm4]\notg_mode=1\n\n[all]\ndtoverlay=disable-bt\n")
        self.install()
        self.assertEqual(self.read(BOOT).count("disable-bt"), 1)

    def test_serial_line_of_a_raspberry_pi_5(self):
        self.write("proc/device-tree/model", "Raspberry Pi 5 Model B Rev 1.0\0")
        self.write(BOOT)
        self.assertIn("raspi-config nonint do_serial_hw 0", self.install(*NAMED))
        self.assertEqual((self.settings()["PORT"], self.read(BOOT)), ("/dev/ttyAMA0", ""))

    def test_serial_line_of_others_is_left_alone(self):
        self.assertNotIn("raspi-config", self.install(*NAMED))
        self.write("proc/device-tree/model", "Raspberry Pi 4 Model B Rev 1.4\0")
        self.assertNotIn("raspi-config", self.install("--base", "false"))

    # --- what it does not write ---

    def test_workspace_of_the_lidars_driver_is_entered_before_the_build(self):
        self.write("lidar_ws/devel/setup.bash")
        said = self.install(*NAMED, "--workspace", "lidar_ws/devel")
        self.assertRegex(said, f"(?s)would run: . {self.root}/lidar_ws/devel/setup.bash\n.*scripts/build")
        self.assertEqual(said, self.install())

    def test_where_the_package_is_installed_nothing_is_built(self):
        self.script = pathlib.Path(self.write("usr/lib/mocha_ugv/install_robot", (ROOT / "scripts/install_robot").read_text(), 0o755))
        share = self.root / "usr/share/mocha_ugv"
        share.mkdir(parents=True)
        for folder in ("config", "systemd"):
            (share / folder).symlink_to(ROOT / folder)
        said = self.install(*NAMED)
        self.assertNotIn("build", said)
        self.assertEqual(self.command()[:4], ["/usr/bin/env", "roslaunch", "mocha_ugv", "robot.launch"])
        self.assertIn("there is no config/robots/tank.yaml", self.install("--model", "tank", expect=2))
        self.write("lidar_ws/devel/setup.bash")
        self.install("--workspace", "lidar_ws/devel")
        self.assertEqual(self.command()[0], f"{self.root}/lidar_ws/devel/env.sh")
        self.install("--uninstall")
        self.assertTrue(self.script.exists())

    def test_dry_run_writes_nothing(self):
        said = self.install(*NAMED, "--dry-run")
        self.assertEqual(self.files(), set())
        for word in (SETTINGS, UNIT, ROUTE, "ROBOT=ugv3", "scripts/build --robot /opt/mocha_ugv", "systemctl enable mocha_ugv"):
            self.assertIn(word, said)

    def test_uninstall_takes_its_files_away(self):
        self.write(BOOT, "arm_64bit=1\n")
        self.write("opt/other/file")
        before = self.files()
        self.install(*NAMED, "--clock", "self")
        self.write("opt/mocha_ugv/env.sh")
        self.install("--uninstall", "--dry-run")
        self.assertIn("opt/mocha_ugv/env.sh", self.files())
        self.install("--uninstall")
        self.assertEqual(self.files(), before)
        self.install("--uninstall")

    def test_refuses(self):
        open_key = self.write("open.key", mode=0o644)
        foreign_key = self.write("foreign.key", mode=0o600)
        for arguments, complaint in [
                ([], "--robot is missing"),
                (["--robot", "3ugv"], "a name of letters, digits and _"),
                (["--robot"], "--robot needs a value"),
                (["--robot", "ugv3"], "no map to localise in"),
                ([*NAMED, "--model", "tank"], "there is no config/robots/tank.yaml"),
                ([*NAMED, "--model", "../robots/rover"], "there is no config/robots/"),
                ([*NAMED, "--model", "nowhere/tank.yaml"], "nowhere/tank.yaml: there is no such file"),
                ([*NAMED, "--priority", "high"], 'priority "high": must be a whole number'),
                ([*NAMED, "--base", "no"], "must be true or false"),
                ([*NAMED, "--port", "ttyS0"], "must be a device"),
                ([*NAMED, "--robot-type", "4"], "must be 1, 2 or 3"),
                ([*NAMED, "--map", "nowhere.bt"], "nowhere.bt: there is no such file"),
                ([*NAMED, "--map", self.write("map.pgm")], "must be a .bt, .ot or .yaml file"),
                ([*NAMED, "--map", self.write("a b.bt")], "characters that cannot be written"),
                ([*NAMED, "--workspace", "/nowhere"], "there is no /nowhere/setup.bash"),
                ([*NAMED, "--key", open_key], "others than its owner may read it"),
                ([*NAMED, "--lcm-url", "tcp://x"], "must be topics, or like udpm://"),
                ([*NAMED, "--prefix", "/usr/local"], "ends in /mocha_ugv"),
                ([*NAMED, "--user", "no_such_user"], "there is no such user"),
                ([*NAMED, "--user", "root"], "is not to run as root"),
                ([*NAMED, "--speed", "9"], "unknown option --speed"),
                (["ugv3"], "unexpected argument ugv3")]:
            with self.subTest(arguments=arguments):
                before = self.files()
                self.assertIn(complaint, self.install(*arguments, expect=2))
                self.assertEqual(self.files(), before)
        if os.geteuid() == 0:
            self.assertIn("does not belong to daemon", self.install(*NAMED, "--key", foreign_key, expect=2))


if __name__ == "__main__":
    unittest.main()
