/** Chooses light or dark. */
import { useState } from "preact/hooks";
import { chooseTheme, chosenTheme, type Theme } from "./theme";

export function ThemeSwitch() {
  const [theme, setTheme] = useState(chosenTheme());
  const choose = (next: Theme) => {
    chooseTheme(next);
    setTheme(next);
  };
  return (
    <label class="row">
      <span>Colors</span>
      <select data-testid="theme" value={theme} onChange={(event) => choose(event.currentTarget.value as Theme)}>
        <option value="auto">system</option>
        <option value="light">light</option>
        <option value="dark">dark</option>
      </select>
    </label>
  );
}
