#!/usr/bin/python3
"""Checks by reading the sources that the house stands: includes point down only, rooms and files stay small, libraries stay in their
places, the core has no clock and prints nothing, parameters in code and in config/ are the same, and those marked as live are served.
Each rule is also tried on a planted fault."""
import collections
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
          ["stack"],
          ["ros_bridge", "python"],
          ["nodes", "rviz_panel"]]
LEVEL = {folder: level for level, folders in enumerate(LEVELS) for folder in folders}
# The same for the rooms of a folder.
ROOM_LEVELS = {"planning": [["candidates", "passing"], ["global", "local", "maneuvers", "space"], ["executive", "replanner"]]}
ROOM_LEVEL = {f"{folder}/{room}": level for folder, levels in ROOM_LEVELS.items() for level, rooms in enumerate(levels) for room in rooms}
WITH_ROS = {"ros_bridge", "nodes", "rviz_panel"}

# Every room of src/, and what belongs there.
ROOMS = {
    "base": "The serial line of a robot's base: protocol, odometry, watchdog.",
    "camouflage": "Motion camouflage: reference points, and the map from one variable a knot to knots.",
    "config": "Named values with units and ranges, read from YAML.",
    "control": "What follows a committed trajectory: feedback, limits of commands, the tracker's modes.",
    "fleet/protocol": "What robots say to each other and what follows from it: commitments, peers, clocks, passing messages, emergency stops.",
    "fleet/storage": "What a robot remembers over a restart.",
    "fleet/wire": "Messages as bytes: codecs, sealed datagrams.",
    "nodes": "One thin file for each node.",
    "optimization": "How good a motion is: one penalty a file, their sum, and its minimum.",
    "perception/localization": "Where a robot is in a saved map.",
    "perception/mapping": "Beams into an occupancy map; maps as files.",
    "perception/monitoring": "Which sensor lies, and by how much.",
    "perception/pose_graph": "Maps from drives: keyframes, what they know of each other, loops, and the poses where all agree.",
    "perception/sensor": "What a sensor measures: beams, scans, clouds.",
    "perception/tracking": "What moves: hits told from the map, detections, tracks.",
    "planning/candidates": "The one pipeline of global and local planning: start maneuvers, optimise, certify, select; what candidates keep from.",
    "planning/executive": "Goals, their queue, and what a robot does where others have to pass.",
    "planning/global": "The path to the goal: seeds of several classes, and the rules by which the pipeline makes plans of them.",
    "planning/local": "The detour in space-time around what moves, and back to the plan.",
    "planning/maneuvers": "One maneuver a file: each only generates candidate motions.",
    "planning/passing": "In which order robots that stand in each other's way pass, and by which places.",
    "planning/replanner": "Which maneuver is driven, proved how, promised how.",
    "planning/space": "The same in three dimensions: paths of several classes, optimised, certified, the cheapest selected.",
    "python": "Planning from Python: what is handed over, checked, and handed back.",
    "ros_bridge/inputs": "What is heard from topics and services, checked, until a node asks for it.",
    "ros_bridge/messages": "Conversions between messages and the core's types.",
    "ros_bridge/network": "The fleet's messages on topics or LCM.",
    "ros_bridge/outputs": "What nodes publish.",
    "ros_bridge/runtime": "What every node is made of: parameters, loops, names, lockstep with the simulator.",
    "ros_bridge/rviz": "Drawings for rviz.",
    "rviz_panel": "The fleet panel in rviz: what robots do and why, and what they are told.",
    "safety": "What may be driven: one proof a file.",
    "simulation": "Vehicles, lidars, bases, networks and moving things without a robot.",
    "stack": "The brain of one robot without ROS: its planners and promises wired, and what their parameters must keep to work together.",
    "topology/paths": "The cheapest paths of several homotopy classes, and shortcuts that keep the class.",
    "topology/roadmaps": "Graphs that stand for the free space.",
    "topology/signatures": "What tells homotopy classes apart, and how long a path of one is at least.",
    "topology/space": "What stands in a map in space, shrunk to curves and thinned to ways, and the paths of several classes past it.",
    "topology/space_time": "The same with time as an axis.",
    "topology/static_map": "What stands, as searches for paths see it.",
    "trajectory": "What a motion is: polynomials, MINCO, timed phases, braking, separation.",
    "world": "Geometry: obstacles, grids, footprints, robot models, world files.",
    "world/moving": "What moves, where it will be, and what it occupies in space and time.",
    "world/distances": "How far it is to what a grid holds: made, and repaired where it changes.",
}
MOST_FILES = 40  # in a room
MOST_LINES = 320  # of a source

# Headers of a library, and the paths below src/ that may include them.
LIBRARIES = {
    "ROS": (r"(ros|rosbag|rosconsole|tf2\w*|actionlib|message_filters|dynamic_reconfigure|laser_geometry|diagnostic_\w+"
            r"|xmlrpcpp|\w+_msgs|std_srvs|mocha_ugv)/|XmlRpc", r"(ros_bridge|nodes|rviz_panel)/"),
    "Qt and rviz": (r"Q[A-Z]\w+$|rviz/|pluginlib/", r"rviz_panel/"),
    "pybind11": (r"pybind11/", r"python/"),
    "OctoMap": (r"octomap", r"perception/"),
    "libpng": (r"png\.h", r"perception/mapping/png_image\.cpp"),
    "CGAL": (r"CGAL/", r"topology/roadmaps/apollonius_roadmap\.cpp"),
    "Ceres": (r"ceres/", r"perception/localization/scan_matcher\.cpp|perception/pose_graph/graph_optimizer\.cpp"),
    "nanoflann": (r"nanoflann", r"perception/pose_graph/surfel_map\.cpp"),
    "LCM": (r"(mocha_)?lcm/", r"fleet/wire/wire_format\.|ros_bridge/network/lcm_channel\."),
    "libsodium": (r"sodium", r"fleet/wire/fleet_key\.cpp"),
    "Boost.Asio": (r"boost/asio", r"base/serial_port\."),
    "nlohmann-json": (r"nlohmann/", r"base/waveshare_protocol\.cpp|simulation/base_emulator\."),
}
NOT_IN_CORE = {
    "reads a clock": r"_clock::now|\bgettimeofday\b|\bclock_gettime\b|\btime\(\s*(nullptr|NULL|0)\s*\)|ros::(Wall)?Time",
    "sleeps": r"\bsleep(_for|_until)?\s*\(|\bu?sleep\s*\(",
    "prints": r"std::(cout|cerr|clog)|\bf?printf\s*\(|\bputs\s*\(|\bROS_(DEBUG|INFO|WARN|ERROR|FATAL)",
    "draws numbers without a seed": r"random_device|\bs?rand\s*\(",
}
BRINGS_CLOCK = ("reads a clock", "python/steady_now.cpp")  # as nodes do
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]', re.MULTILINE)
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
READ = re.compile(r"\.(?:number|integer|flag|text)\(([^()]*)\)")
NEIGHBOURS = re.compile(r'neighbour_parameters\("(\w+)"\)\s*\.(?:number|integer|flag|text)\("(\w+)"\)')
SCHEMA = re.compile(r'read_parameters\([^;]*?"(\w+)"\s*\)')


def sources(root):
    """(path below src/, text without comments) of every source and header."""
    base = root / "src"
    for path in sorted(base.rglob("*")):
        if path.suffix in (".h", ".cpp"):
            yield path.relative_to(base).as_posix(), COMMENT.sub("", path.read_text())


def room_of(path):
    return path.rpartition("/")[0]


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
            own, other = room_of(path), room_of(header)
            if quote == '"' and own != other and ROOM_LEVEL.get(other, -1) >= ROOM_LEVEL.get(own, 9):
                yield f"{path}: {own} may not include {other} ({header})"
            for library, (headers, places) in LIBRARIES.items():
                if quote == "<" and re.match(headers, header) and not re.match(places, path):
                    yield f"{path}: {library} has no business here ({header})"


def room_faults(root):
    sizes = collections.Counter()
    for path in (path for path in sorted((root / "src").rglob("*")) if path.is_file()):
        name = path.relative_to(root / "src").as_posix()
        room = room_of(name)
        sizes[room] += 1
        if room not in ROOMS:
            yield f"{name}: no sentence in ROOMS says what belongs into {room}/"
        lines = len(path.read_text().splitlines())
        if lines > MOST_LINES:
            yield f"{name}: has {lines} lines, allowed are {MOST_LINES}"
    for room, files in sorted(sizes.items()):
        if files > MOST_FILES:
            yield f"{room}/: has {files} files, allowed are {MOST_FILES}"
    readme = (root / "README.md").read_text() if (root / "README.md").exists() else ""
    for folder in sorted({room.split("/")[0] for room in sizes}):
        if f"`src/{folder}/`" not in readme:
            yield f"README.md: does not say what is in `src/{folder}/`"


def core_faults(root):
    for path, text in sources(root):
        if path.split("/")[0] in WITH_ROS:
            continue
        for what, pattern in NOT_IN_CORE.items():
            found = re.search(pattern, text)
            if found and (what, path) != BRINGS_CLOCK:
                yield f"{path}: the core never {what} ({found.group()})"


def read_names(text):
    return {name for arguments in READ.findall(text) for name in re.findall(r'"(\w+)"', arguments)}


def parameter_faults(root):
    schemas = {path.stem: {name for name, entry in yaml.safe_load(path.read_text()).items() if "gone" not in entry}
               for path in (root / "config").glob("*.yaml")}
    read = {schema: set() for schema in schemas}
    for path, text in sources(root):
        for schema, name in NEIGHBOURS.findall(text):
            if name not in schemas.get(schema, set()):
                yield f"{path}: `{name}` is not declared in config/{schema}.yaml"
        names = read_names(NEIGHBOURS.sub("", text))
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
    return [*include_faults(root), *room_faults(root), *core_faults(root), *parameter_faults(root),
            *live_faults(root)]


README = " ".join(f"`src/{folder}/`" for folder in LEVEL)


def plant(root, files):
    for name, content in files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(content)


class Architecture(unittest.TestCase):
    def test_this_package(self):
        self.assertEqual(all_faults(ROOT), [])

    def test_planted_faults_are_found(self):
        plants = [
            ("src/world/a.h", '#include "safety/b.h"', "world may not include safety"),
            ("src/fleet/wire/a.cpp", '#include "perception/sensor/b.h"', "fleet may not include perception"),
            ("src/trajectory/a.h", '#include "config/b.h"', "trajectory may not include config"),
            ("src/planning/local/a.h", '#include "stack/b.h"', "planning may not include stack"),
            ("src/planning/local/a.h", '#include "b.h"', "not named by its path"),
            ("src/planning/local/a.h", '#include "planning/global/b.h"', "planning/local may not include planning/global"),
            ("src/planning/candidates/a.h", '#include "planning/local/b.h"', "planning/candidates may not include planning/local"),
            ("src/planning/executive/a.h", '#include "planning/replanner/b.h"', "planning/executive may not include planning/replanner"),
            ("src/extras/a.h", "", "has no level"),
            ("src/planning/a.h", "", "says what belongs into planning/"),
            ("src/world/a.h", MOST_LINES * "\n" + "int a;", "has 321 lines"),
            ("README.md", "`src/world/`", "does not say what is in `src/control/`"),
            ("src/control/a.h", "#include <geometry_msgs/Twist.h>", "ROS has no business"),
            ("src/planning/local/a.h", "#include <mocha_ugv/Trajectory.h>", "ROS has no business"),
            ("src/ros_bridge/inputs/a.h", "#include <octomap/OcTree.h>", "OctoMap has no business"),
            ("src/stack/a.h", "#include <pybind11/numpy.h>", "pybind11 has no business"),
            ("src/python/a.h", '#include "ros_bridge/messages/b.h"', "python may not include ros_bridge"),
            ("src/perception/mapping/map_image.cpp", "#include <png.h>", "libpng has no business"),
            ("src/topology/roadmaps/apollonius_roadmap.h", "#include <CGAL/Apollonius_graph_2.h>", "CGAL has no business"),
            ("src/fleet/protocol/commitment_protocol.h", "#include <lcm/lcm-cpp.hpp>", "LCM has no business"),
            ("src/base/a.h", "#include <boost/asio/serial_port.hpp>", "Boost.Asio has no business"),
            ("src/ros_bridge/inputs/a.h", "#include <nlohmann/json.hpp>", "nlohmann-json has no business"),
            ("src/world/a.cpp", "auto t = std::chrono::steady_clock::now();", "reads a clock"),
            ("src/safety/a.cpp", 'std::cout << "proved";', "prints"),
            ("src/safety/a.cpp", 'printf("proved");', "prints"),
            ("src/base/a.cpp", "std::this_thread::sleep_for(pause);", "sleeps"),
            ("src/simulation/a.cpp", "std::random_device seed;", "without a seed"),
            ("src/nodes/a_node.cpp", 'read_parameters(ros::NodeHandle("~"), "a"); values.number("gian")', "`gian` is not"),
            ("src/planning/local/a.cpp", 'values.number("gian")', "no schema"),
            ("src/nodes/a_node.cpp", 'neighbour_parameters("a").number("gian")', "`gian` is not declared in config/a.yaml"),
            ("config/a.yaml", 'gain: {gone: "it follows from size"}', "no schema"),
            ("config/a.yaml", "unused: {default: 1.0}", "`unused` is read nowhere"),
            ("config/a.yaml", "gain: {default: 1.0, live: true}", "does not serve them"),
            ("src/nodes/a_node.cpp", "LiveParameters parameters_;", "marks none"),
        ]
        for path, text, complaint in plants:
            with self.subTest(path=path, text=text), tempfile.TemporaryDirectory() as directory:
                root = pathlib.Path(directory)
                plant(root, {"config/a.yaml": "gain: {default: 1.0}", "src/control/reader.cpp": '// values.number("old")\nvalues.number("gain")',
                             "README.md": README, path: text})
                self.assertIn(complaint, "\n".join(all_faults(root)))

    def test_a_crowded_room_is_found(self):
        with tempfile.TemporaryDirectory() as directory:
            root = pathlib.Path(directory)
            plant(root, {"README.md": README, **{f"src/world/a{i}.h": "" for i in range(MOST_FILES)}})
            self.assertEqual(all_faults(root), [])
            plant(root, {"src/world/b.h": ""})
            self.assertEqual(all_faults(root), ["world/: has 41 files, allowed are 40"])

    def test_a_sound_tree_passes(self):
        with tempfile.TemporaryDirectory() as directory:
            root = pathlib.Path(directory)
            plant(root, {"README.md": README,
                         "config/a.yaml": "gain: {default: 1.0, live: true}\n",
                         "src/planning/replanner/a.cpp": '#include "fleet/protocol/b.h"\n#include "planning/replanner/c.h"\n'
                                                         '#include "planning/local/d.h"\nstd::snprintf(s, n, "x"); // sleep()',
                         "src/fleet/wire/wire_format.cpp": "#include <lcm/lcm-cpp.hpp>\n",
                         "src/topology/roadmaps/apollonius_roadmap.cpp": "#include <CGAL/Apollonius_graph_2.h>",
                         "src/nodes/a_node.cpp": '#include <ros/ros.h>\n#include "ros_bridge/runtime/x.h"\n'
                                                 'read_parameters(ros::NodeHandle("~"), "a").number("gain");'
                                                 'LiveParameters parameters_;'})
            self.assertEqual(all_faults(root), [])


if __name__ == "__main__":
    unittest.main()
