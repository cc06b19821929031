"""Joins a robot's roscore with the simulator's, which stand on different hosts. Two processes, as a ROS process knows one roscore only:

    adapter simulator ROBOT ADDRESS     on the simulator's host; awaits the other one there
    adapter robot     ROBOT ADDRESS     on the robot's host; ADDRESS is the simulator's

To the robot go the clock, what its sensors would say (of tf only its own part) and goals; to the simulator commands, receipts for steps, and
what the robot reports. What is sent while the other end is away is lost, but for latched topics, of which it gets the newest when it is back."""
import contextlib
import io
import socket
import struct
import sys
import threading
import time

import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped, Twist
from mocha_ugv.msg import FleetTrajectories, PlannerStatus, StepAck
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

PORT = 7400
_HEAD = struct.Struct("!BI")  # number of the topic, bytes of the message
_PATIENCE_S = 5.0  # of a send: an end that takes nothing for so long is given up
_RETRY_S = 0.1
_QUEUE = 100

TO_ROBOT = [("/clock", Clock), ("/tf", TFMessage), ("/tf_static", TFMessage), ("/{robot}/odom", Odometry),
            ("/{robot}/scan", LaserScan), ("/{robot}/move_base_simple/goal", PoseStamped)]
TO_SIMULATOR = [("/{robot}/cmd_vel", Twist), ("/fleet_simulator/acks", StepAck), ("/diagnostics", DiagnosticArray),
                ("/{robot}/fleet/trajectories", FleetTrajectories), ("/{robot}/planner_status", PlannerStatus)]
LATCHED = ("/tf_static", "/{robot}/fleet/trajectories")


class Bytes(rospy.AnyMsg):
    """A message that is only passed on."""

    def __init__(self, text=None):
        super().__init__()
        self._buff = text

    @staticmethod
    def of(kind):
        """The same, publishable as what it is."""
        return type(kind.__name__, (Bytes,), {name: getattr(kind, name) for name in ("_type", "_md5sum", "_full_text")})


class Adapter:
    """One end. `connect()` makes the next connection to the other one."""

    def __init__(self, robot, sent, received, connect):
        self._robot = robot
        self._connect = connect
        self._connection = None
        self._lock = threading.Lock()
        self._newest = {}  # number of a latched topic -> its message
        self._publishers = [self._publisher(topic, kind) for topic, kind in received]
        self._latched = {number for number, (topic, _) in enumerate(sent) if topic in LATCHED}
        for number, (topic, kind) in enumerate(sent):
            self._subscribe(number, topic.format(robot=robot), kind)

    def _publisher(self, topic, kind):
        made = Bytes.of(kind)
        publisher = rospy.Publisher(topic.format(robot=self._robot), made, queue_size=_QUEUE, latch=topic in LATCHED)
        return lambda text: publisher.publish(made(text))

    def _subscribe(self, number, topic, kind):
        if kind is TFMessage:
            rospy.Subscriber(topic, TFMessage, lambda message: self._send(number, self._own_part(message)), tcp_nodelay=True)
        else:
            rospy.Subscriber(topic, rospy.AnyMsg, lambda message: self._send(number, message._buff), tcp_nodelay=True)

    def _own_part(self, message):
        own = TFMessage([transform for transform in message.transforms if transform.child_frame_id.startswith(self._robot + "/")])
        text = io.BytesIO()
        own.serialize(text)
        return text.getvalue()

    def _send(self, number, text):
        with self._lock:
            if number in self._latched:
                self._newest[number] = text
            self._write(number, text)

    def _write(self, number, text):
        if self._connection is None:
            return
        try:
            self._connection.sendall(_HEAD.pack(number, len(text)) + text)
        except OSError as error:
            rospy.logwarn("%s: connection lost: %s", self._robot, error)
            self._drop()

    def _drop(self):
        """Wakes the readers, on both ends, so that they connect anew."""
        with contextlib.suppress(OSError):
            self._connection.shutdown(socket.SHUT_RDWR)
        self._connection = None

    def run(self):
        while not rospy.is_shutdown():
            connection = self._connect()
            connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            connection.setsockopt(socket.SOL_SOCKET, socket.SO_SNDTIMEO, struct.pack("ll", int(_PATIENCE_S), 0))
            with self._lock:
                self._connection = connection
                for number, text in self._newest.items():
                    self._write(number, text)
            self._receive(connection.makefile("rb"))
            with self._lock:
                self._connection = None
            connection.close()

    def _receive(self, stream):
        """Until the other end goes away."""
        try:
            while len(head := stream.read(_HEAD.size)) == _HEAD.size:
                number, size = _HEAD.unpack(head)
                text = stream.read(size)
                if len(text) == size:
                    self._publishers[number](text)
        except (OSError, rospy.ROSException) as error:
            rospy.logwarn("%s: connection lost: %s", self._robot, error)


def listening(address):
    server = socket.create_server((address, PORT))
    return lambda: server.accept()[0]


def calling(address):
    def connect():
        while True:
            try:
                return socket.create_connection((address, PORT))
            except OSError:
                time.sleep(_RETRY_S)
    return connect


def main(arguments):
    if len(arguments) != 3 or arguments[0] not in ("simulator", "robot"):
        print(__doc__)
        return 0 if arguments in (["-h"], ["--help"]) else 2
    end, robot, address = arguments
    # Without a time of its own: it would listen to a clock that it passes on.
    rospy.init_node(f"adapter_{robot}", disable_rostime=True)
    if end == "simulator":
        Adapter(robot, TO_ROBOT, TO_SIMULATOR, listening(address)).run()
    else:
        Adapter(robot, TO_SIMULATOR, TO_ROBOT, calling(address)).run()
    return 0


if __name__ == "__main__":
    sys.exit(main(rospy.myargv(sys.argv)[1:]))
