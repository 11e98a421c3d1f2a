/** Time from a gesture to the frame after the answer is drawn. */

/** Measures from `start` (ms, as `performance.now`) to the second frame from here, as an entry `tick`. */
export function untilDrawn(start: number, server: number, done: (total: number) => void): void {
  requestAnimationFrame(() =>
    requestAnimationFrame(() => {
      const { duration } = performance.measure("tick", { start, end: performance.now(), detail: { server } });
      done(duration);
    }),
  );
}
