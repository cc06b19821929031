#!/usr/bin/python3
"""Checks by reading the sources that the house stands: includes point down only, libraries stay in their places, the core has
no clock and prints nothing, parameters in code and in config/ are the same, and those marked as live are served. Each rule is
also tried on a planted fault."""
import pathlib
import re
import tempfile
import unittest

import yaml

ROOT = pathlib.Path(__file__).resolve().parent.parent

# Folders of src/ from the bottom to the top. Those on one level do not include each other.
LEVELS = [["config", "trajectory"],
          ["world"],
          ["camouflage", "safety", "perception", "fleet", "control", "base", "simulation"],
          ["optimization", "topology"],
          ["planning"],
          ["ros"],
          ["nodes"]]
LEVEL = {folder: level for level, folders in enumerate(LEVELS) for folder in folders}
WITH_ROS = {"ros", "nodes"}

# Headers of a library, and the paths below src/ that may include them.
LIBRARIES = {
    "ROS": (r"(ros|rosbag|rosconsole|tf2\w*|actionlib|message_filters|dynamic_reconfigure|laser_geometry|diagnostic_\w+"
            r"|xmlrpcpp|\w+_msgs|std_srvs|mocha_ugv)/|XmlRpc", r"(ros|nodes)/"),
    "OctoMap": (r"octomap", r"perception/"),
    "CGAL": (r"CGAL/", r"topology/apollonius_roadmap\.cpp"),
    "Ceres": (r"ceres/", r"perception/scan_matcher\.cpp"),
    "LCM": (r"(mocha_)?lcm/", r"fleet/wire_format\.|nodes/lcm_channel\."),
    "libsodium": (r"sodium", r"fleet/fleet_key\.cpp"),
    "Boost.Asio": (r"boost/asio", r"base/serial_port\."),
    "nlohmann-json": (r"nlohmann/", r"base/waveshare_protocol\.cpp|simulation/base_emulator\."),
}
NOT_IN_CORE = {
    "reads a clock": r"_clock::now|\bgettimeofday\b|\bclock_gettime\b|\btime\(\s*(nullptr|NULL|0)\s*\)|ros::(Wall)?Time",
    "sleeps": r"\bsleep(_for|_until)?\s*\(|\bu?sleep\s*\(",
    "prints": r"std::(cout|cerr|clog)|\bf?printf\s*\(|\bputs\s*\(|\bROS_(DEBUG|INFO|WARN|ERROR|FATAL)",
    "draws numbers without a seed": r"random_device|\bs?rand\s*\(",
}
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]', re.MULTILINE)
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
READ = re.compile(r"\.(?:number|integer|flag|text)\(([^()]*)\)")
SCHEMA = re.compile(r'read_parameters\([^;]*?"(\w+)"\s*\)')


def sources(root):
    """(path below src/, text without comments) of every source and header."""
    base = root / "src"
    for path in sorted(base.rglob("*")):
        if path.suffix in (".h", ".cpp"):
            yield path.relative_to(base).as_posix(), COMMENT.sub("", path.read_text())


def include_faults(root):
    for path, text in sources(root):
        folder = path.split("/")[0]
        if folder not in LEVEL:
            yield f"{path}: the folder {folder} has no level"
            continue
        for quote, header in INCLUDE.findall(text):
            target = header.split("/")[0]
            if quote == '"' and target not in LEVEL:
                yield f"{path}: {header} is not named by its path from src/"
            elif quote == '"' and target != folder and LEVEL[target] >= LEVEL[folder]:
                yield f"{path}: {folder} may not include {target} ({header})"
            for library, (headers, places) in LIBRARIES.items():
                if quote == "<" and re.match(headers, header) and not re.match(places, path):
                    yield f"{path}: {library} has no business here ({header})"


def core_faults(root):
    for path, text in sources(root):
        if path.split("/")[0] in WITH_ROS:
            continue
        for what, pattern in NOT_IN_CORE.items():
            found = re.search(pattern, text)
            if found:
                yield f"{path}: the core never {what} ({found.group()})"


def read_names(text):
    return {name for arguments in READ.findall(text) for name in re.findall(r'"(\w+)"', arguments)}


def parameter_faults(root):
    schemas = {path.stem: set(yaml.safe_load(path.read_text())) for path in (root / "config").glob("*.yaml")}
    read = {schema: set() for schema in schemas}
    for path, text in sources(root):
        names = read_names(text)
        named = SCHEMA.search(text) if path.startswith("nodes/") else None
        # A file of the core may serve several nodes: its parameters stand together in at least one schema.
        fitting = [named.group(1)] if named else [schema for schema in schemas if names <= schemas[schema]]
        if names and not fitting:
            yield f"{path}: no schema in config/ declares all of {', '.join(sorted(names))}"
        for schema in fitting:
            for name in sorted(names - schemas.get(schema, set())):
                yield f"{path}: `{name}` is not declared in config/{schema}.yaml"
            read.get(schema, set()).update(names)
    for schema, names in schemas.items():
        for name in sorted(names - read[schema]):
            yield f"config/{schema}.yaml: `{name}` is read nowhere"


def live_faults(root):
    for path in sorted((root / "config").glob("*.yaml")):
        marked = any(entry.get("live") for entry in yaml.safe_load(path.read_text()).values())
        node = root / "src" / "nodes" / f"{path.stem}_node.cpp"
        served = node.exists() and "LiveParameters" in COMMENT.sub("", node.read_text())
        if marked and not served:
            yield f"config/{path.name}: marks parameters as live, but its node does not serve them"
        if served and not marked:
            yield f"nodes/{node.name}: serves live parameters, but config/{path.name} marks none"


def all_faults(root):
    return [*include_faults(root), *core_faults(root), *parameter_faults(root), *live_faults(root)]


class Architecture(unittest.TestCase):
    def test_this_package(self):
        self.assertEqual(all_faults(ROOT), [])

    def test_planted_faults_are_found(self):
        plants = [
            ("src/world/a.h", '#include "safety/b.h"', "world may not include safety"),
            ("src/fleet/a.cpp", '#include "perception/b.h"', "fleet may not include perception"),
            ("src/trajectory/a.h", '#include "config/b.h"', "trajectory may not include config"),
            ("src/planning/a.h", '#include "b.h"', "not named by its path"),
            ("src/extras/a.h", "", "has no level"),
            ("src/control/a.h", "#include <geometry_msgs/Twist.h>", "ROS has no business"),
            ("src/planning/a.h", "#include <mocha_ugv/Trajectory.h>", "ROS has no business"),
            ("src/ros/a.h", "#include <octomap/OcTree.h>", "OctoMap has no business"),
            ("src/topology/apollonius_roadmap.h", "#include <CGAL/Apollonius_graph_2.h>", "CGAL has no business"),
            ("src/fleet/commitment.h", "#include <lcm/lcm-cpp.hpp>", "LCM has no business"),
            ("src/base/a.h", "#include <boost/asio/serial_port.hpp>", "Boost.Asio has no business"),
            ("src/ros/a.h", "#include <nlohmann/json.hpp>", "nlohmann-json has no business"),
            ("src/world/a.cpp", "auto t = std::chrono::steady_clock::now();", "reads a clock"),
            ("src/safety/a.cpp", 'std::cout << "proved";', "prints"),
            ("src/safety/a.cpp", 'printf("proved");', "prints"),
            ("src/base/a.cpp", "std::this_thread::sleep_for(pause);", "sleeps"),
            ("src/simulation/a.cpp", "std::random_device seed;", "without a seed"),
            ("src/nodes/a_node.cpp", 'read_parameters(ros::NodeHandle("~"), "a"); values.number("gian")', "`gian` is not"),
            ("src/planning/a.cpp", 'values.number("gian")', "no schema"),
            ("config/a.yaml", "unused: {default: 1.0}", "`unused` is read nowhere"),
            ("config/a.yaml", "gain: {default: 1.0, live: true}", "does not serve them"),
            ("src/nodes/a_node.cpp", "LiveParameters parameters_;", "marks none"),
        ]
        for path, text, complaint in plants:
            with self.subTest(path=path, text=text), tempfile.TemporaryDirectory() as directory:
                root = pathlib.Path(directory)
                files = {"config/a.yaml": "gain: {default: 1.0}",
                         "src/control/reader.cpp": '// values.number("old")\nvalues.number("gain")'}
                for name, content in {**files, path: text}.items():
                    (root / name).parent.mkdir(parents=True, exist_ok=True)
                    (root / name).write_text(content)
                self.assertIn(complaint, "\n".join(all_faults(root)))

    def test_a_sound_tree_passes(self):
        with tempfile.TemporaryDirectory() as directory:
            root = pathlib.Path(directory)
            for name, content in {"config/a.yaml": "gain: {default: 1.0, live: true}\n",
                                  "src/planning/a.cpp": '#include "fleet/b.h"\nstd::snprintf(s, n, "x"); // sleep()',
                                  "src/fleet/wire_format.cpp": "#include <lcm/lcm-cpp.hpp>\n",
                                  "src/topology/apollonius_roadmap.cpp": "#include <CGAL/Apollonius_graph_2.h>",
                                  "src/nodes/a_node.cpp": '#include <ros/ros.h>\n#include "ros/x.h"\n'
                                                          'read_parameters(ros::NodeHandle("~"), "a").number("gain");'
                                                          'LiveParameters parameters_;'}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(content)
            self.assertEqual(all_faults(root), [])


if __name__ == "__main__":
    unittest.main()
