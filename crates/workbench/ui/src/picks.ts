/** What is picked, and how clicks, rectangles and keys change it. */
import type { Which } from "./charts/readings";
import type { Part, Pick } from "./state";
import type { Store } from "./store";

/** Acts of a chart on what is picked; `more`: beside what is picked already. */
export interface Picking {
  one: (index: number, more: boolean) => void;
  many: (all: number[], more: boolean) => void;
  next: (by: 1 | -1, more: boolean) => void;
}

/** Those of one kind that are picked. */
export function allOf(picked: Pick | null, which: Which): number[] {
  return picked?.which === which ? picked.all : [];
}

/** The one looked at. */
export function leadOf(picked: Pick | null, which: Which): number | null {
  return allOf(picked, which).at(-1) ?? null;
}

/** One condition; with `more` it comes to those picked, or leaves them. */
export function withOne(picked: Pick | null, which: Which, index: number, more: boolean): Pick | null {
  const before = more ? allOf(picked, which) : [];
  const others = before.filter((other) => other !== index);
  return pickOf(which, before.includes(index) ? others : [...others, index]);
}

/** Several conditions; with `more` they come to those picked. */
export function withMany(picked: Pick | null, which: Which, all: number[], more: boolean): Pick | null {
  const before = more ? allOf(picked, which) : [];
  return pickOf(which, [...new Set([...before, ...all])]);
}

/** The condition before or behind the one looked at; with `more` the others stay, and going back gives up the last one. */
export function stepped(picked: Pick | null, which: Which, count: number, by: 1 | -1, more: boolean): Pick | null {
  const all = allOf(picked, which);
  const lead = leadOf(picked, which);
  if (lead === null) return pickOf(which, count > 0 ? [by > 0 ? 0 : count - 1] : []);
  const next = Math.min(Math.max(lead + by, 0), count - 1);
  if (!more) return pickOf(which, [next]);
  const back = next !== lead && all.includes(next);
  const kept = all.filter((other) => other !== next && !(back && other === lead));
  return pickOf(which, [...kept, next]);
}

/** Those that a part of the machine stands for; what is picked by that part is taken back. */
export function withPart(picked: Pick | null, part: Part, all: number[]): Pick | null {
  if (isPart(picked, part)) return null;
  const pick = pickOf("fitted", all);
  return pick && { ...pick, part };
}

/** Are the readings picked those of this part? */
export function isPart(picked: Pick | null, part: Part): boolean {
  return picked?.part !== undefined && JSON.stringify(picked.part) === JSON.stringify(part);
}

/** Another one of those picked is looked at. */
export function turned(picked: Pick): Pick {
  const [first, ...rest] = picked.all;
  return first === undefined ? picked : { ...picked, all: [...rest, first] };
}

function pickOf(which: Which, all: number[]): Pick | null {
  return all.length === 0 ? null : { which, all };
}

/** Picking in a chart of these conditions; several points of a chart may be one condition. */
export function picking(store: Store, which: Which, count: number): Picking {
  const picked = () => store.get().bench?.picked ?? null;
  const condition = (index: number) => index % Math.max(1, count);
  return {
    one: (index, more) => store.pick(withOne(picked(), which, condition(index), more)),
    many: (all, more) =>
      store.pick(
        withMany(
          picked(),
          which,
          [...new Set(all.map(condition))].sort((a, b) => a - b),
          more,
        ),
      ),
    next: (by, more) => store.pick(stepped(picked(), which, count, by, more)),
  };
}
