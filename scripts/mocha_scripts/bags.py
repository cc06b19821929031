"""Which bags can be drawn."""
import rosbag

from mocha_scripts.complaint import Complaint, in_a_line

TRUTH = "/fleet_simulator/ground_truth"


def check_drive(path, world, world_path):
    """Refuses a bag that is no recorded drive of the robots of this world."""
    try:
        with rosbag.Bag(path) as bag:
            first = next(bag.read_messages(TRUTH), None)
    except (OSError, rosbag.ROSBagException) as error:
        raise Complaint(f"{path}: cannot be read: {in_a_line(error)}") from error
    if first is None:
        raise Complaint(f"{path}: is no drive of the simulator, as it has no {TRUTH}; scripts/demo records such bags")
    strangers = {robot.name for robot in first.message.robots} - {robot["name"] for robot in world["robots"]}
    if strangers:
        raise Complaint(f"{path}: {' and '.join(sorted(strangers))} drove in it, and {world_path} does not know them: name the world that was driven with --world")
