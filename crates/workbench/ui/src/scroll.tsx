/** What is wider than its place is scrolled sideways, by keyboard too; on a phone a table that `stacks` stands row by row. */
import { useLayoutEffect, useRef, useState } from "preact/hooks";

interface Props {
  label: string;
  stacks?: boolean;
  children: preact.ComponentChildren;
}

/** The breakpoint of app.css. */
const NARROW = "(max-width: 860px)";

export function Scroll({ label, stacks = false, children }: Props) {
  const box = useRef<HTMLDivElement>(null);
  // Width as a table: known only while it is one.
  const needed = useRef(0);
  const [shape, setShape] = useState<"fits" | "scrolls" | "stacked">("fits");
  useLayoutEffect(() => {
    const element = box.current;
    if (element === null) return;
    const measure = () => {
      // Nothing is known of what is folded away.
      if (!element.checkVisibility()) return;
      if (shape !== "stacked") needed.current = element.scrollWidth;
      const isWide = needed.current > element.clientWidth;
      const wide = stacks && matchMedia(NARROW).matches ? "stacked" : "scrolls";
      setShape(isWide ? wide : "fits");
    };
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    return () => observer.disconnect();
  }, [stacks, shape]);
  const focusable = shape === "scrolls" ? { tabIndex: 0, role: "group" as const, "aria-label": label } : {};
  return (
    <div ref={box} class={shape === "stacked" ? "scroll stacked" : "scroll"} {...focusable}>
      {children}
    </div>
  );
}
