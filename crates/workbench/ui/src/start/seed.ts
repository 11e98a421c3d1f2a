/** Seeds as typed. */

/** A whole number, or null for an empty field (the server draws one). */
export function seedOf(text: string): number | null {
  return text.trim() === "" ? null : Number(text);
}
