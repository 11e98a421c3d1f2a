import { unitName } from "../format";
import { here } from "./here";

const MULTIPLE = "x noise";

/** Marks within a text, in words of this page: code between backticks, plus-minus as one sign, units with their µ, `x noise` with a sign. */
export function Inline({ text }: { text: string }) {
  if (text === MULTIPLE) return <>{text.replace("x", "\u00d7")}</>;
  const parts = here(text).split("`");
  return <>{parts.map((part, index) => (index % 2 === 1 ? <code key={index}>{part}</code> : unitName(part).replaceAll("+-", "\u00b1")))}</>;
}
