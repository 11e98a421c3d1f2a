/** Which file is what: by its content, then by its name. */
import { isSession } from "../files";
import type { FileText } from "../wire";

export type Role = "hexapod" | "data" | "holdout" | "term" | "session" | "none";

export interface NamedFile extends FileText {
  role: Role;
}

export const ROLES: { role: Role; title: string }[] = [
  { role: "hexapod", title: "machine (hexapod.toml)" },
  { role: "data", title: "measurements to fit" },
  { role: "holdout", title: "held-out measurements" },
  { role: "term", title: "your own term" },
  { role: "session", title: "saved session" },
  { role: "none", title: "not used" },
];

/** Adds files to those chosen, each with its role; a file of the same name is replaced. */
export function withFiles(old: NamedFile[], added: FileText[]): NamedFile[] {
  const files = old.filter(({ name }) => !added.some((file) => file.name === name));
  for (const file of added) files.push({ ...file, role: roleOf(file, files) });
  return files;
}

/** The role of a file beside those already there. */
export function roleOf(file: FileText, others: NamedFile[]): Role {
  if (/^\s*format\s*=\s*"hexapod\//m.test(file.text)) return "hexapod";
  if (/^\s*format\s*=\s*"term\//m.test(file.text)) return "term";
  if (isSession(file)) return "session";
  if (/\.toml$/i.test(file.name)) return others.some(({ role }) => role === "hexapod") ? "none" : "hexapod";
  if (!/\.(csv|txt|dat)$/i.test(file.name) && !file.text.includes(",")) return "none";
  if (/hold|valid|test/i.test(file.name)) return "holdout";
  return others.some(({ role }) => role === "data") ? "holdout" : "data";
}

/** What is still missing or given twice, in words; empty when the files can be opened. */
export function missing(files: NamedFile[]): string {
  const count = (role: Role) => files.filter((file) => file.role === role).length;
  if (count("hexapod") === 0) return "The machine file is missing (hexapod.toml).";
  if (count("data") === 0) return "The measurements are missing (measurements.csv).";
  if (count("hexapod") > 1) return "Two files are marked as the machine.";
  if (count("data") > 1) return "Two files are marked as measurements to fit.";
  if (count("holdout") > 1) return "Two files are marked as held out.";
  if (count("session") > 1) return "Two files are marked as a session.";
  return "";
}
