import assert from "node:assert/strict";
import { test } from "node:test";
import report from "../../../../report/templates/report.css";
import css from "../../src/app.css";
import { type Looks, looks, MARKERS } from "../../src/charts/looks";

type Rgb = [number, number, number];

/** Least difference in CIELAB (76) for an eye without green cones, and in lightness on a print without color. */
const LEAST_DEUTERANOPE = 30;
const LEAST_GRAY = 7;

/** Linear light of `#rrggbb`. */
function linear(color: string): Rgb {
  const part = (at: number) => {
    const value = Number.parseInt(color.slice(at, at + 2), 16) / 255;
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  };
  return [part(1), part(3), part(5)];
}

function times(rows: Rgb[], [r, g, b]: Rgb): Rgb {
  return rows.map(([x, y, z]) => x * r + y * g + z * b) as Rgb;
}

/** What a deuteranope sees: Machado, Oliveira and Fernandes (2009), severity 1, of linear light. */
function deuteranope(light: Rgb): Rgb {
  const seen = times(
    [
      [0.367322, 0.860646, -0.227968],
      [0.280085, 0.672501, 0.047413],
      [-0.01182, 0.04294, 0.968881],
    ],
    light,
  );
  return seen.map((value) => Math.min(1, Math.max(0, value))) as Rgb;
}

/** CIELAB under D65. */
function lab(light: Rgb): Rgb {
  const [x, y, z] = times(
    [
      [0.4124, 0.3576, 0.1805],
      [0.2126, 0.7152, 0.0722],
      [0.0193, 0.1192, 0.9505],
    ],
    light,
  );
  const root = (t: number) => (t > 0.008856 ? Math.cbrt(t) : 7.787 * t + 16 / 116);
  const [a, b, c] = [root(x / 0.9505), root(y), root(z / 1.089)];
  return [116 * b - 16, 500 * (a - b), 200 * (b - c)];
}

function distance(a: string, b: string, seen: (light: Rgb) => Rgb): number {
  const [p, q] = [lab(seen(linear(a))), lab(seen(linear(b)))];
  return Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

function lightness(color: string): number {
  return lab(linear(color))[0];
}

/** Variables of a theme of the style sheet. */
function variables(dark: boolean): Record<string, string> {
  const block = css.slice(css.indexOf(dark ? ':root[data-theme="dark"]' : ":root"));
  const body = block.slice(0, block.indexOf("}"));
  return Object.fromEntries([...body.matchAll(/--([\w-]+):\s*(#[0-9a-f]{6})/g)].map(([, name = "", color = ""]) => [name, color]));
}

/** Variables of the style sheet of the report, `light-dark(...)` each. */
function ofReport(dark: boolean): Record<string, string> {
  const all = report.matchAll(/--(\w+): light-dark\((#[0-9a-f]{6}), (#[0-9a-f]{6})\)/g);
  return Object.fromEntries([...all].map(([, name = "", light = "", other = ""]) => [name, dark ? other : light]));
}

/** Pairs that nothing but color parts: also seen in gray. */
function byColor(look: Looks, page: Record<string, string>): [string, string, string][] {
  const of = (name: string) => page[name] ?? "";
  return [
    ["the model now, the springs alone", look.now, look.before],
    ["a leg too long, a leg too short", look.longer, look.shorter],
    ["a leg too long, one that is right", look.longer, look.grid],
    ["a leg too short, one that is right", look.shorter, look.grid],
    ["measured, predicted", look.ink, look.now],
    ["measured, the springs alone", look.ink, look.before],
    ["a bar at the noise, one above it", of("green"), of("orange")],
    ["what an effect explains, what the springs miss", of("blue"), of("orange")],
  ];
}

/** Pairs with another mark or dash as well. */
function byMarkToo(look: Looks): [string, string, string][] {
  return [
    ["the model now, what noise gives", look.now, look.grey],
    ["the springs alone, what noise gives", look.before, look.grey],
    ...[look.longer, look.shorter].flatMap((leg): [string, string, string][] => [
      ["a leg, the platform now", leg, look.now],
      ["a leg, the platform on springs alone", leg, look.before],
      ["a leg, the platform measured", leg, look.ink],
    ]),
  ];
}

for (const dark of [false, true]) {
  const theme = dark ? "dark" : "light";
  const [look, page] = [looks(dark), variables(dark)];

  test(`${theme}: colors that mean different things differ for a deuteranope, and without a mark of their own also in gray`, () => {
    for (const [what, a, b] of [...byColor(look, page), ...byMarkToo(look)]) {
      const far = distance(a, b, deuteranope);
      assert.ok(far >= LEAST_DEUTERANOPE, `${what} (${a}, ${b}): ${far.toFixed(1)} for a deuteranope`);
    }
    for (const [what, a, b] of byColor(look, page)) {
      const far = Math.abs(lightness(a) - lightness(b));
      assert.ok(far >= LEAST_GRAY, `${what} (${a}, ${b}): ${far.toFixed(1)} in gray`);
    }
  });

  test(`${theme}: in the report as well`, () => {
    const of = ofReport(dark);
    for (const [a, b] of [
      ["blue", "red"],
      ["good", "bad"],
    ] as const) {
      const [one, other] = [of[a] ?? "", of[b] ?? ""];
      const [seen, gray] = [distance(one, other, deuteranope), Math.abs(lightness(one) - lightness(other))];
      assert.ok(
        seen >= LEAST_DEUTERANOPE && gray >= LEAST_GRAY,
        `${a} ${one}, ${b} ${other}: ${seen.toFixed(1)}, in gray ${gray.toFixed(1)}`,
      );
    }
  });

  test(`${theme}: charts and page have the same blue and orange`, () => {
    assert.deepEqual([look.now, look.before, look.paper], [page.blue, page.orange, page.paper]);
    assert.deepEqual([look.longer, look.shorter], [page.longer, page.shorter]);
  });
}

test("the check itself sees colors that a deuteranope cannot tell apart", () => {
  assert.ok(distance("#009e73", "#e3e3e3", (light) => light) > 50);
  assert.ok(distance("#a3a355", "#c78f55", deuteranope) < LEAST_DEUTERANOPE);
});

test("six legs have six markers", () => {
  assert.equal(new Set(MARKERS).size, 6);
});
