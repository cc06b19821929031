#!/usr/bin/python3
"""The package as it is installed, away from its sources: robot.launch finds its nodes and the robot's description; others find its library, in plain
CMake and in a catkin package, and its Python module.

    install_space_test.py BUILD_DIRECTORY     (of which all targets have been built)
    install_space_test.py --installed PREFIX  (what is installed there)"""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

BUILD = sys.argv.pop()
INSTALLED = sys.argv[-1] == "--installed" and bool(sys.argv.pop())
EXAMPLES = pathlib.Path(__file__).resolve().parent.parent / "examples"
CATKIN_USER = """
cmake_minimum_required(VERSION 3.16)
project(user CXX)
set(CMAKE_CXX_STANDARD 17)
find_package(catkin REQUIRED COMPONENTS message_generation mocha_ugv)
add_message_files(FILES Drive.msg)
generate_messages(DEPENDENCIES mocha_ugv)
catkin_package(CATKIN_DEPENDS message_runtime mocha_ugv)
add_library(user SHARED user.cpp)
target_include_directories(user SYSTEM PRIVATE ${catkin_INCLUDE_DIRS})
target_link_libraries(user mocha_ugv::core ${catkin_LIBRARIES})
target_link_options(user PRIVATE -Wl,--no-undefined)
add_dependencies(user ${PROJECT_NAME}_generate_messages_cpp)
"""
CATKIN_USER_SOURCE = """
#include <mocha_ugv/Trajectory.h>
#include <mocha_ugv/stack/map_planner.h>
#include <user/Drive.h>

double length_m(const mocha::MapPlanner& planner, const mocha::OccupancyGrid& map, user::Drive& drive) {
  const mocha::PlanResult plan = planner.plan(map, {}, {});
  drive.trajectory = mocha_ugv::Trajectory();
  return plan.motion.length_m();
}
"""
HEADERS_USER = """
cmake_minimum_required(VERSION 3.16)
project(user CXX)
find_package(mocha_ugv REQUIRED)
add_library(user STATIC user.cpp)
target_link_libraries(user mocha_ugv::core)
"""
PACKAGE = """<package format="2"><name>user</name><version>0.1.0</version><description>Uses mocha_ugv.</description>
<maintainer email="user@mocha-ugv.example">A user</maintainer><license>BSD-3-Clause</license><buildtool_depend>catkin</buildtool_depend>
<depend>mocha_ugv</depend><build_depend>message_generation</build_depend><exec_depend>message_runtime</exec_depend></package>"""


class InstallSpace(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        directory = tempfile.TemporaryDirectory()
        cls.addClassCleanup(directory.cleanup)
        cls.directory = directory.name
        if INSTALLED:
            cls.prefix = pathlib.Path(BUILD)
        else:
            cls.run_it("cmake", "--install", BUILD)
            cls.prefix, = [path.parent for path in pathlib.Path(directory.name).rglob("env.sh")]

    @classmethod
    def run_there(cls, *command):
        """As with the package's environment, which Debian's packages need not be entered for."""
        return cls.run_it("/usr/bin/env" if INSTALLED else str(cls.prefix / "env.sh"), *command)

    @classmethod
    def run_it(cls, *command):
        clean = {"PATH": "/usr/bin:/bin", "DESTDIR": cls.directory, "ROS_HOME": cls.directory + "/ros_home"}
        result = subprocess.run(command, env=clean, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        assert result.returncode == 0, result.stdout
        return result.stdout

    def roslaunch(self, *options):
        return self.run_there("roslaunch", *options, "mocha_ugv", "robot.launch", "robot:=ugv3")

    def test_nodes_are_found(self):
        ours = {path.stem[:-len("_node")] for path in (pathlib.Path(__file__).parent.parent / "src/nodes").glob("*_node.cpp")}
        nodes = [node for node in self.roslaunch("--nodes").split() if node.startswith("/ugv3/") and node.split("/")[-1] in ours]
        self.assertGreater(len(nodes), 5)
        for node in nodes:
            self.assertIn(str(self.prefix / "lib/mocha_ugv"), self.roslaunch("--args", node))

    def test_description_is_found(self):
        self.assertIn("ugv3/laser", self.roslaunch("--dump-params"))

    def build(self, source, name, *options):
        directory = pathlib.Path(self.directory) / name
        self.run_it("cmake", "-S", str(source), "-B", str(directory), f"-DCMAKE_PREFIX_PATH={self.prefix}", "-DPYTHON_EXECUTABLE=/usr/bin/python3", *options)
        self.run_it("cmake", "--build", str(directory))
        return directory

    def test_library_is_found_without_ros(self):
        built = self.build(EXAMPLES / "cpp", "plain", "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wpedantic -Werror", "-DCMAKE_DISABLE_FIND_PACKAGE_catkin=ON")
        self.assertRegex(self.run_it(str(built / "plan")), r"^solved\n(   cost .*\n)*-> cost [\d.]+: solved\n(.*\n)*\d+\.\d+ m in \d+\.\d+ s\n")
        found = (built / "CMakeCache.txt").read_text()
        self.assertIn(f"mocha_ugv_DIR:PATH={self.prefix}", found)
        self.assertNotIn("catkin_DIR", found)

    def project(self, name, files):
        source = pathlib.Path(self.directory) / name
        for file, text in files.items():
            path = source / file
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return source

    def test_every_header_of_the_library_can_be_used(self):
        include = self.prefix / "include"
        headers = sorted(path.relative_to(include) for path in include.glob("mocha_ugv/*/**/*.h"))
        self.assertGreater(len(headers), 100)
        self.build(self.project("headers", {"CMakeLists.txt": HEADERS_USER, "user.cpp": "".join(f"#include <{header}>\n" for header in headers)}), "headers_user")

    def test_library_and_messages_are_found_by_a_catkin_package(self):
        built = self.build(self.project("user", {"CMakeLists.txt": CATKIN_USER, "user.cpp": CATKIN_USER_SOURCE, "package.xml": PACKAGE,
                                                 "msg/Drive.msg": "mocha_ugv/Trajectory trajectory\n"}), "catkin_user")
        self.assertTrue((built / "devel/lib/libuser.so").exists())

    @unittest.skipIf(INSTALLED, "lintian looks at packages")
    def test_nothing_leads_back_to_the_sources(self):
        leads_back = [path for path in self.prefix.rglob("*") if self.prefix not in path.resolve().parents]
        sources = re.compile(rf"(?<![\w}}]){re.escape(str(EXAMPLES.parent))}\b")
        leads_back += [path for path in (self.prefix / "lib/cmake").rglob("*.cmake") if sources.search(path.read_text())]
        self.assertEqual(leads_back, [])

    def test_python_module_is_found(self):
        if not list(self.prefix.glob("lib/python3/dist-packages/mocha_planner*")):
            self.skipTest("the module is not there, as pybind11 was not when it was built, or its package is not")
        picture = pathlib.Path(self.directory) / "plan.png"
        said = self.run_there("/usr/bin/python3", str(EXAMPLES / "python/plan.py"), str(picture))
        self.assertRegex(said, r"^solved\n(.*\n)*-> cost")
        self.assertEqual(picture.read_bytes()[:4], b"\x89PNG")


if __name__ == "__main__":
    unittest.main()
