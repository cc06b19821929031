"""docs/architecture.svg: the nodes of one robot as columns, in the order of the data's way, and its topics as rows. Text of SVG, the same
for the same sources."""
import os

from mocha_scripts import meanings, node_topics
from mocha_scripts.svg import BLUE, DARK, GREY, PALE, Drawing

ORDER = list(meanings.NODES)  # the data's way
SIMULATION = {"base_emulator", "fleet_simulator"}
APART = SIMULATION | {"space_planner"}  # no part of a robot's own stack
MAIN_WAY = ["scan", "map", "map_updates", "predicted_obstacles", "global_trajectory", "proposed_trajectory", "committed_trajectory", "cmd_vel"]
OUTSIDE = "outside"

NAME_X, TYPE_X, FIRST_X, COLUMN = 16, 232, 452, 116
TOP, ROW, BOX_WIDTH, BOX_HEIGHT = 84, 22, 108, 38


def rows_of(topics):
    """(heading, topics below it), from a scan to the wheels first, then by the first node that writes them."""
    writers = {}
    for node in ORDER:
        for name in topics[node].writes:
            writers.setdefault(name, []).append(node)
    read = {name for each in topics.values() for name in each.reads}
    shared = sorted(name for name, nodes in writers.items() if len(nodes) > 2)
    taken = set(MAIN_WAY) | set(shared)
    groups = [("From a scan to the wheels", MAIN_WAY), ("From outside", sorted(read - set(writers) - taken))]
    for node in ORDER:
        groups.append((f"{node} also writes", sorted(name for name, nodes in writers.items() if nodes[0] == node and name not in taken)))
    return [(heading, names) for heading, names in [*groups, ("Several nodes write", shared)] if names]


class Picture(Drawing):
    def __init__(self, topics):
        super().__init__()
        self.topics = topics
        self.columns = {name: FIRST_X + COLUMN * i for i, name in enumerate([OUTSIDE, *ORDER])}
        self.groups = rows_of(topics)
        self.width = FIRST_X + COLUMN * len(ORDER) + COLUMN // 2 + 8
        rows = sum(len(names) + 1.4 for _, names in self.groups)
        self.bottom = TOP + BOX_HEIGHT + round(ROW * (rows + 0.9))

    def box(self, name, y):
        x = self.columns[name]
        head, _, tail = name.rpartition("_")
        dashed = ' stroke-dasharray="4 3"' if name in APART | {OUTSIDE} else ""
        self.add(f'<rect x="{x - BOX_WIDTH // 2}" y="{y}" width="{BOX_WIDTH}" height="{BOX_HEIGHT}" rx="5" fill="#ffffff" stroke="{DARK}"{dashed}/>')
        words = [head + "_", tail] if head else [name]
        for i, word in enumerate(words):
            self.text(x, y + BOX_HEIGHT // 2 + 4 + round(14 * (i - (len(words) - 1) / 2)), word, 12, DARK, "middle", "bold")

    def row(self, name, y):
        main = name in MAIN_WAY
        colour = BLUE if main else GREY
        writers = [node for node in ORDER if name in self.topics[node].writes]
        readers = [node for node in ORDER if name in self.topics[node].reads]
        kind = next((self.topics[node].writes[name] for node in writers), "").split("/")[-1]
        # What on a robot comes from elsewhere, only simulators write here.
        real = [node for node in writers if node not in SIMULATION]
        if not real and not name.startswith("/") and set(readers) - SIMULATION:
            writers = [OUTSIDE, *writers]
        self.text(NAME_X, y + 4, name, 12, BLUE if main else DARK, weight="bold" if main else "normal")
        self.text(TYPE_X, y + 4, kind, 11, GREY)
        ends = [self.columns[node] for node in [*writers, *readers]]
        if min(ends) < max(ends):
            self.add(f'<line x1="{min(ends)}" y1="{y}" x2="{max(ends)}" y2="{y}" stroke="{colour}" stroke-width="{2.5 if main else 1.2}"/>')
        for node in readers:
            self.add(f'<circle cx="{self.columns[node]}" cy="{y}" r="5" fill="#ffffff" stroke="{colour}" stroke-width="2"/>')
        for node in writers:
            both = node in readers
            self.add(f'<circle cx="{self.columns[node]}" cy="{y}" r="{2.2 if both else 5}" fill="{colour}"/>')

    def svg(self):
        self.text(NAME_X, 30, "Nodes and topics of one robot", 20, DARK, weight="bold")
        self.text(NAME_X, 52, "Full dot: the node writes the topic; ring: it reads it; ring with a dot: it writes and reads it, as others do; "
                              "a full dot alone: for rviz, for people and for the simulation's results.", 12)
        self.text(NAME_X, 70, "Bold: from a scan to the wheels. Dashed boxes are no part of a robot's own stack. Names are relative to the robot's "
                              "namespace, unless they begin with /.", 12)
        for x in self.columns.values():
            self.add(f'<line x1="{x}" y1="{TOP + BOX_HEIGHT}" x2="{x}" y2="{self.bottom}" stroke="{PALE}" stroke-width="2"/>')
        y = TOP + BOX_HEIGHT
        for heading, names in self.groups:
            y += round(1.4 * ROW)
            self.text(NAME_X, y - 2, heading, 12, GREY, weight="bold")
            for name in names:
                y += ROW
                self.row(name, y - 4)
        for name in self.columns:
            self.box(name, TOP)
            self.box(name, self.bottom)
        return self.whole(self.width, self.bottom + BOX_HEIGHT + 12)


def draw_architecture(root, out):
    with open(os.path.join(out, "architecture.svg"), "w", encoding="utf-8") as file:
        file.write(Picture(node_topics.read_topics(root)).svg())
