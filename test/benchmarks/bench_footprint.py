"""What the stack of one robot takes of its computer: processor, memory, messages.

All that launch/robot.launch starts, in the corridor, beside a second robot that it hears by LCM; base and lidar are emulated, the map is known,
the robot finds its place in it. What plays its surroundings is not counted. All runs on the machine's clock, as on a robot: nodes that follow
a simulated one take a third more, for its steps, receipts and timers.
cpu_s_per_s is the processor time of all threads of a node for each second while the robot drives, standing_cpu_s_per_s the same before it is
given its goal; peak_mib the most memory that was resident, shared libraries included; share_mib what is resident at the end, with what several processes
share divided among them, so that its sum is what the computer has less. Messages count once for each subscriber.
"""
import os
import time

from benchmarks import benchmark

ROBOT, PEER = "footprint1", "footprint2"
MODEL = "waveshare_rover"
STACK = ("perception", "global_planner", "local_replanner", "trajectory_broadcaster", "trajectory_tracker", "base_driver",
         "scan_localizer", "robot_state_publisher")
SETTLE_S = 15.0  # until all has started and the place is found
STANDING_S = 10.0
PATIENCE_S = 120.0  # for nodes to start
LIMIT_S = 180.0


def add_arguments(parser):
    parser.add_argument("--world", default="config/worlds/corridor.yaml", metavar="FILE", help="of two robots (default: the corridor)")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="of noise and drift (default 1)")
    parser.add_argument("--out", default="out/footprint", metavar="DIR", help="map and logs go there (default out/footprint)")
    parser.add_argument("--json", metavar="FILE", help="write the rows and the summary there")


def write_world(source, out):
    """The world with the two robots of the measurement, and its map: the paths of both."""
    import yaml
    from benchmarks import world_map
    from mocha_scripts import worlds
    world = worlds.read_world(source)
    for robot, name in zip(world["robots"], (ROBOT, PEER)):
        robot.update(name=name, model=MODEL)
    paths = os.path.join(out, "world.yaml"), os.path.join(out, "map.yaml")
    with open(paths[0], "w") as file:
        yaml.safe_dump(world, file, default_flow_style=None, sort_keys=False)
    world_map.write(world, worlds.robot_values(MODEL)["map_resolution"], paths[1])
    return paths


class Moment:
    """What all nodes have consumed at one time."""

    def __init__(self, referee, nodes):
        self.time_s = referee.now_s
        self.cpu_s = {node.name: node.cpu_s() for node in nodes}
        self.sent = {node.name: node.sent() for node in nodes}


def rows_between(nodes, standing, driving):
    """A row for each node, from the moments at both ends of standing and of driving."""
    from benchmarks import consumption
    (still, goal), (begin, end) = standing, driving
    rows = []
    for node in nodes:
        elapsed_s = end.time_s - begin.time_s
        messages, size = consumption.traffic(begin.sent[node.name], end.sent[node.name])
        rows.append({"node": node.name, "cpu_s_per_s": round((end.cpu_s[node.name] - begin.cpu_s[node.name]) / elapsed_s, 4),
                     "peak_mib": round(node.peak_mib(), 1), "share_mib": round(node.share_mib(), 1), "messages_per_s": round(messages / elapsed_s, 1),
                     "bytes_per_s": round(size / elapsed_s),
                     "standing_cpu_s_per_s": round((goal.cpu_s[node.name] - still.cpu_s[node.name]) / (goal.time_s - still.time_s), 4)})
    return sorted(rows, key=lambda row: -row["cpu_s_per_s"])


def summarise(rows):
    totals = {key: round(sum(row[key] for row in rows), 4) for key in rows[0] if key != "node"}
    return {"nodes": len(rows), **totals}


def find_nodes(launcher):
    """All of the stack, once they are there."""
    from benchmarks import consumption
    return [consumption.node(f"/{ROBOT}/{name}") for name in STACK] + [
        consumption.node("/rosout"), consumption.master(), consumption.Node("roslaunch", launcher.pid)]


def wait_until(condition, session, launcher, limit_s=PATIENCE_S):
    """Raises RuntimeError where the session or the stack ends, or the time is over, before."""
    until = time.monotonic() + limit_s
    while not condition():
        if not session.alive() or launcher.poll() is not None or time.monotonic() > until:
            raise RuntimeError(session.last_words())
        time.sleep(0.02)


def measure(session, launcher, world):
    """The rows of one drive, and how it went."""
    import rospy
    from mocha_scripts.referee import Referee
    rospy.init_node("footprint", anonymous=True, disable_signals=True)
    referee = Referee()
    wait_until(lambda: referee.elapsed_s() >= SETTLE_S, session, launcher)
    nodes = find_nodes(launcher)
    truth = lambda: referee.robots[ROBOT]
    standing = [Moment(referee, nodes)]
    wait_until(lambda: referee.elapsed_s() >= SETTLE_S + STANDING_S, session, launcher)
    standing.append(Moment(referee, nodes))
    session.add(["rosrun", "mocha_ugv", "send_goals", world])
    wait_until(lambda: truth().path_m > 0.1, session, launcher)
    driving = [Moment(referee, nodes)]
    wait_until(lambda: truth().reached or referee.elapsed_s() > LIMIT_S, session, launcher, limit_s=2.0 * LIMIT_S)
    driving.append(Moment(referee, nodes))
    return rows_between(nodes, standing, driving), truth().as_dict()


def print_table(rows, total):
    print(f"\n{'node':26}{'cpu [s/s]':>11}{'standing':>10}{'peak [MiB]':>12}{'share [MiB]':>13}{'messages/s':>12}{'kB/s':>10}")
    for row in [*rows, {"node": "all", **total}]:
        print(f"{row['node']:26}{row['cpu_s_per_s']:11.3f}{row['standing_cpu_s_per_s']:10.3f}{row['peak_mib']:12.1f}"
              f"{row['share_mib']:13.1f}{row['messages_per_s']:12.1f}{1e-3 * row['bytes_per_s']:10.1f}")


def run(options):
    from mocha_scripts.session import Session, free_port
    os.makedirs(options.out, exist_ok=True)
    world, map_file = map(os.path.abspath, write_world(options.world, options.out))
    shared = {"robot": ROBOT, "model": MODEL, "map_file": map_file, "lcm_url": f"udpm://239.255.76.67:{free_port()}?ttl=0"}
    around = {**shared, "peer": PEER, "world": world, "seed": options.seed}
    with Session("footprint.launch", around, os.path.join(options.out, "footprint.log")) as session:
        if not session.wait_for_launch():
            raise RuntimeError(session.last_words())
        launcher = session.add(["roslaunch", os.path.join(benchmark.ROOT, "launch/robot.launch"), f"port:=/tmp/{ROBOT}_base",
                                *(f"{name}:={value}" for name, value in shared.items())])
        rows, drive = measure(session, launcher, world)
    summary = {**summarise(rows), "drive": drive}
    print_table(rows, summary)
    print(f"\n{'arrived' if drive['reached'] else 'did NOT arrive'} after {drive['time_s']} s, {drive['contacts']} contacts")
    benchmark.write({"rows": rows, "summary": summary}, options.json)
    return 0 if drive["reached"] and drive["contacts"] == 0 else 1
