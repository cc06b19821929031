#!/usr/bin/python3
"""Checks docs/architecture.md and its picture against the sources: topics, paths, the rows of the ladder, the states of the executive, the
named requirements; docs/reference/ and docs/troubleshooting.md, too. Each rule is also tried on a planted fault."""
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
from mocha_scripts import architecture_plot, frames_plot, node_topics, reference  # noqa: E402

SPAN = re.compile(r"`([^`]+)`")
PATH = re.compile(r"(?:src|test|config|msg|launch|scripts)/[\w./]*[\w/]")
LADDER = "src/planning/replanner/ladder"
EXECUTIVE = "src/planning/executive/executive_state"
SITUATIONS = {"H": "kHolds", "P": "kPlanMeets", "I": "kInTurn", "T": "kThreatened", "B": "kBlocked", "W": "kInTheWay", "N": "kNoGoal"}
ELSEWHERE = {"diagnostics", "tf", "move_base"}  # names of topics that no call of ours spells out


def read(name):
    return (ROOT / name).read_text()


def code():
    """The sources, and what else defines names, without comments."""
    files = [path for folder in ("src", "config", "msg") for path in (ROOT / folder).rglob("*") if path.is_file() and path.suffix != ".bt"]
    return "\n".join(node_topics.text_of(path) for path in sorted(files))


def section(page, title):
    return page.partition(f"\n## {title}")[2].partition("\n## ")[0]


def tables(text):
    """The cells of each row of the tables in a text, headings and rulers included."""
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line.startswith("|")]


def enumerators(text, name):
    body = re.search(rf"enum class {name}[^{{]*{{(.*?)}};", text, re.DOTALL).group(1)
    return re.findall(r"\b(k[A-Z]\w*)", body)


def words(text, enumeration):
    return dict(re.findall(rf'case {enumeration}::(k\w+):\s*return "([^"]+)"', text))


def absent_names(page, sources):
    """Names in code type that no source has."""
    known = set(re.findall(r"\w+", sources))
    spans = [span for span in SPAN.findall(page) if re.fullmatch(r"[\w/]+", span) and not PATH.match(span)]
    return sorted({span for span in spans if f'"{span}"' not in sources
                   and not all(word in known | ELSEWHERE for word in span.replace("ugv1", "/").strip("/").split("/") if word)})


def absent_paths(page):
    return sorted({path for path in PATH.findall(page) if not (ROOT / path).exists()})


def absent_topics(topics, places):
    """Topics that a node writes and no place names."""
    named = {name for place in places for name in re.findall(r"[\w/]+", place)}
    return sorted({name for each in topics.values() for name in each.writes} - named)


def unread_calls(root):
    """Calls of nodes that advertise or subscribe and that the picture does not know: none but those of LCM and dynamic_reconfigure."""
    for path in sorted((root / "src").rglob("*.cpp")):
        if path.parent.name == "rviz_panel":
            continue
        text = node_topics.text_of(path)
        calls = len(re.findall(r"\b(?:advertise|advertiseService|subscribe)\s*[<(]", text))
        if "dynamic_reconfigure::" not in text and "lcm::" not in text and calls != len(node_topics.CALL.findall(text)):
            yield path.name


def ladder_faults(page, header, source):
    rungs = dict(re.findall(r"constexpr Rung (\w+){\s*Row::k\w+,\s*K::k\w+,\s*R::(k\w+)", source))
    rows = dict(re.findall(r"constexpr Rung (\w+){\s*Row::(k\w+)", source))
    order = {name: [rows[rung] for rung in re.findall(r"k\w+", body)]
             for name, body in re.findall(r"std::vector<Rung> (k\w+) = {(.*?)};", source, re.DOTALL)}
    text = section(page, "The ladder")
    listed = {cells[0].strip("`"): cells for cells in tables(text) if cells[0].startswith("`k")}
    said = words(source, "Row")
    for row in enumerators(header, "Row"):
        cells = listed.get(row)
        if cells is None:
            if f"`{row}` ({said[row]}" not in " ".join(text.split()) or row in rows.values():
                yield f"{row}: is not there, or not as \"{said[row]}\""
            continue
        numbers = [str(order[name].index(row) + 1) if row in order[name] else "" for name in SITUATIONS.values()]
        if cells[1] != said[row] or SPAN.findall(cells[2])[0] != rungs[row] or cells[4:] != numbers:
            yield f"{row}: \"{said[row]}\", {rungs[row]}, {numbers}"
    for letter, name in SITUATIONS.items():
        if f"`{name}` ({letter}:" not in text:
            yield f"{name}: is not there"
    if list(SITUATIONS.values()) != enumerators(header, "Situation"):
        yield "Situation: has other values"


def executive_faults(page, header, source):
    text = section(page, "The goal executive")
    listed = {cells[0].strip("`"): cells for cells in tables(text) if cells[0].startswith("`k")}
    states = enumerators(header, "ExecutiveState")
    leads = set(re.findall(r"{S::(k\w+), E::k\w+, S::(k\w+)}", source))
    orders = re.findall(r"{E::k\w+, S::(k\w+)}", re.search(r"kWhereItTakesPart\[\] = {(.*?)};", source, re.DOTALL).group(1))
    out = re.findall(r"state != S::(k\w+)", re.search(r"bool takes_part\(.*?}", source, re.DOTALL).group())
    leads |= {(state, target) for state in states if state not in out for target in orders}
    said = words(source, "S")
    for state in states:
        cells = listed.get(state)
        if cells is None or cells[1] != said[state]:
            yield f"{state}: is not there, or not as \"{said[state]}\""
            continue
        for target in SPAN.findall(cells[2]):
            if target.startswith("k") and (state, target) not in leads and "as `" not in cells[2]:
                yield f"{state}: does not lead to {target}"


def requirement_faults(page, header):
    listed = [cells[0].strip("`") for cells in tables(section(page, "The certifier")) if cells[0].startswith("`k")]
    names = enumerators(header, "RequirementName")
    return [f"{name}: is not there" for name in names if name not in listed] + [f"{name}: is none" for name in listed if name not in names]


# What docs/troubleshooting.md explains: the words of an enumeration, and where they are.
EXPLAINED = (("PlanReason", "src/planning/candidates/plan_result.cpp"), ("Row", LADDER + ".cpp"), ("M", "src/control/tracker_mode.cpp"),
             ("Refusal", "src/fleet/protocol/commitment_event.cpp"))


def unexplained_words(page):
    """Words that status and diagnostics say, and the page has no row for."""
    rows = {cells[0] for cells in tables(page)}
    for enumeration, file in EXPLAINED:
        for word in words(read(file), enumeration).values():
            if word != "none" and f"`{word}`" not in rows:
                yield f"{enumeration}: {word}"


class ArchitecturePage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.page = read("docs/architecture.md")
        cls.sources = code()
        cls.topics = node_topics.read_topics(ROOT)

    def check(self, faults, page, plant, complaint):
        """No faults on the page; the complaint where something is planted in it, a pair (old, new)."""
        self.assertEqual(list(faults(page)), [])
        self.assertIn(plant[0], page)
        self.assertIn(complaint, "\n".join(faults(page.replace(*plant))))

    def test_names_exist(self):
        self.check(lambda page: absent_names(page, self.sources), self.page, ("`proposed_trajectory`", "`wished_trajectory`"), "wished_trajectory")
        for page in ("fleet_network", "nodes", "on_a_robot", "own_robot", "safety", "tuning"):
            self.assertEqual(absent_names(read(f"docs/{page}.md"), self.sources), [], page)

    def test_paths_exist(self):
        for path in sorted((ROOT / "docs").rglob("*.md")):
            self.assertEqual(absent_paths(path.read_text()), [], path.name)
        self.check(absent_paths, self.page, ("src/control/lease.h", "src/control/leash.h"), "leash.h")

    def test_picture_is_what_the_sources_say(self):
        self.assertEqual(read("docs/architecture.svg"), architecture_plot.Picture(self.topics).svg(), "draw it anew: scripts/plots architecture --out docs")

    def test_every_topic_has_its_place(self):
        self.check(lambda picture: absent_topics(self.topics, [picture]), read("docs/architecture.svg"), (">settlement<", ">verdict<"), "settlement")
        self.assertEqual(list(unread_calls(ROOT)), [])

    def test_ladder(self):
        faults = lambda page: ladder_faults(page, read(LADDER + ".h"), read(LADDER + ".cpp"))  # noqa: E731
        self.check(faults, self.page, ("`kSidestep` | sidestep | `kPromise`", "`kSidestep` | sidestep | `kRenewal`"), "kSidestep: ")
        self.check(faults, self.page, ("| 3 | 1 | | 2 | 2 | 2 |", "| 1 | 3 | | 2 | 2 | 2 |"), "kDetour: ")
        self.check(faults, self.page, ("`kStopBlind` (", "`kStop` ("), "kStopBlind: ")

    def test_executive(self):
        faults = lambda page: executive_faults(page, read(EXECUTIVE + ".h"), read(EXECUTIVE + ".cpp"))  # noqa: E731
        self.check(faults, self.page, ("| `kWaiting", "| `kDriving"), "kWaiting: ")
        self.check(faults, self.page, ("when it is resumed;", "or `kWaiting`;"), "kPaused: does not lead to kWaiting")
        self.check(faults, self.page, ("to plan anew | `kPlanning`", "to plan anew | `kDriving`"), "kBraking: does not lead to kDriving")

    def test_requirements(self):
        self.check(lambda page: requirement_faults(page, read("src/safety/requirement.h")), self.page, ("| `kEscape`", "| `kFlight`"), "kEscape: is not")

    def test_troubleshooting_explains_what_is_said(self):
        for enumeration, file in EXPLAINED:
            self.assertGreater(len(words(read(file), enumeration)), 6, enumeration)
        self.check(unexplained_words, read("docs/troubleshooting.md"), ("| `sidestep` |", "| `side step` |"), "Row: sidestep")

    def test_reference_is_what_the_sources_say(self):
        for name, text in reference.pages(ROOT).items():
            self.assertEqual(read("docs/" + name), text, "write it anew: scripts/plots reference --out docs")

    def test_every_topic_has_a_meaning(self):
        self.assertEqual(list(reference.meaning_faults(self.topics)), [])
        planted = {**self.topics, "perception": self.topics["perception"]._replace(services={"smell": "std_srvs/Empty"})}
        faults = "\n".join(reference.meaning_faults(planted))
        self.assertIn("service smell: meanings.py does not say", faults)
        self.assertIn("service save_map: meanings.py explains it", faults)

    def test_reference_says_all_of_a_message(self):
        about, parts = reference.split_definition("# A thing.\n# Or two.\nuint8 ODD=1  # not even\nuint8 kind\n\n# About both.\nstring[] a # first\nT b\n")
        self.assertEqual(about, "A thing. Or two.")
        table = reference.fields_table(parts, {"T"})
        for line in ("| `kind` | uint8 | 1 `ODD`: not even |", "|  |  | *About both.* |", "| `a` | string[] | first |", "| `b` | [T](#t) |  |"):
            self.assertIn(line, table)

    def test_frames_are_what_the_sources_say(self):
        publishers = node_topics.read_transforms(ROOT)
        self.assertEqual(read("docs/frames.svg"), frames_plot.Frames(publishers).svg(), "draw it anew: scripts/plots architecture --out docs")
        self.assertEqual(publishers["odom", "base_link"], ["base_driver", "fleet_simulator"])
        nodes = sorted({node for nodes in publishers.values() for node in nodes if node in self.topics})
        self.assertEqual(nodes, sorted(node for node, each in self.topics.items() if "tf" in each.writes), "a node whose transforms are not found")


if __name__ == "__main__":
    unittest.main()
