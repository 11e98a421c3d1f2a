/** Marks within a text: code between backticks, plus-minus as one sign. */
export function Inline({ text }: { text: string }) {
  const parts = text.split("`");
  return <>{parts.map((part, index) => (index % 2 === 1 ? <code key={index}>{part}</code> : part.replaceAll("+-", "\u00b1")))}</>;
}
