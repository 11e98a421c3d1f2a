/** Light and dark: as the system says, or as chosen; light on paper. */
import { useEffect, useState } from "preact/hooks";

export type Theme = "auto" | "light" | "dark";

const KEY = "hexbench-theme";
const system = matchMedia("(prefers-color-scheme: dark)");
const listeners = new Set<() => void>();
const paper = matchMedia("print");
for (const query of [system, paper]) query.addEventListener("change", tell);

export function chosenTheme(): Theme {
  const theme = localStorage.getItem(KEY);
  return theme === "light" || theme === "dark" ? theme : "auto";
}

export function isDark(): boolean {
  if (paper.matches) return false;
  const theme = chosenTheme();
  return theme === "auto" ? system.matches : theme === "dark";
}

export function applyTheme(): void {
  document.documentElement.dataset.theme = isDark() ? "dark" : "light";
}

export function chooseTheme(theme: Theme): void {
  localStorage.setItem(KEY, theme);
  tell();
}

function tell(): void {
  applyTheme();
  for (const listener of listeners) listener();
}

/** True while the page is dark; the component is drawn again when that changes. */
export function useDark(): boolean {
  const [dark, setDark] = useState(isDark());
  useEffect(() => {
    const listener = () => setDark(isDark());
    listeners.add(listener);
    return () => {
      listeners.delete(listener);
    };
  }, []);
  return dark;
}
