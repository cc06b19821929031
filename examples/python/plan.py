#!/usr/bin/python3
"""Plans for a rover on a floor with a table, and draws every way that was looked at:  plan.py PICTURE.png"""
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import mocha_planner

RESOLUTION_M = 0.05

# As nav_msgs/OccupancyGrid: -1 unknown, 0 free, 100 occupied; the first row is the lowest one.
floor = np.zeros((120, 200), dtype=np.int8)
floor[30:80, 80:120] = 100

plan = mocha_planner.plan(floor, RESOLUTION_M, start=(1.0, 3.0, 0.0), goal=(9.0, 3.0, np.pi / 2), model="rover", parameters={"classes": 4})
print(plan.message)
for way in plan.candidates:
    print("->" if way.selected else "  ", f"cost {way.cost:.2f}: {way.outcome}")
if not plan.solved:
    sys.exit(1)
print(f"{plan.motion.length_m:.2f} m in {plan.motion.duration_s:.2f} s")

figure, (above, speeds) = plt.subplots(2, height_ratios=(3, 1), figsize=(9, 8), layout="constrained")
height, width = floor.shape
above.imshow(floor, cmap="Greys", origin="lower", extent=(0, width * RESOLUTION_M, 0, height * RESOLUTION_M))
for way in plan.candidates:
    if way.motion:
        word, width_pt = ("driven", 8) if way.selected else (way.outcome, 2)
        above.plot("x_m", "y_m", data=way.motion.sample(), lw=width_pt, label=f"cost {way.cost:.1f}, {word}")
driven = plan.motion.sample(0.02)
colours = above.scatter(driven["x_m"], driven["y_m"], c=driven["speed_mps"], s=12, zorder=2)
every = slice(None, None, 50)
above.quiver(driven["x_m"][every], driven["y_m"][every], np.cos(driven["yaw_rad"][every]), np.sin(driven["yaw_rad"][every]), scale=30, width=0.003, zorder=3)
figure.colorbar(colours, ax=above, label="speed [m/s]")
above.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
above.legend(loc="upper left")
speeds.plot("time_s", "speed_mps", data=driven, label="speed [m/s]")
speeds.plot("time_s", "yaw_rate_radps", data=driven, label="yaw rate [rad/s]")
speeds.set(xlabel="time [s]")
speeds.legend()
figure.savefig(sys.argv[1], dpi=100)
