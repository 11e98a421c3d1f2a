/** Files that the user hands to the page. */
import type { FileText } from "./wire";

/** Their texts, byte for byte: a mark at their beginning is kept, so that their digest is that of the file. */
export function textsOf(files: Iterable<File>): Promise<FileText[]> {
  return Promise.all(
    [...files].map(async (file) => {
      const text = new TextDecoder("utf-8", { ignoreBOM: true }).decode(await file.arrayBuffer());
      return { name: file.name, text };
    }),
  );
}

/** Is it a session that the workbench has saved? */
export function isSession({ text }: FileText): boolean {
  return /^\s*\{\s*"format"\s*:\s*"session\//.test(text);
}
