#!/usr/bin/python3
"""Records the bags of this folder anew, with the simulator: needed where a message has changed.

    test/bags/record.py NAME       corridor or crossing

Two rovers drive, through serial lines; of the first one the bag holds what its lidar, its base and its fleet tell it, its goal, what
it committed to, and the truth about where it was. The corridor's map is config/maps/corridor.bt; that of the crossing, crossing.bt, is
what one rover saved after it had mapped the hall."""
import os
import pathlib
import sys
import tempfile

import rosbag

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
ROBOT = "/ugv1/"
INPUTS = ["scan", "odom", "fleet/trajectories", "committed_trajectory", "move_base/goal"]
WORLDS = {"corridor": ROOT / "config/worlds/corridor_rovers.yaml", "crossing": ROOT / "test/worlds/crossing_rovers.yaml"}
MAPS = {"corridor": ROOT / "config/maps/corridor.bt", "crossing": ROOT / "test/bags/crossing.bt"}
SEED = 3


def keep_own_odometry(message):
    message.transforms = [t for t in message.transforms if t.header.frame_id == "ugv1/odom" or t.header.frame_id == "ugv1/base_link"]
    return message if message.transforms else None


def keep_own_truth(message):
    message.robots = [robot for robot in message.robots if robot.name == "ugv1"]
    return message if message.header.stamp.nsecs % 100000000 == 0 else None


def sift(source, target):
    """Copies what a replay needs."""
    topics = [ROBOT + topic for topic in INPUTS] + ["/tf", "/tf_static", "/fleet_simulator/ground_truth"]
    with rosbag.Bag(source) as whole, rosbag.Bag(target, "w", compression="bz2") as part:
        for topic, message, time in whole.read_messages(topics=topics):
            if topic.startswith("/tf"):
                message = keep_own_odometry(message)
            elif topic.endswith("ground_truth"):
                message = keep_own_truth(message)
            if message is not None:
                part.write(topic, message, time)


def main(name):
    from mocha_scripts import drive, referee
    with tempfile.TemporaryDirectory() as out:
        results, why = drive.drive(str(WORLDS[name]), ["ugv1", "ugv2"], out, rate=0.0, seed=SEED, emulated_bases=True,
                                   map_file=str(MAPS[name]), limit_s=120.0)
        print(why + "\n" + referee.table(results))
        if not referee.succeeded(results):
            return 1
        sift(os.path.join(out, "drive.bag"), str(ROOT / f"test/bags/{name}.bag"))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
