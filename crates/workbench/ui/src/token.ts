/** The token that the server printed in its address; it stays in this tab. */

const KEY = "hexbench-token";

/** Takes the token out of the address bar (`#token=...`), keeps it for this tab and gives it. */
export function takeToken(): string | null {
  const found = /^#token=(.+)$/.exec(location.hash)?.[1];
  if (found !== undefined) {
    sessionStorage.setItem(KEY, decodeURIComponent(found));
    history.replaceState(null, "", location.pathname);
  }
  return sessionStorage.getItem(KEY);
}
