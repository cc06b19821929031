"""A ROS session of its own: a master on a free port and one roslaunch in it, both ended together."""
import os
import re
import signal
import socket
import subprocess
import tempfile
import time

COLOUR = re.compile(r"\x1b\[[0-9;]*m")


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Session:
    """Starts roslaunch with its own master. Environment variables of this process point at it from then on. What ROS keeps besides, unless
    ROS_HOME says where, is gone at the end."""

    def __init__(self, launch_file, arguments, log_path):
        port = free_port()
        os.environ["ROS_MASTER_URI"] = f"http://localhost:{port}"
        os.environ["ROS_HOSTNAME"] = "localhost"
        os.environ.setdefault("ROSCONSOLE_STDOUT_LINE_BUFFERED", "1")
        os.environ.setdefault("ROSCONSOLE_FORMAT", "[${severity}] [${time}] ${message}")
        self._home = None
        if "ROS_HOME" not in os.environ:
            self._home = tempfile.TemporaryDirectory(prefix="mocha_ugv_", ignore_cleanup_errors=True)
            os.environ["ROS_HOME"] = self._home.name
        self.log_path = log_path
        self._log = open(log_path, "w")
        command = ["roslaunch", "-p", str(port), "mocha_ugv", launch_file]
        command += [f"{key}:={value}" for key, value in arguments.items()]
        self._process = subprocess.Popen(command, stdout=self._log, stderr=subprocess.STDOUT, start_new_session=True)
        self._extra = []

    def add(self, command):
        """Another process that ends with the session."""
        self._extra.append(subprocess.Popen(command, stdout=self._log, stderr=subprocess.STDOUT,
                                            start_new_session=True))
        return self._extra[-1]

    def wait_for_launch(self, patience_s=30.0):
        """True once roslaunch has set up its master and said whether time is simulated: what starts later follows its clock."""
        import rosgraph
        until = time.monotonic() + patience_s
        while time.monotonic() < until and self.alive():
            if rosgraph.is_master_online() and rosgraph.Master("/session").hasParam("/use_sim_time"):
                return True
            time.sleep(0.1)
        return False

    def alive(self):
        return self._process.poll() is None

    def fault(self):
        """What the first node says that cannot work; none where all can. roslaunch goes on with such a node, which stays and does nothing."""
        return self._first_line("[FATAL]")

    def last_words(self):
        """The complaint with which a session ended by itself."""
        return self.fault() or self._first_line("[ERROR]", "Error") or "roslaunch ended; see " + self.log_path

    def _first_line(self, *marks):
        with open(self.log_path) as log:
            whole = (line for line in log if line.endswith("\n"))
            return next((COLOUR.sub("", line).strip() for line in whole if any(mark in line for mark in marks)), None)

    def close(self):
        for process in self._extra + [self._process]:
            _end(process)
        self._log.close()
        if self._home:
            self._home.cleanup()
            del os.environ["ROS_HOME"]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def _end(process):
    for number, patience_s in ((signal.SIGINT, 10.0), (signal.SIGTERM, 5.0), (signal.SIGKILL, 5.0)):
        if process.poll() is not None:
            return
        try:
            os.killpg(process.pid, number)
        except ProcessLookupError:
            return
        until = time.monotonic() + patience_s
        while process.poll() is None and time.monotonic() < until:
            time.sleep(0.05)
