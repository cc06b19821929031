"""docs/frames.svg: the frames of a robot on a floor, and who publishes the transform from each to the next. Who does is read from the sources."""
import math
import os

from mocha_scripts import node_topics
from mocha_scripts.svg import BLUE, DARK, GREY, PALE, Drawing

WIDTH, HEIGHT = 1000, 640
FLOOR_TOP, FLOOR_BOTTOM = 64, 366
GREEN, ORANGE, VIOLET, SLATE = "#2e7d32", "#c25700", "#7b1fa2", "#546e7a"
X_AXIS, Y_AXIS = "#d32f2f", "#388e3c"

# Of each transform, in order: its colour, and what it says, in lines.
TRANSFORMS = {
    ("map", "odom"): (BLUE, ["where odometry has begun, by what", "the lidar sees; corrected on the way,", "in small jumps"]),
    ("odom", "base_link"): (VIOLET, ["where the robot is by its odometry:", "smooth, but it drifts"]),
    ("base_link", "laser"): (ORANGE, ["where the lidar is on the robot,", "as the model says"]),
    ("laser", "lidar_frame"): (GREEN, ["the same place by the name that the", "lidar's driver gives to its frame"]),
}
# When which publisher does, in words; and who may take its place.
WHEN = {
    "scan_localizer": "if localizer:=true",
    "base_driver": "if base:=true",
    "robot_state_publisher": "always, in robot.launch",
    "static_transform_publisher": "if lidar_frame is given",
    ("fleet_simulator", "map"): "if publish_map_to_odom",
    ("fleet_simulator", "odom"): "unless emulated_bases",
    ("fleet_simulator", "base_link"): "always, in simulation",
}
OTHERS = {"map": ("another localiser", "if localizer:=false"), "odom": ("another driver", "if base:=false"),
          "base_link": ("your own", "with agent.launch alone")}


def along(place, heading_deg, ahead, left=0.0):
    """As a picture counts: y downward."""
    cos, sin = math.cos(math.radians(heading_deg)), math.sin(math.radians(heading_deg))
    return round(place[0] + ahead * cos - left * sin, 1), round(place[1] - ahead * sin - left * cos, 1)


class Frames(Drawing):
    def __init__(self, publishers):
        super().__init__()
        self.publishers = publishers

    def line(self, begin, end, colour, width=2.0, more=""):
        self.add(f'<line x1="{begin[0]}" y1="{begin[1]}" x2="{end[0]}" y2="{end[1]}" stroke="{colour}" stroke-width="{width}"{more}/>')

    def head(self, tip, heading_deg, colour, size=7):
        corners = [tip, along(tip, heading_deg, -1.6 * size, 0.6 * size), along(tip, heading_deg, -1.6 * size, -0.6 * size)]
        self.add(f'<polygon points="{" ".join(f"{x},{y}" for x, y in corners)}" fill="{colour}"/>')

    def axes(self, place, heading_deg, length, name="", anchor="start", shift=(0, 0)):
        for turn, colour in ((0, X_AXIS), (90, Y_AXIS)):
            tip = along(place, heading_deg + turn, length)
            self.line(place, along(place, heading_deg + turn, length - 6), colour, 2.5)
            self.head(tip, heading_deg + turn, colour, 5)
        self.add(f'<circle cx="{place[0]}" cy="{place[1]}" r="3.5" fill="{DARK}"/>')
        if name:
            self.text(place[0] + shift[0], place[1] + shift[1], name, 13, DARK, anchor, "bold")

    def arrow(self, begin, end, bend, number, colour):
        """From frame to frame, bent to the left by so much, with its number."""
        middle = ((begin[0] + end[0]) / 2, (begin[1] + end[1]) / 2)
        heading = math.degrees(math.atan2(begin[1] - end[1], end[0] - begin[0]))
        control = along(middle, heading, 0, 2 * bend)
        to_end = math.degrees(math.atan2(control[1] - end[1], end[0] - control[0]))
        short = along(end, to_end, -14)
        self.add(f'<path d="M {begin[0]} {begin[1]} Q {control[0]} {control[1]} {short[0]} {short[1]}" fill="none" stroke="{colour}" '
                 'stroke-width="2.5" stroke-dasharray="7 4"/>')
        self.head(along(end, to_end, -6), to_end, colour, 6)
        self.badge(*along(middle, heading, 0, bend), number, colour)

    def badge(self, x, y, number, colour):
        self.add(f'<circle cx="{x}" cy="{y}" r="11" fill="{colour}" stroke="#ffffff" stroke-width="2"/>')
        self.text(x, y + 4.5, number, 13, "#ffffff", "middle", "bold")

    def body(self, place, heading_deg, colour, stroke):
        x, y = place
        self.add(f'<g transform="translate({x} {y}) rotate({-heading_deg})">')
        for wheel in ((-30, -36), (10, -36), (-30, 26), (10, 26)):
            self.add(f'<rect x="{wheel[0]}" y="{wheel[1]}" width="24" height="10" rx="3" fill="{stroke}"/>')
        self.add(f'<rect x="-44" y="-28" width="88" height="56" rx="9" fill="{colour}" stroke="{stroke}" stroke-width="2"/>')
        self.add("</g>")

    def floor(self):
        """A room with a doorway and a pillar, walls as the map has them."""
        self.add(f'<rect x="16" y="{FLOOR_TOP}" width="{WIDTH - 32}" height="{FLOOR_BOTTOM - FLOOR_TOP}" rx="4" fill="#f6f8f9"/>')
        for begin, end in (((16, FLOOR_TOP + 4), (984, FLOOR_TOP + 4)), ((20, FLOOR_TOP), (20, FLOOR_BOTTOM)), ((16, FLOOR_BOTTOM - 4), (984, FLOOR_BOTTOM - 4)),
                           ((980, FLOOR_TOP), (980, FLOOR_BOTTOM)), ((700, FLOOR_TOP), (700, 130)), ((700, 246), (700, FLOOR_BOTTOM))):
            self.line(begin, end, GREY, 8)

    def robots(self):
        origin, odom, base = (70, 316), (250, 262), (520, 196)
        heading = 14
        lidar = along(base, heading, 30)
        for beam in range(-64, 65, 16):
            self.line(lidar, along(lidar, heading + beam, 112), "#f3cfae", 1)
        self.body(base, heading, "#ffffff", DARK)
        self.arrow(origin, odom, 34, "1", BLUE)
        self.arrow(odom, base, 52, "2", VIOLET)
        self.axes(origin, 0, 52, "map", shift=(10, 22))
        self.axes(odom, 9, 46, "ugv1/odom", shift=(8, 24))
        self.axes(base, heading, 54, "ugv1/base_link", "middle", (-44, 66))
        self.axes(lidar, heading, 30)
        self.line(along(lidar, -82, 7), (559, 286), GREY, 1)
        self.text(524, 304, "ugv1/laser", 13, DARK, weight="bold")
        self.badge(622, 300, "3", ORANGE)
        self.badge(648, 300, "4", GREEN)
        other = (850, 168)
        self.body(other, 152, "#f6f8f9", "#b0bec5")
        self.text(other[0], 238, "ugv2, with ugv2/odom and so on:", 12, SLATE, "middle")
        self.text(other[0], 254, "robots share the frame map alone", 12, SLATE, "middle")

    def card(self, x, number, transform):
        colour, lines = TRANSFORMS[transform]
        parent, child = (name if name in ("map", "lidar_frame") else "ugv1/" + name for name in transform)
        top, width = FLOOR_BOTTOM + 18, 233
        self.add(f'<rect x="{x}" y="{top}" width="{width}" height="{HEIGHT - top - 16}" rx="6" fill="#ffffff" stroke="{PALE}" stroke-width="1.5"/>')
        self.add(f'<rect x="{x}" y="{top}" width="{width}" height="5" rx="2" fill="{colour}"/>')
        self.badge(x + 22, top + 31, number, colour)
        self.text(x + 42, top + 27, parent, 12, DARK, weight="bold")
        self.text(x + 42, top + 43, "→ " + child, 12, DARK, weight="bold")
        y = top + 70
        for line in lines:
            self.text(x + 12, y, line, 11, DARK)
            y += 15
        y = top + 136
        said = [(name, WHEN[name] if name in WHEN else WHEN[name, transform[0]]) for name in self.publishers[transform]]
        said.sort(key=lambda row: row[0] == "fleet_simulator")
        for name, when in [*said, *filter(None, [OTHERS.get(transform[0])])]:
            self.text(x + 12, y, name, 12, colour if name in self.publishers[transform] else SLATE, weight="bold")
            self.text(x + 12, y + 14, when, 11, SLATE)
            y += 36

    def svg(self):
        self.text(16, 30, "Frames", 20, DARK, weight="bold")
        self.text(16, 50, "Red: x, ahead; green: y, to the left. Dashed: the transforms, from parent to child. Below: what each says, and who publishes it.", 12)
        self.floor()
        self.robots()
        if set(self.publishers) != set(TRANSFORMS):
            raise ValueError(f"frames_plot.py knows other transforms than the sources have: {sorted(self.publishers)}")
        for i, transform in enumerate(TRANSFORMS):
            self.card(16 + 245 * i, str(i + 1), transform)
        return self.whole(WIDTH, HEIGHT)


def draw_frames(root, out):
    with open(os.path.join(out, "frames.svg"), "w", encoding="utf-8") as file:
        file.write(Frames(node_topics.read_transforms(root)).svg())
