"""Writes the parts of a package as CycloneDX 1.6 (JSON): every crate that is built into it. Usage: sbom.py PACKAGE OUTPUT"""

import json
import subprocess
import sys


def metadata() -> dict:
    command = ["cargo", "metadata", "--format-version", "1", "--locked"]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def built_in(graph: dict, start: str) -> list[str]:
    """Ids of all packages that one is made of: its dependencies, not those of its tests and build scripts."""
    nodes = {node["id"]: node for node in graph["resolve"]["nodes"]}
    found, waiting = [], [start]
    while waiting:
        here = waiting.pop()
        if here in found:
            continue
        found.append(here)
        for dependency in nodes[here]["deps"]:
            if any(kind["kind"] is None for kind in dependency["dep_kinds"]):
                waiting.append(dependency["pkg"])
    return found


def component(package: dict, kind: str) -> dict:
    name, version = package["name"], package["version"]
    reference = f"pkg:cargo/{name}@{version}"
    entry = {"type": kind, "bom-ref": reference, "name": name, "version": version, "purl": reference}
    if package["license"]:
        entry["licenses"] = [{"expression": package["license"].replace("/", " OR ")}]
    return entry


def main() -> None:
    name, output = sys.argv[1:]
    graph = metadata()
    packages = {package["id"]: package for package in graph["packages"]}
    start = next(i for i, package in packages.items() if package["name"] == name and package["source"] is None)
    parts = sorted((packages[i] for i in built_in(graph, start) if i != start), key=lambda p: (p["name"], p["version"]))
    bill = {
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": {"component": component(packages[start], "application")},
        "components": [component(package, "library") for package in parts],
    }
    with open(output, "w") as file:
        json.dump(bill, file, indent=2)
        file.write("\n")
    print(f"{output}: {len(parts)} parts of {name} {packages[start]['version']}")


if __name__ == "__main__":
    main()
