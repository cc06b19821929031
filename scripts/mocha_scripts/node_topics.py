"""The topics of each node and the transforms that nodes publish, read from the sources: the calls that advertise and subscribe in src/nodes/
and in what these use of src/ros_bridge/. Names are relative to the robot's namespace. What dynamic_reconfigure adds for live parameters is
left out."""
import collections
import pathlib
import re

Topics = collections.namedtuple("Topics", "writes reads services latched")  # of a node: types by name, such as nav_msgs/Odometry; names

COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
BRIDGE = re.compile(r'#include "(ros_bridge/[^"]+)\.h"')
# What is called, the type in <>, and the first argument: a name, or one behind a variable.
CALL = re.compile(r'(?P<private>NodeHandle\("~"\)\s*\.\s*|\.\s*)(?P<call>advertise|subscribe|advertiseService)\s*(?:<(?P<type>[\w:]+)>)?'
                  r'\(\s*(?:(?P<prefix>\w+) \+ )?"(?P<name>[^"]+)"')
METHOD = re.compile(r"[^;]*?&\w+::(\w+)")
LATCHED = re.compile(r",\s*\w+,\s*true\)")
ACTION = re.compile(r'action_\(node, "([^"]+)"')


def text_of(path):
    return COMMENT.sub("", path.read_text()) if path.exists() else ""


def files_of(root, node):
    """The node's source and all headers and sources of the bridge that it uses."""
    found = [root / f"src/nodes/{node}_node.cpp"]
    for path in found:
        for name in BRIDGE.findall(path.read_text()):
            both = [root / f"src/{name}{suffix}" for suffix in (".h", ".cpp")]
            found += [other for other in both if other.exists() and other not in found]
    return found


def prefixes(text, variable):
    """What a variable may put in front of a name, the robot's own namespace aside."""
    defined = re.search(rf"std::string {variable} = ([^;]*);", text)
    return sorted({part.strip("/") for part in re.findall(r'"([^"]*)"', defined.group(1))}) if defined else [""]


def names_of(call, text, node):
    if "~" in call["private"]:
        return [f"{node}/{call['name']}"]
    if not call["prefix"]:
        return [call["name"]]
    return [f"{prefix}/{call['name'].strip('/')}".lstrip("/") for prefix in prefixes(text, call["prefix"])]


def taken_type(call, text, declarations):
    """What a subscriber or a service takes: of the call itself, or of the method that it names."""
    if call["type"]:
        return call["type"].replace("::", "/")
    both = text + declarations
    method = METHOD.match(text, call.end()).group(1)
    argument = re.search(rf"(?<!::)\b{method}\(\s*(?:const )?([^)]*?)&", both).group(1)
    alias = re.search(rf"using {argument} = ([^;]*);", both)
    kinds = re.findall(r"(\w+)::(?!MessageEvent|ServiceEvent)(\w+)", alias.group(1) if alias else argument)
    return "/".join(kinds[0]).removesuffix("ConstPtr")


def topics_of(root, node):
    topics = Topics({}, {}, {}, set())
    for path in files_of(root, node):
        text = text_of(path)
        declarations = text_of(path.with_suffix(".h"))
        if "dynamic_reconfigure::" in text:
            continue
        for call in CALL.finditer(text):
            for name in names_of(call, text, node):
                if call["call"] == "advertise":
                    topics.writes[name] = call["type"].replace("::", "/")
                    if LATCHED.match(text, call.end()):
                        topics.latched.add(name)
                else:
                    (topics.reads if call["call"] == "subscribe" else topics.services)[name] = taken_type(call, text, declarations)
        for name in ACTION.findall(text):
            topics.reads[name] = "/".join(re.search(r"SimpleActionServer<(\w+)::(\w+)>", declarations).groups())
        if "TransformListener" in text:
            topics.reads["tf"] = "tf2_msgs/TFMessage"
        if "TransformBroadcaster" in text:
            topics.writes["tf"] = "tf2_msgs/TFMessage"
        if "diagnostic_updater::Updater" in text:
            topics.writes["/diagnostics"] = "diagnostic_msgs/DiagnosticArray"
    return topics


def read_topics(root):
    """Topics by node."""
    nodes = sorted(path.name[:-len("_node.cpp")] for path in (pathlib.Path(root) / "src/nodes").glob("*_node.cpp"))
    return {node: topics_of(pathlib.Path(root), node) for node in nodes}


# Transforms.

TRANSFORM = re.compile(r"geometry_msgs::TransformStamped (\w+)\([^{;]*{[^}]*?transform_message\(\s*[^;]*?,\s*([^,]+),\s*([^,]+),")
FRAMES = {"map": "map", "odom": "odom", "base_link": "base_link", "laser": "laser", "map_frame": "map", "odom_frame": "odom", "base_frame": "base_link",
          "frame_id": "odom"}  # the last: of the odometry


def frame_of(expression):
    """Of a robot, without its name: "odom" of `robot.odom_frame` and of `name + "/odom"`."""
    return FRAMES[re.findall(r"\w+", expression)[-1]]


def transforms_of(root, node):
    text = text_of(root / f"src/nodes/{node}_node.cpp")
    found = {(frame_of(parent), frame_of(child)) for path in files_of(root, node) if "ros_bridge/messages" in str(path)
             for function, parent, child in TRANSFORM.findall(text_of(path)) if re.search(rf"\b{function}\(", text)}
    return found if "TransformBroadcaster" in text else set()


def launched_transforms(root):
    """What others publish that launch/robot.launch starts, or agent.launch for it: mounts of the robot's description, and static ones."""
    launch = "".join((root / "launch" / name).read_text() for name in ("robot.launch", "agent.launch"))
    if 'type="robot_state_publisher"' in launch:
        mount = re.search(r'<parent link="(\w+)"/>\s*<child link="(\w+)"/>', (root / "scripts/robot_description").read_text())
        yield "robot_state_publisher", mount.groups()
    for parent, child in re.findall(r'type="static_transform_publisher"[^>]*?args="[^"]*? \$\(arg robot\)/(\w+) \$\(arg (\w+)\)"', launch):
        yield "static_transform_publisher", (parent, child)


def read_transforms(root):
    """Who publishes each transform (parent, child), without the robot's name."""
    root = pathlib.Path(root)
    publishers = {}
    for node in read_topics(root):
        for transform in transforms_of(root, node):
            publishers.setdefault(transform, []).append(node)
    for publisher, transform in launched_transforms(root):
        publishers.setdefault(transform, []).append(publisher)
    return {transform: sorted(names) for transform, names in sorted(publishers.items())}
