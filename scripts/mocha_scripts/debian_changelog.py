"""Debian's changelog, made of CHANGELOG.rst and package.xml."""
import datetime
import email.utils
import re
import sys
import textwrap
import xml.etree.ElementTree as ElementTree

RELEASE = re.compile(r"(\d+\.\d+\.\d+) \((\d{4}-\d\d-\d\d)\)|Forthcoming")


def read_releases(text):
    """Version, date and entries of each release of a CHANGELOG.rst, the newest first. What is forthcoming has neither version nor date."""
    releases = []
    lines = text.splitlines()
    for line, below in zip(lines, [*lines[1:], ""]):
        heading = RELEASE.fullmatch(line)
        if heading and set(below) == {"-"}:
            releases.append((heading[1], heading[2], []))
        elif line.startswith("* "):
            releases[-1][2].append(line[2:])
        elif line.startswith("  ") and releases:
            releases[-1][2][-1] += " " + line.strip()
    return releases


def section(version, date, entries, maintainer):
    noon = datetime.datetime.fromisoformat(date).replace(hour=12, tzinfo=datetime.timezone.utc)
    points = [textwrap.fill(entry.replace("``", ""), 78, initial_indent="  * ", subsequent_indent="    ") for entry in entries]
    return (f"mocha-ugv ({version}) unstable; urgency=medium\n\n" + "\n".join(points) +
            f"\n\n -- {maintainer}  {email.utils.format_datetime(noon)}\n")


def debian_changelog(package_xml, changelog, suffix, today):
    """The whole of it. `suffix` follows every version, such as ~deb12; what is forthcoming is a release of `today`."""
    package = ElementTree.fromstring(package_xml)
    maintainer = package.find("maintainer")
    signature = f"{maintainer.text.removeprefix('The ')} <{maintainer.get('email')}>"
    releases = read_releases(changelog)
    released = next(version for version, _, _ in releases if version)
    if released != package.findtext("version"):
        raise ValueError(f"package.xml is of version {package.findtext('version')}, the newest of CHANGELOG.rst is {released}")
    return "\n".join(section((version or f"{released}+{today.replace('-', '')}") + suffix, date or today, entries, signature)
                     for version, date, entries in releases)


if __name__ == "__main__":
    with open("package.xml") as package_file, open("CHANGELOG.rst") as changelog_file:
        sys.stdout.write(debian_changelog(package_file.read(), changelog_file.read(), sys.argv[1], sys.argv[2]))
