#!/usr/bin/python3
"""Plans in an OctoMap of two storeys, in three dimensions:  plan_in_space.py MAP.bt"""
import sys

import mocha_planner

planner = mocha_planner.SpacePlanner(sys.argv[1], parameters={"radius": 0.3})
plan = planner.plan((2.0, 2.0, 1.2), (10.0, 8.0, 4.4))
print(plan.message)
for way in plan.candidates:
    print(f"cost {way.cost:.2f}, {way.length_m:.2f} m in {way.duration_s:.2f} s: {way.outcome}")
if not plan.solved:
    sys.exit(1)
places = plan.candidates[0].sample(0.05)["place_m"]
print(f"{len(places)} places, the highest at {max(place[2] for place in places):.2f} m")
