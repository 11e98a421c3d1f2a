/** Term files (term/1): the simple ones a form can show, and how a form writes one. */

export interface Parameter {
  name: string;
  unit: string;
  /** Its physically sensible size, in that unit. */
  scale: string;
  /** How many of the unit make one SI unit; empty when the unit tells. */
  perSi: string;
  /** Negative values have no meaning. */
  positive: boolean;
}

/** What the form holds; numbers as typed. */
export interface OwnTerm {
  id: string;
  title: string;
  elongation: string;
  parameters: Parameter[];
}

/** Id in a term file; empty when there is none. */
export function idOf(text: string): string {
  return topLevel(text, "id");
}

/** Title in a term file; its id when there is none. */
export function titleOf(text: string): string {
  return topLevel(text, "title") || idOf(text);
}

function topLevel(text: string, key: string): string {
  return new RegExp(`^\\s*${key}\\s*=\\s*"([^"]*)"`, "m").exec(text)?.[1] ?? "";
}

/** The file of a form. */
export function written(term: OwnTerm): string {
  const head = [`format = "term/1"`, `id = ${quoted(term.id)}`, `title = ${quoted(term.title)}`, `elongation = ${quoted(term.elongation)}`];
  return `${[...head, ...term.parameters.flatMap(lines)].join("\n")}\n`;
}

function lines({ name, unit, scale, perSi, positive }: Parameter): string[] {
  return [
    "",
    "[[parameters]]",
    `name = ${quoted(name)}`,
    `unit = ${quoted(unit)}`,
    ...(perSi.trim() === "" ? [] : [`per_si = ${perSi.trim()}`]),
    `scale = ${scale.trim() || "1"}`,
    ...(positive ? ["positive = true"] : []),
  ];
}

function quoted(text: string): string {
  return JSON.stringify(text);
}

const LINE = /^\s*(\w+)\s*=\s*("(?:[^"\\]|\\.)*"|[-+\d.eE_]+|true|false)\s*(?:#.*)?$/;

/** The form of a file, or null when the file says more than the form can show. */
export function parsed(text: string): OwnTerm | null {
  const head: Record<string, string> = {};
  const parameters: Record<string, string>[] = [];
  for (const line of text.split(/\r?\n/)) {
    if (/^\s*(#.*)?$/.test(line)) continue;
    if (/^\s*\[\[parameters\]\]\s*(#.*)?$/.test(line)) {
      parameters.push({});
      continue;
    }
    const [, key, value] = LINE.exec(line) ?? [];
    if (key === undefined || value === undefined) return null;
    const read = unquoted(value);
    if (read === null) return null;
    (parameters.at(-1) ?? head)[key] = read;
  }
  if (!only(head, ["format", "id", "title", "elongation"])) return null;
  if (!parameters.every((parameter) => only(parameter, ["name", "unit", "scale", "per_si", "positive"]))) return null;
  return {
    id: head.id ?? "",
    title: head.title ?? "",
    elongation: head.elongation ?? "",
    parameters: parameters.map(({ name = "", unit = "", scale = "", per_si: perSi = "", positive }) => ({
      name,
      unit,
      scale,
      perSi,
      positive: positive === "true",
    })),
  };
}

function unquoted(value: string): string | null {
  if (!value.startsWith('"')) return value;
  try {
    return JSON.parse(value) as string;
  } catch {
    return null;
  }
}

function only(table: Record<string, string>, keys: string[]): boolean {
  return Object.keys(table).every((key) => keys.includes(key));
}

/** Line and column (from 1) that an error message names. */
export function placeIn(message: string): { line: number; column: number } | null {
  const line = /\bline (\d+)/.exec(message)?.[1];
  if (line === undefined) return null;
  return { line: Number(line), column: Number(/\bcol(?:umn)? (\d+)/.exec(message)?.[1] ?? "1") };
}

/** Where a message points in a text: offsets of the line and column it names, else of the words it quotes; null for neither. */
export function pointedAt(text: string, message: string): [number, number] | null {
  const place = placeIn(message);
  if (place !== null) {
    const from = Math.min(offsetOf(text, place), text.length);
    return [from, Math.min(from + 1, text.length)];
  }
  const words = /`([^`]+)`/.exec(message)?.[1] ?? "";
  const from = words === "" ? -1 : text.indexOf(words);
  return from < 0 ? null : [from, from + words.length];
}

/** Offset of a place in a text. */
export function offsetOf(text: string, place: { line: number; column: number }): number {
  const before = text.split("\n").slice(0, place.line - 1);
  return before.reduce((sum, line) => sum + line.length + 1, 0) + place.column - 1;
}
