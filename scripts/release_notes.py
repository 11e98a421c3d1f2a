"""Prints the text of a release: one version's chapter of CHANGELOG.md.

GitHub shows every line break of it, and it is read far from the repository: a paragraph is one line, and a link a whole address.
Usage: release_notes.py VERSION ADDRESS, where ADDRESS comes before paths of the repository.
"""

import pathlib
import re
import sys

CHANGELOG = pathlib.Path(__file__).parent.parent / "CHANGELOG.md"


def chapter(text: str, version: str) -> str:
    """What stands under the heading of a version."""
    for part in re.split(r"^## ", text, flags=re.MULTILINE)[1:]:
        title, _, body = part.partition("\n")
        if title.split() and title.split()[0] == version:
            return body.strip()
    sys.exit(f"CHANGELOG.md has no chapter `## {version} - DATE`")


def unwrapped(text: str) -> str:
    """A line that begins no list, heading or table goes on with the line before it."""
    return re.sub(r"(?<=[^\n])\n(?![\n#|]|- )\s*", " ", text)


def with_addresses(text: str, address: str) -> str:
    """Links to the repository, as links to `address`."""
    return re.sub(r"\]\((?![a-z]+:|#)", f"]({address.rstrip('/')}/", text)


def main() -> None:
    version, address = sys.argv[1:]
    notes = with_addresses(unwrapped(chapter(CHANGELOG.read_text(), version)), address)
    if not notes:
        sys.exit(f"CHANGELOG.md says nothing under `## {version}`")
    print(notes)


if __name__ == "__main__":
    main()
