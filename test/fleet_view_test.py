"""What rviz shows of a world."""
import os
import sys
import tempfile
import unittest

import yaml

ROOT = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "scripts"))
from mocha_scripts import rviz_view  # noqa: E402


class RvizView(unittest.TestCase):
    def test_holds_all_of_a_world(self):
        for bounds in ({"min": [-2.0, 1.0], "max": [98.0, 101.0]}, {"min": [0.0, -4.0], "max": [24.0, 4.0]}):
            x_m, y_m, scale = rviz_view.view_of(bounds)
            for axis, centre_m in enumerate((x_m, y_m)):
                half_m = 0.5 * rviz_view.SHOWN_PX[axis] / scale
                self.assertLessEqual(centre_m - half_m, bounds["min"][axis] + 1e-9)
                self.assertGreaterEqual(centre_m + half_m, bounds["max"][axis] - 1e-9)

    def test_changes_nothing_but_the_view(self):
        with tempfile.NamedTemporaryFile() as file:
            rviz_view.write(os.path.join(ROOT, "config/worlds/building.yaml"), file.name)
            with open(file.name) as written, open(rviz_view.CONFIG) as shipped:
                written, shipped = yaml.safe_load(written), yaml.safe_load(shipped)
        view = written["Visualization Manager"]["Views"]["Current"]
        self.assertLess(view["Scale"], 6.0)
        view.update({key: shipped["Visualization Manager"]["Views"]["Current"][key] for key in ("X", "Y", "Scale")})
        self.assertEqual(written, shipped)

    def test_leaves_the_view_where_the_bounds_are_none(self):
        with open(rviz_view.CONFIG) as shipped:
            shipped = yaml.safe_load(shipped)
        for bounds in ("", "bounds: 3", "bounds: {min: [0, 0]}", "bounds: {min: [0, 0], max: [0, 9]}", "bounds: {min: [a, 0], max: [1, 9]}",
                       "bounds: {min: [0], max: [9]}", "bounds: {min: [1, 1], max: [0, 0]}", "bounds: {min: [0, 0], max: [.nan, 1]}",
                       "bounds: {min: [0, 0], max: [.inf, 1]}"):
            with tempfile.NamedTemporaryFile("w") as world, tempfile.NamedTemporaryFile() as file:
                world.write(f"robots: []\n{bounds}\n")
                world.flush()
                rviz_view.write(world.name, file.name)
                with open(file.name) as written:
                    self.assertEqual(yaml.safe_load(written), shipped, bounds)


if __name__ == "__main__":
    unittest.main()
