#!/usr/bin/python3
"""Checks README.md and the pages of docs/: how long README is, that links lead somewhere, that every page is linked to, and that the commands name scripts,
options, launch files, arguments and nodes that exist, and that examples are shown as they are. Each rule is also tried on a planted fault."""
import functools
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent
MOST_LINES = 120  # of README.md
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
SPAN = re.compile(r"`([^`\n]+)`")
BOX = re.compile(r"^ *```(\w*)\n(.*?)^ *```$", re.DOTALL | re.MULTILINE)  # language, if any, and what is in it


def pages():
    """The text of each page, by its path below ROOT."""
    return {path.relative_to(ROOT).as_posix(): path.read_text() for path in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]}


def without_code(text):
    return SPAN.sub("", BOX.sub("", text))


def anchors(text):
    """As GitHub makes them of headings."""
    headings = re.findall(r"^#+ (.*)$", BOX.sub("", text), re.MULTILINE)
    return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}


def links(texts):
    """Page, target, path and anchor of each link that leads to a file."""
    for page, text in texts.items():
        for target in LINK.findall(without_code(text)):
            if "://" in target:
                continue
            path, _, anchor = target.partition("#")
            whole = (ROOT / page).parent / path if path else ROOT / page
            yield page, target, whole.resolve().relative_to(ROOT).as_posix(), anchor


def link_faults(texts):
    for page, target, path, anchor in links(texts):
        if not (ROOT / path).exists():
            yield f"{page}: there is no {target}"
        elif anchor and anchor not in anchors(texts.get(path, "")):
            yield f"{page}: no heading is {target}"


def lost_pages(texts):
    linked = {path for page, _, path, _ in links(texts) if path != page}
    return sorted(page for page in texts if page != "README.md" and page not in linked)


def example_faults(texts):
    """What docs/library.md shows of the examples has to stand there."""
    written = {line.strip() for path in (ROOT / "examples").rglob("*.*") for line in path.read_text().splitlines()}
    for language, box in BOX.findall(texts["docs/library.md"]):
        if language in ("cmake", "cpp", "python"):
            yield from (f"docs/library.md: no example says {line}" for line in box.splitlines() if line.strip() not in written | {"..."})


def long_readme(texts):
    lines = len(texts["README.md"].splitlines())
    return [f"README.md: has {lines} lines, allowed are {MOST_LINES}"] if lines > MOST_LINES else []


def boxed_commands(text):
    """The lines in boxes of no other language, without comments, continued lines joined."""
    for language, box in BOX.findall(text):
        lines = box.replace("\\\n", " ").splitlines() if not language else []
        yield from filter(None, (" ".join(re.sub(r"(^|\s)#.*", "", line).split()) for line in lines))


def spoken_commands(text):
    """What is said between the boxes in code type."""
    return [span.strip() for span in SPAN.findall(BOX.sub("", text))]


def commands(text):
    return [*boxed_commands(text), *spoken_commands(text)]


@functools.lru_cache(maxsize=None)
def help_of(script, *name):
    run = subprocess.run([ROOT / script, *name, "--help"], capture_output=True, text=True, check=False)
    return run.stdout if run.returncode == 0 else ""


def script_faults(command):
    script, *words = re.search(r"scripts/.*", command).group().split()
    script = script.rstrip("/")
    if not (ROOT / script).exists():
        yield f"there is no {script}"
        return
    if not words or not (ROOT / script).is_file():
        return
    name = words[:1] if script in ("scripts/bench", "scripts/plots") else []
    text = help_of(script, *name)
    if not text:
        yield f"{script} knows no {' '.join(name)}"
    for option in re.findall(r"(?<!\S)--?[a-zA-Z][\w-]*", " ".join(words)):
        if text and not re.search(rf"(?<![\w-]){re.escape(option)}(?![\w-])", text):
            yield f"{' '.join([script, *name])} has no {option}"


def launch_faults(command):
    file, *arguments = re.search(r"roslaunch mocha_ugv (.*)", command).group(1).split()
    path = ROOT / "launch" / file
    if not path.exists():
        yield f"there is no {file}"
        return
    known = set(re.findall(r'<arg name="(\w+)"', path.read_text()))
    for argument in re.findall(r"(?<!\S)(\w+):=", " ".join(arguments)):
        if argument not in known:
            yield f"{file} has no argument {argument}"


def node_faults(command):
    node = re.search(r"rosrun mocha_ugv (\w+)", command).group(1)
    if not (ROOT / "src" / "nodes" / f"{node}_node.cpp").exists() and not (ROOT / "scripts" / node).exists():
        yield f"there is no node {node}"


KINDS = {r"(?:^|\s)scripts/\w": script_faults, r"^roslaunch mocha_ugv ": launch_faults, r"rosrun mocha_ugv ": node_faults}


def command_faults(texts):
    for page, text in texts.items():
        for command in commands(text):
            for pattern, faults in KINDS.items():
                if re.search(pattern, command):
                    yield from (f"{page}: {command}: {fault}" for fault in faults(command))


class Docs(unittest.TestCase):
    def check(self, faults, page, plant, complaint):
        """No faults; the complaint where something is planted on a page, a pair (old, new)."""
        texts = pages()
        self.assertEqual(list(faults(texts)), [])
        self.assertIn(plant[0], texts[page])
        texts[page] = texts[page].replace(*plant)
        self.assertIn(complaint, "\n".join(faults(texts)))

    def test_readme_is_short(self):
        self.check(long_readme, "README.md", ("\n", "\n\n"), "README.md: has ")

    def test_links_lead_somewhere(self):
        self.check(link_faults, "README.md", ("docs/safety.md", "docs/safely.md"), "there is no docs/safely.md")
        self.check(link_faults, "docs/architecture.md", ("#where-things-are", "#where-all-is"), "no heading is ../README.md#where-all-is")
        self.check(link_faults, "docs/own_robot.md", ("## Models", "## Kinds"), "docs/on_a_robot.md: no heading is own_robot.md#models")

    def test_examples_are_shown_as_they_are(self):
        self.check(example_faults, "docs/library.md", ("find_package(mocha_ugv REQUIRED)\n", "find_package(mocha REQUIRED)\n"), "no example says find_package(mocha REQUIRED)")

    def test_every_page_is_linked_to(self):
        self.assertEqual(lost_pages(pages()), [])
        self.assertEqual(lost_pages({"README.md": "[a](docs/nodes.md)", "docs/nodes.md": "[itself](nodes.md)", "docs/safety.md": ""}), ["docs/safety.md"])

    def test_commands_exist(self):
        self.check(command_faults, "README.md", ("scripts/demo ", "scripts/demos "), "there is no scripts/demos")
        self.check(command_faults, "docs/scripts.md", ("`scripts/bench soak`", "`scripts/bench soap`"), "scripts/bench knows no soap")
        self.check(command_faults, "docs/on_a_robot.md", ("--lidar-frame", "--laser-frame"), "scripts/install_robot has no --laser-frame")
        self.check(command_faults, "docs/on_a_robot.md", ("mapping:=true rviz", "maping:=true rviz"), "robot.launch has no argument maping")
        self.check(command_faults, "docs/scripts.md", ("replay.launch", "reply.launch"), "there is no reply.launch")
        self.check(command_faults, "docs/nodes.md", ("rosrun mocha_ugv base_driver", "rosrun mocha_ugv base"), "there is no node base")


if __name__ == "__main__":
    unittest.main()
