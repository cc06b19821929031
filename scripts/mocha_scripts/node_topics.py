"""The topics of each node, read from the sources: the calls that advertise and subscribe in src/nodes/ and in what these use of
src/ros_bridge/. Names are relative to the robot's namespace. What dynamic_reconfigure adds for live parameters is left out."""
import collections
import pathlib
import re

Topics = collections.namedtuple("Topics", "writes reads services")  # of a node; writes: message type (or "") by topic

COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
BRIDGE = re.compile(r'#include "(ros_bridge/[^"]+)\.h"')
# What is called, the type in <>, and the first argument: a name, or one behind a variable.
CALL = re.compile(r'(?P<private>NodeHandle\("~"\)\s*\.\s*|\.\s*)(?P<call>advertise|subscribe|advertiseService)\s*(?:<(?P<type>[\w:]+)>)?'
                  r'\(\s*(?:(?P<prefix>\w+) \+ )?"(?P<name>[^"]+)"')
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


def topics_of(root, node):
    topics = Topics({}, set(), set())
    for path in files_of(root, node):
        text = text_of(path)
        if "dynamic_reconfigure::" in text:
            continue
        for call in CALL.finditer(text):
            for name in names_of(call, text, node):
                if call["call"] == "advertise":
                    topics.writes[name] = call["type"].split("::")[1]
                else:
                    (topics.reads if call["call"] == "subscribe" else topics.services).add(name)
        topics.reads.update(ACTION.findall(text))
        if "TransformListener" in text:
            topics.reads.add("tf")
        if "TransformBroadcaster" in text:
            topics.writes["tf"] = ""
        if "diagnostic_updater::Updater" in text:
            topics.writes["/diagnostics"] = "DiagnosticArray"
    return topics


def read_topics(root):
    """Topics by node."""
    nodes = sorted(path.name[:-len("_node.cpp")] for path in (pathlib.Path(root) / "src/nodes").glob("*_node.cpp"))
    return {node: topics_of(pathlib.Path(root), node) for node in nodes}
