"""One drive of a simulated fleet: launch, watch, record, end."""
import os
import time

import rospy

from mocha_scripts.referee import Referee
from mocha_scripts.session import Session

RECORDED = ["/clock", "/tf", "/tf_static", "/fleet_simulator/ground_truth", "/fleet_simulator/contacts",
            "/fleet_simulator/world", "/fleet/promises", "/diagnostics"]
RECORDED_PER_ROBOT = ["scan", "odom", "cmd_vel", "map", "map_updates", "global_trajectory", "proposed_trajectory",
                      "committed_trajectory", "settlement", "candidates", "planner_status", "replanner_status",
                      "tracking_error", "fleet/trajectories", "predicted_obstacles", "local_trajectory", "local_markers",
                      "move_base/goal", "localization", "localized_pose"]


def drive(world, names, out, *, rate=1.0, seed=1, rviz=False, record=True, lcm_url="", emulated_bases=False, map_file="",
          limit_s=180.0, stop_at_contact=False, progress=lambda referee: None):
    """Drives the fleet of a world file. Returns (results, why): `why` says what ended the drive.

    `progress` is called now and then, and ends the drive by returning why. With a `map_file` the robots localise themselves in it. The limit is in simulated seconds. Logs, and the rosbag `drive.bag`, go
    to the directory `out`."""
    os.makedirs(out, exist_ok=True)
    arguments = {"world": os.path.abspath(world), "rate": rate, "seed": seed, "rviz": str(rviz).lower(),
                 "lcm_url": lcm_url, "emulated_bases": str(emulated_bases).lower(), "localizer": str(bool(map_file)).lower()}
    if map_file:
        arguments["map_file"] = os.path.abspath(map_file)
    with Session("fleet_sim.launch", arguments, os.path.join(out, "drive.log")) as session:
        if not session.wait_for_launch():
            return {"robots": [], "min_separation_m": None}, session.last_words()
        if record:
            topics = RECORDED + [f"/{name}/{topic}" for name in names for topic in RECORDED_PER_ROBOT]
            bag = os.path.join(out, "drive.bag")
            session.add(["rosbag", "record", "-q", "-O", bag, "-b", "512"] + topics)
        rospy.init_node("referee", anonymous=True, disable_signals=True)
        referee = Referee()
        why = None
        while not referee.finished():
            if not session.alive():
                why = session.last_words()
                break
            why = session.fault()
            if why is not None:
                break
            if referee.elapsed_s() > limit_s:
                why = f"the limit of {limit_s:.0f} simulated seconds is over"
                break
            if stop_at_contact and referee.touched():
                why = "a robot touched something"
                break
            why = progress(referee)
            if why is not None:
                break
            time.sleep(0.2)
        results = referee.results()
        if why is None:
            gave_up = any(robot["gave_up"] for robot in results["robots"])
            why = "all robots reached their goals" + (" or gave them up" if gave_up else "")
        return results, why
