"""docs/reference/: the topics of each node from the sources and from what meanings.py says of them, messages and services from msg/ and srv/,
parameters from config/. Text of Markdown, the same for the same sources."""
import collections
import pathlib
import re

import yaml

from mocha_scripts import meanings, node_topics
from mocha_scripts.architecture_plot import SIMULATION

PLUMBING = ("/diagnostics", "/clock", "/fleet_simulator/acks")  # of every node
MADE = "*Made by `scripts/plots reference --out docs` from {}; change it there.*"

Field = collections.namedtuple("Field", "type name value about")  # value: of a constant
Note = collections.namedtuple("Note", "text")  # about what follows


def table(heads, rows):
    lines = [heads, ["---"] * len(heads), *rows]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines)


def prose(text):
    """As it is in Markdown, where what stands in <> would be taken for HTML, and stars for emphasis."""
    return re.sub(r"([|*])", r"\\\1", text.replace("<", "&lt;"))


def code(names):
    return ", ".join(f"`{name}`" for name in names)


def message_link(kind, page="messages.md"):
    package, _, name = kind.partition("/")
    return f"[{name}]({page}#{name.lower()})" if package == "mocha_ugv" else kind


# Topics.

def topic_rows(names, kinds, other_ends, latched):
    for name in sorted(names, key=lambda name: name.strip("/")):
        about = meanings.TOPICS[name] + ("; latched" if name in latched else "")
        yield [f"`{name}`", message_link(kinds[name]), about, other_ends(name)]


def common_rows(topics):
    for name in PLUMBING:
        writers = [node for node in meanings.NODES if name in topics[node].writes]
        others = [node for node in meanings.NODES if node not in writers]
        kind = topics[writers[0]].writes[name]
        yield [f"`{name}`", message_link(kind), meanings.TOPICS[name], code(writers) if len(writers) < len(others) else f"all but {code(others)}" if others else "all"]


def topics_page(topics):
    def readers(name):
        return code(node for node in meanings.NODES if name in topics[node].reads)

    def writers(name):
        nodes = [node for node in meanings.NODES if name in topics[node].writes]
        outside = not set(nodes) - SIMULATION and not name.startswith("/")
        return ", ".join(filter(None, ["from outside" if outside else "", code(nodes)]))

    parts = ["# Topics, services and actions", MADE.format("the sources"),
             "Names are relative to the robot's namespace (`/ugv1`), unless they begin with `/`. A latched topic gives each new reader its newest message.",
             "Of all nodes:", table(["topic", "message", "what it is", "written by"], common_rows(topics))]
    for node, about in meanings.NODES.items():
        each = topics[node]
        parts += [f"## {node}", f"{about} [Parameters](parameters.md#{node})"]
        writes = [name for name in each.writes if name not in PLUMBING]
        reads = [name for name in each.reads if name not in PLUMBING and not each.reads[name].endswith("Action")]
        actions = {name: kind for name, kind in each.reads.items() if kind.endswith("Action")}
        parts.append(table(["writes", "message", "what it is", "read by"], topic_rows(writes, each.writes, readers, each.latched)))
        parts.append(table(["reads", "message", "what it is", "written by"], topic_rows(reads, each.reads, writers, ())))
        if each.services:
            parts.append(table(["service", "type", "what it does"], [[f"`{name}`", message_link(kind), meanings.SERVICES[name]]
                                                                    for name, kind in sorted(each.services.items())]))
        if actions:
            parts.append(table(["action", "type", "what it does"], [[f"`{name}`", kind, meanings.TOPICS[name]] for name, kind in actions.items()]))
    return "\n\n".join(parts) + "\n"


def meaning_faults(topics):
    """Topics, services and nodes without meaning, and meanings of nothing."""
    known = {"node": set(topics), "topic": {name for each in topics.values() for name in {*each.writes, *each.reads}},
             "service": {name for each in topics.values() for name in each.services}}
    for what, said in (("node", meanings.NODES), ("topic", meanings.TOPICS), ("service", meanings.SERVICES)):
        yield from (f"{what} {name}: meanings.py does not say what it is" for name in sorted(known[what] - set(said)))
        yield from (f"{what} {name}: meanings.py explains it, and no source has it" for name in sorted(set(said) - known[what]))


# Messages and services.

def split_definition(text):
    """What is said of all of it, and its fields, constants and notes in order."""
    about, parts, gathered = [], [], []
    at_top = True
    for line in text.strip("\n").splitlines():
        definition, _, comment = (piece.strip() for piece in line.partition("#"))
        if not definition and comment:
            (about if at_top else gathered).append(comment)
            continue
        at_top = False
        if gathered:
            parts.append(Note(" ".join(gathered)))
            gathered = []
        if definition:
            kind, name, value = re.match(r"(\S+)\s+(\w+)\s*(?:=\s*(\S+))?$", definition).groups()
            parts.append(Field(kind, name, value, comment))
    return " ".join(about), parts


def field_type(kind, names):
    bare = kind.partition("[")[0]
    return kind.replace(bare, f"[{bare}](#{bare.lower()})", 1) if bare in names else kind


def fields_table(parts, names):
    """Constants are listed with the field that takes them, which follows: the next of their type."""
    rows, constants = [], []
    for part in parts:
        if isinstance(part, Note):
            rows.append(["", "", f"*{prose(part.text)}*"])
        elif part.value is not None:
            constants.append(part)
        else:
            values = [f"{each.value} `{each.name}`{': ' + prose(each.about) if each.about else ''}" for each in constants if each.type == part.type]
            rows.append([f"`{part.name}`", field_type(part.type, names), "<br>".join(filter(None, [prose(part.about), *values]))])
            if values:
                constants = []
    return table(["field", "type", "meaning"], rows) if rows else "No fields."


def users(name, topics, definitions):
    """Where a message is met: on topics, in services, in other messages."""
    kind = "mocha_ugv/" + name
    on = sorted({topic for each in topics.values() for topic, other in {**each.writes, **each.reads, **each.services}.items() if other == kind})
    inside = [other for other, text in definitions.items() if re.search(rf"^{name}(\[\d*\])?\s", text, re.MULTILINE)]
    return "; ".join(filter(None, ["on " + code(on) if on else "",
                                   "in " + ", ".join(f"[{other}](#{other.lower()})" for other in inside) if inside else ""]))


def messages_page(root, topics):
    messages = {path.stem: path.read_text() for path in sorted((root / "msg").glob("*.msg"))}
    services = {path.stem: path.read_text() for path in sorted((root / "srv").glob("*.srv"))}
    names = set(messages)
    parts = ["# Messages and services", MADE.format("`msg/` and `srv/`"),
             "Places and headings are in the frame that the header names: metres and radians, times in ROS time. "
             f"Services: {', '.join(f'[{name}](#{name.lower()})' for name in services)}."]
    for name, text in messages.items():
        about, fields = split_definition(text)
        met = users(name, topics, {**messages, **services})
        parts += filter(None, [f"## {name}", prose(about), met[:1].upper() + met[1:] + "." if met else "", fields_table(fields, names)])
    for name, text in services.items():
        request, _, answer = text.partition("---\n")
        about, asked = split_definition(request)
        _, told = split_definition(answer)
        parts += filter(None, [f"## {name}", prose(about), f"Service: {users(name, topics, {})[3:]}.", "Request:", fields_table(asked, names), "Response:",
                               fields_table(told, names)])
    return "\n\n".join(parts) + "\n"


# Parameters.

def shown(value):
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return f"{value:.10g}" if abs(value) < 1e6 else f"{value:g}".replace("e+0", "e")
    return str(value) if isinstance(value, int) else f"`{value}`" if value else "empty"


def range_of(entry):
    if "choices" in entry:
        return code(entry["choices"])
    return f"{shown(entry['min'])} to {shown(entry['max'])}" if "min" in entry else ""


def parameter_table(schema):
    present = {name: entry for name, entry in schema.items() if "gone" not in entry}
    live = any(entry.get("live") for entry in present.values())
    rows = []
    for name, entry in present.items():
        about = prose(entry["about"]) + (f" Formerly `{entry['was']}`." if "was" in entry else "")
        cells = [f"`{name}`", shown(entry["default"]), "" if entry["unit"] == "-" else entry["unit"], range_of(entry)]
        rows.append(cells + (["live" if entry.get("live") else ""] if live else []) + [about])
    gone = "; ".join(f"`{name}` ({prose(entry['gone'])})" for name, entry in schema.items() if "gone" in entry)
    return "\n\n".join(filter(None, [table(["name", "default", "unit", "range", *([""] if live else []), "meaning"], rows),
                                     f"No more there: {gone}." if gone else ""]))


def parameters_page(root):
    def schema(name):
        return yaml.safe_load((root / f"config/{name}.yaml").read_text())

    parts = ["# Parameters", MADE.format("`config/*.yaml`"),
             "[How to set them](../own_robot.md#parameters), and [which ones to touch](../tuning.md). A value out of range, and a name that is not here, "
             "ends the node with a line that says so. What is *live* changes while the node runs; a file of `config/robots/` or your own sets the "
             "values of [the model](#the-model), by their names alone.",
             "## The model", "What the robot is: the same for all its nodes.", parameter_table(schema("robot"))]
    for node, about in meanings.NODES.items():
        parts += [f"## {node}", f"{about} [Topics](topics.md#{node})", parameter_table(schema(node))]
    return "\n\n".join(parts) + "\n"


def pages(root):
    """Text by file below docs/."""
    root = pathlib.Path(root)
    topics = node_topics.read_topics(root)
    return {"reference/topics.md": topics_page(topics), "reference/messages.md": messages_page(root, topics),
            "reference/parameters.md": parameters_page(root)}


def write_reference(root, out):
    for name, text in pages(root).items():
        path = pathlib.Path(out) / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
