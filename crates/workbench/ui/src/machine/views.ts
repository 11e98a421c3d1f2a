/** Sides from which a machine is usually looked at. Angles in rad: about the vertical from the x axis, and above the ground. */

/** Straight above, a camera would not know what is up. */
export const STEEPEST = Math.PI / 2 - 0.02;

export type ViewName = "usual" | "front" | "side" | "above";

export const VIEWS: Record<ViewName, { title: string; azimuth: number; elevation: number }> = {
  usual: { title: "From a corner", azimuth: -0.9, elevation: 0.35 },
  front: { title: "Front (x to the right)", azimuth: -Math.PI / 2, elevation: 0 },
  side: { title: "Side (y to the right)", azimuth: 0, elevation: 0 },
  above: { title: "Above", azimuth: -Math.PI / 2, elevation: STEEPEST },
};
