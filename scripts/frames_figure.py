"""Writes docs/guide/frames.svg: frames, joints, zero pose and signs. With --check it only says whether the file is as it would be."""

import math
import sys
from pathlib import Path

OUTPUT = Path(__file__).parent.parent / "docs/guide/frames.svg"
WIDTH, HEIGHT = 860, 490
INK, SOFT, BASE, PLATFORM, LOAD, MOTION = "#1b1f24", "#8a929b", "#33658a", "#b3541e", "#a4133c", "#3a6b35"
AZIMUTH, ELEVATION = math.radians(-62), math.radians(22)
POSE = (38.0, 30.0, 44.0, 9.0, -13.0, 16.0)

Point = tuple[float, float, float]


def ring(radius: float, gap: float, first: float, z: float) -> list[Point]:
    """Six joints in pairs, the pairs 120 degrees apart, the gap within a pair."""
    angles = [first + 120 * pair + side * gap / 2 for pair in range(3) for side in (-1, 1)]
    return [(radius * math.cos(math.radians(t)), radius * math.sin(math.radians(t)), z) for t in angles]


BASE_JOINTS = ring(160, 20, 0, -165)
# The platform's pairs join legs 2 and 3, 4 and 5, 6 and 1.
PAIRS = ring(120, 20, 60, 0)
PLATFORM_JOINTS = [PAIRS[5], *PAIRS[:5]]


def turned(point: Point, pose: tuple[float, ...]) -> Point:
    a, b, c, alpha, beta, gamma = pose[0], pose[1], pose[2], *map(math.radians, pose[3:])
    x, y, z = point
    y, z = y * math.cos(alpha) - z * math.sin(alpha), y * math.sin(alpha) + z * math.cos(alpha)
    x, z = x * math.cos(beta) + z * math.sin(beta), -x * math.sin(beta) + z * math.cos(beta)
    x, y = x * math.cos(gamma) - y * math.sin(gamma), x * math.sin(gamma) + y * math.cos(gamma)
    return x + a, y + b, z + c


class Drawing:
    def __init__(self) -> None:
        self.parts: list[str] = []
        self.center = (0.0, 0.0)

    def at(self, point: Point) -> tuple[float, float]:
        x, y, z = point
        right = -x * math.sin(AZIMUTH) + y * math.cos(AZIMUTH)
        depth = x * math.cos(AZIMUTH) + y * math.sin(AZIMUTH)
        up = z * math.cos(ELEVATION) - depth * math.sin(ELEVATION)
        return self.center[0] + right, self.center[1] - up

    def line(self, start: Point, end: Point, color: str, width: float, extra: str = "") -> None:
        (x1, y1), (x2, y2) = self.at(start), self.at(end)
        self.parts.append(
            f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{color}" stroke-width="{width}"{extra}/>'
        )

    def arrow(self, start: Point, end: Point, color: str, width: float = 2) -> None:
        self.line(start, end, color, width, f' marker-end="url(#{color[1:]})"')

    def polygon(self, points: list[Point], color: str) -> None:
        corners = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(self.at, points))
        self.parts.append(
            f'<polygon points="{corners}" fill="{color}" fill-opacity="0.10" stroke="{color}" stroke-width="1.4"/>'
        )

    def dot(self, point: Point, color: str) -> None:
        x, y = self.at(point)
        self.parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.6" fill="{color}"/>')

    def name(self, point: Point, words: str, color: str, dx: float = 0, dy: float = 0) -> None:
        x, y = self.at(point)
        self.write(x + dx, y + dy, words, color, "middle")

    def write(self, x: float, y: float, words: str, color: str, anchor: str = "start", size: int = 13) -> None:
        self.parts.append(
            f'<text x="{x:.1f}" y="{y:.1f}" fill="{color}" font-size="{size}" text-anchor="{anchor}">{words}</text>'
        )


def outward(point: Point, by: float) -> tuple[float, float]:
    """Shift of a name on the page, away from the middle of its ring."""
    flat = Drawing()
    (x, y), (cx, cy) = flat.at(point), flat.at((0, 0, point[2]))
    length = math.hypot(x - cx, y - cy) or 1
    return by * (x - cx) / length, by * (y - cy) / length + 4.5


def machine(drawing: Drawing, pose: tuple[float, ...], is_named: bool) -> list[Point]:
    joints = [turned(joint, pose) for joint in PLATFORM_JOINTS]
    drawing.polygon(BASE_JOINTS, BASE)
    for start, end in zip(BASE_JOINTS, joints):
        drawing.line(start, end, SOFT, 3.2, ' stroke-linecap="round"')
    drawing.polygon(joints, PLATFORM)
    for number, (start, end) in enumerate(zip(BASE_JOINTS, joints), 1):
        drawing.dot(start, BASE)
        drawing.dot(end, PLATFORM)
        if is_named:
            dx, dy = outward(start, 16)
            drawing.name(start, f"A{number}", BASE, dx, dy)
            dx, dy = outward(end, 15)
            drawing.name(end, f"B{number}", PLATFORM, dx, dy)
    return joints


def axes(drawing: Drawing, pose: tuple[float, ...], color: str, mark: str, length: float) -> None:
    origin = turned((0, 0, 0), pose)
    for word, tip in zip("xyz", ((length, 0, 0), (0, length, 0), (0, 0, length))):
        end = turned(tip, pose)
        drawing.arrow(origin, end, color)
        (x, y), (x0, y0) = drawing.at(end), drawing.at(origin)
        stretch = 13 / (math.hypot(x - x0, y - y0) or 1)
        drawing.write(x + stretch * (x - x0), y + stretch * (y - y0) + 4, word + mark, color, "middle")


def left(drawing: Drawing) -> None:
    drawing.center = (215, 210)
    drawing.write(24, 30, "zero pose: both frames coincide", INK, size=15)
    machine(drawing, (0,) * 6, True)
    axes(drawing, (0,) * 6, INK, "", 78)
    drawing.write(24, 446, "A1 to A6: base joints, fixed frame", BASE)
    drawing.write(24, 468, "B1 to B6: platform joints of the same legs, mobile frame", PLATFORM)


def right(drawing: Drawing) -> None:
    drawing.center = (640, 210)
    drawing.write(450, 30, "a pose, exaggerated", INK, size=15)
    joints = machine(drawing, POSE, False)
    axes(drawing, (0,) * 6, INK, "", 62)
    axes(drawing, POSE, PLATFORM, "'", 78)
    origin = turned((0, 0, 0), POSE)
    drawing.arrow((0, 0, 0), origin, MOTION, 2.4)
    drawing.name((POSE[0] / 2, POSE[1] / 2, POSE[2] / 2), "a, b, c", MOTION, -52, 2)
    drawing.arrow(origin, (origin[0], origin[1], origin[2] - 96), LOAD, 2.6)
    drawing.name((origin[0], origin[1], origin[2] - 96), "fz &lt; 0", LOAD, 28, 8)
    start, end = BASE_JOINTS[0], joints[0]
    for low, high in ((0.30, 0.08), (0.70, 0.92)):
        along = [tuple(s + t * (e - s) for s, e in zip(start, end)) for t in (low, high)]
        drawing.arrow(along[0], along[1], INK, 2.4)
    drawing.name(start, "leg force &gt; 0: tension", INK, -30, 24)
    drawing.write(450, 446, "a, b, c: mobile origin in the fixed frame", MOTION)
    drawing.write(450, 468, "wrench: acts on the platform at the mobile origin, fixed axes", LOAD)


def figure() -> str:
    drawing = Drawing()
    left(drawing)
    right(drawing)
    markers = "".join(
        f'<marker id="{color[1:]}" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="9" markerHeight="9" '
        f'markerUnits="userSpaceOnUse" orient="auto"><path d="M0 1.2 10 5 0 8.8z" fill="{color}"/></marker>'
        for color in (INK, PLATFORM, LOAD, MOTION)
    )
    body = "\n".join(drawing.parts)
    title = "Frames, joints, zero pose and signs of a hexapod"
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" role="img">\n'
        f"<title>{title}</title>\n<defs>{markers}</defs>\n"
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>\n{body}\n</svg>\n'
    )


def main() -> None:
    fresh = figure()
    if "--check" not in sys.argv:
        OUTPUT.write_text(fresh)
    elif OUTPUT.read_text() != fresh:
        sys.exit(f"{OUTPUT} is stale: python3 scripts/frames_figure.py")


if __name__ == "__main__":
    main()
