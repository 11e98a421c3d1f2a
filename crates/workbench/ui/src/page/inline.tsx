import { unitName } from "../format";

/** Marks within a text: code between backticks, plus-minus as one sign, units with their µ. */
export function Inline({ text }: { text: string }) {
  const parts = text.split("`");
  return <>{parts.map((part, index) => (index % 2 === 1 ? <code key={index}>{part}</code> : unitName(part).replaceAll("+-", "\u00b1")))}</>;
}
