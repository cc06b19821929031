#!/usr/bin/python3
"""What scripts/robot_description says of a robot agrees with its model in config/robots: the lidar stands where the model has it, and what
is drawn fills the footprint."""
import importlib.machinery
import math
import pathlib
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

import yaml

ROOT = pathlib.Path(__file__).resolve().parent.parent
MODELS = sorted(path.stem for path in (ROOT / "config/robots").glob("*.yaml"))
MARGIN_M = 0.03  # of the footprint beyond what is drawn, at most


def described(*arguments):
    return subprocess.run([ROOT / "scripts/robot_description", *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def description(model):
    return ElementTree.fromstring(described(model, "ugv7").stdout)


def values_of(model):
    defaults = yaml.safe_load((ROOT / "config/robot.yaml").read_text())
    own = yaml.safe_load((ROOT / f"config/robots/{model}.yaml").read_text()) or {}
    return {**{name: entry["default"] for name, entry in defaults.items() if "gone" not in entry}, **own}


def numbers(text):
    return [float(word) for word in text.split()]


def half_extents(visual):
    """Half the size along and across of a shape whose axes are those of base_link, or that lies across."""
    shape, roll = visual.find("geometry")[0], numbers(visual.find("origin").get("rpy", "0 0 0"))[0]
    if shape.tag == "box":
        return [0.5 * size for size in numbers(shape.get("size"))[:2]]
    radius, half_length = float(shape.get("radius")), 0.5 * float(shape.get("length"))
    if abs(roll) < 1e-3:
        return [radius, radius]
    assert abs(abs(roll) - 0.5 * math.pi) < 1e-3, "a cylinder stands or lies across"
    return [radius, half_length]


def extents(link):
    """How far what is drawn reaches from base_link, along and across."""
    reach = [0.0, 0.0]
    for visual in link.findall("visual"):
        origin = numbers(visual.find("origin").get("xyz"))
        for axis, half in enumerate(half_extents(visual)):
            reach[axis] = max(reach[axis], abs(origin[axis]) + half)
    return reach


class RobotDescription(unittest.TestCase):
    def test_the_lidar_stands_where_the_model_has_it(self):
        for model in MODELS:
            with self.subTest(model=model):
                values = values_of(model)
                joint, = description(model).findall("joint")
                self.assertEqual((joint.find("parent").get("link"), joint.find("child").get("link")), ("ugv7/base_link", "ugv7/laser"))
                self.assertEqual(numbers(joint.find("origin").get("xyz")), [values["lidar_x"], values["lidar_y"], values["lidar_z"]])
                self.assertEqual(numbers(joint.find("origin").get("rpy")), [0.0, 0.0, values["lidar_yaw"]])

    def test_what_is_drawn_fills_the_footprint(self):
        for model in MODELS:
            with self.subTest(model=model):
                values = values_of(model)
                footprint = [0.5 * values["footprint_length"], 0.5 * values["footprint_width"]]
                if values["footprint"] == "disc":
                    footprint = 2 * [values["footprint_radius"]]
                for size, drawn in zip(footprint, extents(description(model).find("link[@name='ugv7/base_link']"))):
                    self.assertLessEqual(drawn, size + 1e-9)
                    self.assertGreaterEqual(drawn, size - MARGIN_M)

    def test_a_polygon_is_drawn_by_its_sides(self):
        script = importlib.machinery.SourceFileLoader("robot_description", str(ROOT / "scripts/robot_description")).load_module()
        values = {**values_of("rover"), "footprint": "polygon", "footprint_corners": "[[0.3, 0.0], [-0.1, 0.2], [-0.1, -0.2]]"}
        drawn = script.bare("wedge", values).findall("link[@name='base_link']/visual")[:-1]  # without what says which way it looks
        self.assertEqual(len(drawn), 3)
        for visual, (x, y) in zip(drawn, [(0.1, 0.1), (-0.1, 0.0), (0.1, -0.1)]):
            for number, expected in zip(numbers(visual.find("origin").get("xyz")), (x, y)):
                self.assertAlmostEqual(number, expected)
        self.assertAlmostEqual(half_extents(drawn[1])[0], 0.2)
        self.assertAlmostEqual(numbers(drawn[1].find("origin").get("rpy"))[2], -0.5 * math.pi)

    def test_files_in_urdf_agree_with_their_models(self):
        """As they are, too: other programs may read them."""
        for path in sorted((ROOT / "urdf").glob("*.urdf")):
            with self.subTest(path=path.name):
                values = values_of(path.stem)
                origin = ElementTree.parse(path).find("joint[@name='lidar_mount']/origin")
                self.assertEqual(numbers(origin.get("xyz")), [values["lidar_x"], values["lidar_y"], values["lidar_z"]])
                self.assertEqual(numbers(origin.get("rpy"))[2], values["lidar_yaw"])

    def test_a_model_of_ones_own_is_described_by_what_is_beside_it(self):
        with tempfile.TemporaryDirectory() as folder:
            model = pathlib.Path(folder) / "mine.yaml"
            model.write_text("{lidar_x: 0.07, footprint_radius: 0.2}")
            bare = ElementTree.fromstring(described(str(model), "ugv7").stdout)
            self.assertEqual(bare.get("name"), "mine")
            self.assertEqual(numbers(bare.find("joint[@name='lidar_mount']/origin").get("xyz"))[0], 0.07)
            model.with_suffix(".urdf").write_text((ROOT / "urdf/waveshare_rover.urdf").read_text())
            self.assertGreater(len(ElementTree.fromstring(described(str(model), "ugv7").stdout)), len(bare))
        self.assertIn("mine.yaml", described(str(model), "ugv7").stderr)

    def test_values_of_its_own_are_drawn_instead_of_the_models(self):
        own = ElementTree.fromstring(described("waveshare_rover", "ugv7", "{footprint: disc, footprint_radius: 0.4}").stdout)
        self.assertEqual(extents(own.find("link[@name='ugv7/base_link']")), [0.4, 0.4])
        moved = ElementTree.fromstring(described("waveshare_rover", "ugv7", "{lidar_x: 0.05}").stdout)
        self.assertGreater(len(moved), len(own))
        self.assertEqual(numbers(moved.find("joint[@name='lidar_mount']/origin").get("xyz"))[0], 0.05)

    def test_says_which_model_it_does_not_know(self):
        result = described("no_such_robot", "ugv7")
        self.assertEqual((result.returncode, result.stdout), (1, ""))
        self.assertIn("config/robots/no_such_robot.yaml", result.stderr)
        self.assertEqual(described("rover").returncode, 2)


if __name__ == "__main__":
    unittest.main()
