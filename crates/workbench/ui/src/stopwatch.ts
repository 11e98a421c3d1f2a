/** Time from a gesture to the frame after the answer is drawn. */

/** Once what is drawn now can be seen: at the second frame from here, or at once where nothing is seen. */
export function drawn(): Promise<void> {
  if (document.hidden) return Promise.resolve();
  return new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done())));
}

/** Measures from `start` (ms, as `performance.now`) until the answer is drawn, as an entry `tick`. */
export async function untilDrawn(start: number, server: number, done: (total: number) => void): Promise<void> {
  await drawn();
  const { duration } = performance.measure("tick", { start, end: performance.now(), detail: { server } });
  done(duration);
}
