"""Drives among people through the whole stack, lidar only, while a sensor begins to lie: one kind of lie a drive, and none to compare.

A lie begins a few seconds after the robot has set out, and stays. Noticed is what diagnostics or the log say of it, and how long after.
A drive ends where its goal is reached, or some time after the lie began. Whose a contact is, the ground truth says; see bench dynabarn.
"""
import multiprocessing
import os
import threading

from benchmarks import benchmark

FAULTS = ("none", "scan_frozen", "scan_delayed", "scan_rotated", "scan_noisy", "scan_blind_sector", "odometry_frozen", "odometry_slipping")
STANDING_MPS = 0.03
LIMIT_S = 120.0
BLAMES = ("own", "standing", "unseen")


def add_arguments(parser):
    parser.add_argument("--world", action="append", metavar="FILE", help="world with one robot ugv1 (again for more; default: two of people of"
                        " ours, and halls)")
    parser.add_argument("--halls", type=int, default=2, metavar="N", help="of bench crossing, seeds from 1 on (default 2)")
    parser.add_argument("--faults", default=",".join(FAULTS), metavar="NAME,...", help="sensor_fault of fleet_simulator (default: all)")
    parser.add_argument("--after", type=float, default=3.0, metavar="S", help="the lie begins so long after the robot set out (default 3)")
    parser.add_argument("--watch", type=float, default=25.0, metavar="S", help="and is watched for so long (default 25)")
    parser.add_argument("--map", default="", metavar="FILE", help="robots find out for themselves where they are in this map of the worlds")
    parser.add_argument("--jobs", type=int, default=1, help="drives at the same time (default 1)")
    parser.add_argument("--out", default="out/faults", metavar="DIR", help="worlds and logs go there (default out/faults)")
    parser.add_argument("--json", metavar="FILE", help="write the rows and the summary there")


class Liar:
    """Makes a sensor lie once the robot is under way, and hears what the robot says of it."""

    def __init__(self, fault, after_s, watch_s):
        import rospy
        from diagnostic_msgs.msg import DiagnosticArray
        from mocha_ugv.msg import GroundTruth
        from rosgraph_msgs.msg import Log
        self.fault, self.after_s, self.watch_s = fault, after_s, watch_s
        self.begun_s = None
        self.heard = []  # (time, words)
        self.speed = 0.0
        self.now_s = 0.0
        self._asked = False
        rospy.Subscriber("/fleet_simulator/ground_truth", GroundTruth, self._on_truth)
        rospy.Subscriber("/diagnostics", DiagnosticArray, self._on_diagnostics)
        rospy.Subscriber("/rosout", Log, self._on_log)

    def _on_truth(self, message):
        robot = message.robots[0]
        self.now_s, self.speed = message.header.stamp.to_sec(), robot.speed
        if robot.moved and not self._asked and self.now_s >= robot.moved_at.to_sec() + self.after_s:
            self._asked = True
            threading.Thread(target=self._begin, daemon=True).start()

    def _begin(self):
        from dynamic_reconfigure.client import Client
        client = Client("/fleet_simulator", timeout=20.0)
        client.update_configuration({"sensor_fault": self.fault})
        self.begun_s = self.now_s
        client.close()

    def _on_diagnostics(self, message):
        for status in message.status:
            tells = status.name.endswith("perception: sensor faults") or "odometry stands" in status.message
            if tells and status.level > 0:
                self.heard.append((message.header.stamp.to_sec(), status.message))

    def _on_log(self, message):
        tells = message.name.endswith("/perception") and message.level >= message.WARN and not message.msg.startswith("Refused")
        if tells or message.name.endswith("/trajectory_tracker") and "odometry stands" in message.msg:
            self.heard.append((message.header.stamp.to_sec(), message.msg.partition(": ")[2]))

    def over(self, _):
        if self.begun_s is not None and self.now_s > self.begun_s + self.watch_s:
            return "the lie was watched long enough"
        return None

    def noticed(self):
        """(words, seconds after) of the first that was said."""
        if not self.heard:
            return None, None
        at_s, words = min(self.heard)
        return words, None if self.begun_s is None else round(max(0.0, at_s - self.begun_s), 2)


def drive_world(job):
    """A row for one drive."""
    from mocha_scripts import drive  # here: the help needs no packages
    path, fault, after_s, watch_s, out, map_file = job
    name = os.path.splitext(os.path.basename(path))[0]
    liar = []

    def progress(referee):
        if not liar:
            liar.append(Liar(fault, after_s, watch_s))
        return liar[0].over(referee)

    results, why = drive.drive(path, ["ugv1"], os.path.join(out, f"{name}_{fault}"), rate=0.0, record=False, limit_s=LIMIT_S, map_file=map_file,
                               progress=progress)
    words, noticed_s = liar[0].noticed() if liar else (None, None)
    robot = results["robots"][0] if results["robots"] else {"reached": False}
    standing = bool(liar) and abs(liar[0].speed) < STANDING_MPS
    return {"world": name, "fault": fault, "noticed": words, "noticed_s": noticed_s,
            "ended": "arrived" if robot["reached"] else "stopped" if standing else "under way", "why": why,
            "contacts": {blame: sum(touch["blame"] == blame for touch in results.get("contacts", [])) for blame in BLAMES}}


def line_of(row):
    said = "-" if row["noticed"] is None else f"after {row['noticed_s']} s: {row['noticed']}"
    contacts = ", ".join(f"{number} {blame}" for blame, number in row["contacts"].items() if number)
    return f"{row['world']:<16}{row['fault']:<19}{row['ended']:<11}contacts {contacts or '0':<14}  {said}"


def worlds_of(options):
    import yaml
    from benchmarks.crossing_worlds import crossing_world
    from mocha_scripts import worlds
    os.makedirs(options.out, exist_ok=True)
    paths = options.world or [os.path.join(worlds.ROOT, path) for path in ("config/worlds/crossing.yaml", "test/worlds/people.yaml")]
    for seed in range(1, options.halls + 1):
        paths.append(os.path.join(options.out, f"hall_{seed:03}.yaml"))
        with open(paths[-1], "w") as file:
            yaml.safe_dump(crossing_world(seed), file, default_flow_style=None, sort_keys=False)
    return paths


def run(options):
    jobs = [(path, fault, options.after, options.watch, options.out, options.map) for path in worlds_of(options) for fault in options.faults.split(",")]
    rows = []
    # A process a drive: a ROS node cannot change its master.
    with multiprocessing.get_context("spawn").Pool(options.jobs, maxtasksperchild=1) as pool:
        for row in pool.imap(drive_world, jobs):
            rows.append(row)
            print(line_of(row), flush=True)
    lies = [row for row in rows if row["fault"] != "none"]
    summary = {"drives": len(lies), "noticed": sum(row["noticed"] is not None for row in lies),
               "arrived": sum(row["ended"] == "arrived" for row in lies), "stopped": sum(row["ended"] == "stopped" for row in lies),
               "own_contacts": sum(row["contacts"]["own"] for row in lies),
               "false_alarms": sum(row["fault"] == "none" and row["noticed"] is not None for row in rows)}
    print(f"{summary['noticed']} of {summary['drives']} lies noticed; {summary['arrived']} drives arrived, {summary['stopped']} stopped;"
          f" {summary['own_contacts']} contacts of the robot's own; {summary['false_alarms']} false alarms")
    benchmark.write({"rows": rows, "summary": summary}, options.json)
    return 0
