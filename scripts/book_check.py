"""Checks a built book: every link between its pages leads to a file and a heading. Usage: book_check.py FOLDER"""

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    def __init__(self, path: Path) -> None:
        super().__init__()
        self.links: list[str] = []
        self.ids: set[str] = set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            if name in ("href", "src") and value:
                self.links.append(value)
            elif name in ("id", "name") and value:
                self.ids.add(value)


def faults(folder: Path) -> tuple[int, list[str]]:
    # The page of all pages, for the printer, repeats the others; the page for missing addresses is for a server.
    paths = [path for path in folder.rglob("*.html") if path.name not in ("print.html", "404.html", "toc.html")]
    pages = {path.resolve(): Page(path) for path in paths}
    count, found = 0, []
    for path, page in pages.items():
        for target in page.links:
            parts = urlsplit(target)
            if parts.scheme or parts.netloc:
                continue
            count += 1
            file = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            heading = unquote(parts.fragment)
            if not file.is_file():
                found.append(f"{path.relative_to(folder.resolve())}: {target}: there is no such file")
            elif heading and file in pages and heading not in pages[file].ids:
                found.append(f"{path.relative_to(folder.resolve())}: {target}: there is no such heading")
    return count, found


def main() -> None:
    count, found = faults(Path(sys.argv[1]))
    print("\n".join(found))
    print(f"{count} links between pages, {len(found)} lead nowhere")
    sys.exit(bool(found) or count == 0)


if __name__ == "__main__":
    main()
