/** What is wider than its place is scrolled sideways, by keyboard too. */
import { useLayoutEffect, useRef, useState } from "preact/hooks";

export function Scroll({ label, children }: { label: string; children: preact.ComponentChildren }) {
  const box = useRef<HTMLDivElement>(null);
  const [wide, setWide] = useState(false);
  useLayoutEffect(() => {
    const element = box.current;
    if (element === null) return;
    const measure = () => setWide(element.scrollWidth > element.clientWidth);
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    return () => observer.disconnect();
  }, []);
  const focusable = wide ? { tabIndex: 0, role: "group" as const, "aria-label": label } : {};
  return (
    <div ref={box} class="scroll" {...focusable}>
      {children}
    </div>
  );
}
