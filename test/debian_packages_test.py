#!/usr/bin/python3
"""What Debian's packages are made by: versions and dates of CHANGELOG.rst, and what debian/control needs to build. scripts/package makes and tries them."""
import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
from mocha_scripts.debian_changelog import debian_changelog, read_releases  # noqa: E402

PACKAGE = """<package format="2"><version>0.2.0</version><maintainer email="a@b.example">The authors</maintainer></package>"""
CHANGELOG = """
Changelog
---------

Forthcoming
-----------
* Sees ``farther``

0.2.0 (2026-11-28)
------------------
* A long line that is broken because it is longer than what stands in a line of Debian's
  and goes on here
* Short

0.1.0 (2026-11-24)
------------------
* First
"""


class DebianPackages(unittest.TestCase):
    def test_changelog(self):
        written = debian_changelog(PACKAGE, CHANGELOG, "~deb12", "2026-12-01")
        self.assertEqual(re.findall(r"^mocha-ugv \((\S+)\) unstable; urgency=medium$", written, re.MULTILINE),
                         ["0.2.0+20261201~deb12", "0.2.0~deb12", "0.1.0~deb12"])
        self.assertEqual(re.findall(r"^ -- authors <a@b.example>  (.*)$", written, re.MULTILINE),
                         ["Tue, 01 Dec 2026 12:00:00 +0000", "Sat, 28 Nov 2026 12:00:00 +0000", "Tue, 24 Nov 2026 12:00:00 +0000"])
        self.assertIn("\n  * Sees farther\n", written)
        self.assertRegex(written, r"\n  \* A long line [^\n]*\n    [^\n]*and goes on here\n  \* Short\n")
        self.assertLessEqual(max(map(len, written.splitlines())), 80)

    def test_a_version_that_is_not_the_newest_is_refused(self):
        with self.assertRaisesRegex(ValueError, "package.xml is of version 0.3.0, the newest of CHANGELOG.rst is 0.2.0"):
            debian_changelog(PACKAGE.replace("0.2.0", "0.3.0"), CHANGELOG, "", "2026-12-01")

    def test_ours_is_read_whole(self):
        text = (ROOT / "CHANGELOG.rst").read_text()
        debian_changelog((ROOT / "package.xml").read_text(), text, "", "2026-12-01")
        releases = read_releases(text)
        dates = [date for _, date, _ in releases if date]
        self.assertEqual(dates, sorted(dates, reverse=True))
        words = " ".join(line.strip().removeprefix("* ") for line in text.splitlines() if line.startswith(("* ", "  ")))
        self.assertEqual(" ".join(entry for _, _, entries in releases for entry in entries), words)

    def test_setup_installs_what_is_needed_to_build(self):
        listed = subprocess.run([ROOT / "scripts/setup", "--package", "--list"], check=True, text=True, stdout=subprocess.PIPE).stdout.split()
        control = (ROOT / "debian/control").read_text()
        needed = re.findall(r"^ ([\w.+-]+)", re.search(r"^Build-Depends:\n((?: .*\n)*)", control, re.MULTILINE).group(1), re.MULTILINE)
        self.assertGreater(len(needed), 20)
        self.assertEqual(set(needed) - {"debhelper-compat", "qt6-base-dev"} - set(listed), set())


if __name__ == "__main__":
    unittest.main()
