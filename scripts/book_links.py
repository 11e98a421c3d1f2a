"""A preprocessor of mdBook: links as the book needs them, from files that also stand for themselves in the repository.

A chapter in docs/repository is a file elsewhere, taken in by `{{#include}}`; its links are seen from there. A link to a file that is a
chapter leads to the chapter, under its title where the link has no words but the file's name; one to a picture or a table inside docs
stays, and of any other file the book says where it is.
"""

import json
import os
import re
import sys
from pathlib import Path

DOCS = "docs"
INCLUDE = re.compile(r"\{\{#include (\S+)\}\}")
FENCE = re.compile(r"(^```.*?^```[^\n]*$)", re.MULTILINE | re.DOTALL)
TITLE = re.compile(r"^# (.+)$", re.MULTILINE)
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)")


def origins() -> dict[str, str]:
    """File of the repository -> chapter that takes it in, both from the root."""
    found = {}
    for chapter in sorted(Path(DOCS, "repository").glob("*.md")):
        target = INCLUDE.match(chapter.read_text()).group(1)
        found[os.path.normpath(chapter.parent / target)] = chapter.as_posix()
    return found


def title(file: str) -> str | None:
    found = TITLE.search(Path(file).read_text()) if file.endswith(".md") else None
    return found.group(1) if found else None


def link(match: re.Match[str], page: str, seen_from: str, taken: dict[str, str]) -> str:
    mark, text, target = match.groups()
    if "://" in target or target.startswith(("#", "mailto:")):
        return match.group(0)
    file, hash_mark, heading = target.partition("#")
    path = os.path.normpath(os.path.join(os.path.dirname(seen_from), file))
    if text == os.path.basename(path):
        text = title(path) or text
    path = taken.get(path, path)
    if path.startswith(DOCS + "/") and not os.path.isdir(path):
        # The page of a README is the index of its folder.
        path = re.sub(r"README\.md$", "index.md", path)
        return f"{mark}[{text}]({os.path.relpath(path, os.path.dirname(page))}{hash_mark}{heading})"
    return text if path in text else f"{text} (`{path}` in the repository)"


def rewrite(chapter: dict, taken: dict[str, str]) -> None:
    if chapter["path"]:
        page = f"{DOCS}/{chapter['path']}"
        seen_from = next((file for file, by in taken.items() if by == page), page)
        parts = FENCE.split(chapter["content"])
        parts[::2] = [LINK.sub(lambda match: link(match, page, seen_from, taken), part) for part in parts[::2]]
        chapter["content"] = "".join(parts)
    for item in chapter["sub_items"]:
        if "Chapter" in item:
            rewrite(item["Chapter"], taken)


def main() -> None:
    if sys.argv[1:2] == ["supports"]:
        return
    _, book = json.load(sys.stdin)
    taken = origins()
    for item in book["items"]:
        if "Chapter" in item:
            rewrite(item["Chapter"], taken)
    json.dump(book, sys.stdout)


if __name__ == "__main__":
    main()
