/** What is wider than its place is scrolled sideways, by keyboard too; a table that `stacks` stands row by row instead. */
import { useLayoutEffect, useRef, useState } from "preact/hooks";

interface Props {
  label: string;
  stacks?: boolean;
  children: preact.ComponentChildren;
}

export function Scroll({ label, stacks = false, children }: Props) {
  const box = useRef<HTMLDivElement>(null);
  // Width as a table: known only while it is one.
  const needed = useRef(0);
  const [wide, setWide] = useState(false);
  const stacked = stacks && wide;
  useLayoutEffect(() => {
    const element = box.current;
    if (element === null) return;
    const measure = () => {
      // Nothing is known of what is folded away.
      if (!element.checkVisibility()) return;
      if (!stacked) needed.current = element.scrollWidth;
      setWide(needed.current > element.clientWidth);
    };
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    return () => observer.disconnect();
  }, [stacked]);
  const focusable = wide && !stacked ? { tabIndex: 0, role: "group" as const, "aria-label": label } : {};
  return (
    <div ref={box} class={stacked ? "scroll stacked" : "scroll"} {...focusable}>
      {children}
    </div>
  );
}
