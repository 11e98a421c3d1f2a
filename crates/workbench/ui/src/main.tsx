/** Starts the page. */
import "./app.css";
import { render } from "preact";
import { Api } from "./api";
import { App } from "./app";
import { Store } from "./store";
import { applyTheme } from "./theme";
import { takeToken } from "./token";

applyTheme();
const token = takeToken();
const store = new Store(token === null ? null : new Api(token));
const root = document.getElementById("app");
if (root !== null) render(<App store={store} />, root);
void store.start();
// A file dropped beside the place for files must not replace the page.
for (const kind of ["dragover", "drop"]) addEventListener(kind, (event) => event.preventDefault());
// An address with a new key, pasted into a tab that is already open.
addEventListener("hashchange", () => location.reload());
