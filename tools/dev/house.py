#!/usr/bin/env python3
"""Draws docs/house.svg, the parts of the project with their sizes and who uses whom, from what CMake knows of the build.

    house.py BUILD            draws it; BUILD is a build folder
    house.py BUILD --check    exit 1 and the difference where the picture shows other parts or other uses than the build
"""
import json
import re
import subprocess
import sys
from pathlib import Path

import folders

ROOT = Path(__file__).resolve().parents[2]
PICTURE = ROOT / "docs/house.svg"
# Parts of the picture; a folder belongs to the one with the longest fitting name. Two programs of machine read sources.
READERS = "machine/rung-compile, rungctl"
PARTS = ("tools", READERS, "machine", "sim", "compiler", "codegen", "frontend", "ir", "rtlib")
assert {*PARTS} == {*folders.PRODUCT, READERS}, "a folder at the top has no place in the picture"
FOLDERS = {**{part: part for part in PARTS if part != READERS}, "machine/rung-compile": READERS, "machine/rungctl": READERS}
SUFFIXES = {".h", ".hpp", ".cpp", ".c", ".def", ".py"}
WIDTH, GAP, LINE, ROW_GAP, MARGIN = 1000, 18, 17, 58, 14


def fail(text):
    print(f"house.py: {text}", file=sys.stderr)
    sys.exit(1)


def targets(build):
    """{identity: target} of CMake's file API."""
    folder = build / ".cmake/api/v1"
    if not (folder / "query/codemodel-v2").exists():  # ./dev asks before it configures
        (folder / "query").mkdir(parents=True, exist_ok=True)
        (folder / "query/codemodel-v2").touch()
        if subprocess.run(["cmake", str(build)], stdout=subprocess.DEVNULL).returncode != 0:
            fail(f"{build} cannot be configured")
    reply = max((folder / "reply").glob("codemodel-v2-*.json"), key=lambda path: path.stat().st_mtime)
    listed = json.loads(reply.read_text())["configurations"][0]["targets"]
    return {one["id"]: json.loads((reply.parent / one["jsonFile"]).read_text()) for one in listed}


def part_of(folder):
    fitting = [one for one in FOLDERS if folder == one or folder.startswith(one + "/")]
    return FOLDERS[max(fitting, key=len)] if fitting else None


def uses(all_targets):
    """{part: parts that something in it links}"""
    found = {part: set() for part in PARTS}
    for target in all_targets.values():
        source = part_of(target["paths"]["source"])
        for dependency in target.get("dependencies", ()):
            used = part_of(all_targets[dependency["id"]]["paths"]["source"])
            if source and used and source != used:
                found[source].add(used)
    return found


def direct(found):
    """Without what follows from the others: tools use ir by way of frontend."""
    reachable = {part: set() for part in found}

    def reach(part):
        for used in found[part]:
            if used not in reachable[part]:
                reachable[part] |= {used} | reach(used)
        return reachable[part]

    for part in found:
        reach(part)
    return {part: {used for used in parts if not any(used in reachable[other] for other in parts if other != used)}
            for part, parts in found.items()}


def sizes():
    """{part: {folder in it: lines}}"""
    found = {part: {} for part in PARTS}
    for name in subprocess.run(["git", "-C", str(ROOT), "ls-files", *folders.PRODUCT], check=True,
                               capture_output=True, text=True).stdout.split("\n"):
        path = Path(name)
        part = part_of(str(path.parent)) if path.suffix in SUFFIXES else None
        if part is None:
            continue
        below = path.parent.parts[1:]
        folder = below[0] if below and part != READERS else ""
        with open(ROOT / name, "rb") as file:
            found[part][folder] = found[part].get(folder, 0) + sum(1 for _ in file)
    return found


def rows(edges):
    """Parts by height: a part is above those that it uses."""
    height = {}

    def of(part):
        if part not in height:
            height[part] = 1 + max((of(used) for used in edges[part]), default=-1)
        return height[part]

    for part in PARTS:
        of(part)
    return [[part for part in PARTS if height[part] == row] for row in range(max(height.values()), -1, -1)]


def shown(lines):
    return f"{lines / 1000:.1f}k".replace(".0k", "k")


def box(part, inside, x, y, width, height):
    total = sum(inside.values())
    out = [f'<rect x="{x}" y="{y}" width="{width}" height="{height}" rx="6"/>',
           f'<text class="name" x="{x + 12}" y="{y + 21}">{part} <tspan class="lines">{shown(total)} lines</tspan></text>']
    for number, text in enumerate(wrapped(inside, width)):
        out.append(f'<text class="folders" x="{x + 12}" y="{y + 42 + number * LINE}">{text}</text>')
    return out


def wrapped(inside, width):
    """The folders inside it with their sizes, as lines that fit."""
    texts = [f"{name} {shown(lines)}" for name, lines in sorted(inside.items()) if name]
    lines = [""]
    for text in texts:
        if lines[-1] and (len(lines[-1]) + len(text) + 3) * 7.0 > width - 24:
            lines.append("")
        lines[-1] += (" · " if lines[-1] else "") + text
    return lines if texts else []


def draw(edges, inside):
    places, out, y = {}, [], MARGIN
    for row in rows(edges):
        width = (WIDTH - 2 * MARGIN - GAP * (len(row) - 1)) // len(row)
        height = max(34 + LINE * len(wrapped(inside[part], width)) for part in row)
        for number, part in enumerate(row):
            x = MARGIN + number * (width + GAP)
            places[part] = (x, y, width, height)
            out += box(part, inside[part], x, y, width, height)
        y += height + ROW_GAP
    arrows = []
    for part, used_parts in edges.items():
        for number, used in enumerate(sorted(used_parts, key=lambda one: places[one][0])):
            x, top, width, height = places[part]
            to_x, to_top, to_width, _ = places[used]
            begin = x + width * (number + 1) // (len(used_parts) + 1)
            end = min(max(begin, to_x + 20), to_x + to_width - 20)
            arrows.append(f'<path d="M{begin} {top + height} L{end} {to_top - 4}"/>')
    state = json.dumps({part: sorted(parts) for part, parts in edges.items()})
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {y - ROW_GAP + MARGIN}" font-family="sans-serif">',
        f"<metadata>{state}</metadata>",
        "<style>rect{fill:#f4f6f8;stroke:#5b6b7b}path{stroke:#5b6b7b;fill:none;marker-end:url(#tip)}.name{font-size:16px;"
        "font-weight:bold;fill:#1d2733}.lines{font-weight:normal;font-size:13px;fill:#5b6b7b}.folders{font-size:13px;"
        "fill:#1d2733}</style>",
        '<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="8" markerHeight="8" orient="auto">'
        '<path d="M0 0 L8 4 L0 8 z" style="fill:#5b6b7b;stroke:none;marker-end:none"/></marker></defs>',
        f'<rect width="{WIDTH}" height="{y - ROW_GAP + MARGIN}" style="fill:#fff;stroke:none"/>', *arrows, *out, "</svg>", ""])


def main():
    if len(sys.argv) < 2:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    edges = direct(uses(targets(Path(sys.argv[1]))))
    if "--check" in sys.argv:
        drawn = json.loads(re.search(r"<metadata>(.*)</metadata>", PICTURE.read_text())[1])
        now = {part: sorted(parts) for part, parts in edges.items()}
        for part in PARTS:
            if drawn.get(part) != now[part]:
                print(f"{part} uses {now[part]}, the picture shows {drawn.get(part)}: tools/dev/house.py BUILD draws it anew")
        return int(drawn != now)
    PICTURE.write_text(draw(edges, sizes()))
    return 0


if __name__ == "__main__":
    sys.exit(main())
