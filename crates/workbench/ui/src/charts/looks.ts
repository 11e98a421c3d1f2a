/** Colours and markers: those of Okabe and Ito without their yellow, as in the report; lighter ones on a dark page. */

export interface Looks {
  ink: string;
  grey: string;
  grid: string;
  paper: string;
  /** What the model leaves now. */
  now: string;
  /** The springs alone. */
  before: string;
  /** A leg longer or shorter than predicted: neither color is that of a platform beside it. */
  longer: string;
  shorter: string;
  /** Noise. */
  band: string;
  /** Six legs. */
  legs: string[];
}

const LIGHT: Looks = {
  ink: "#262626",
  grey: "#707070",
  grid: "#e3e3e3",
  paper: "#ffffff",
  now: "#0072b2",
  before: "#d55e00",
  longer: "#732f0d",
  shorter: "#00947b",
  band: "rgba(0, 158, 115, 0.13)",
  legs: ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"],
};

const DARK: Looks = {
  ink: "#e8e8e8",
  grey: "#a8a8a8",
  grid: "#3a3d42",
  paper: "#1e2126",
  now: "#7cc4f5",
  before: "#e87f30",
  longer: "#ffeb0f",
  shorter: "#2aa75e",
  band: "rgba(44, 194, 149, 0.16)",
  legs: ["#5cb3ee", "#f08a3c", "#2cc295", "#e39ac4", "#f2b530", "#b5def7"],
};

/** Markers of the six legs: told apart without colour. */
export const MARKERS = [
  "circle",
  "rect",
  "triangle",
  "diamond",
  // A ring: what ECharts calls an empty circle is filled with white.
  "path://M5 0A5 5 0 1 1 5 10A5 5 0 1 1 5 0ZM5 2A3 3 0 1 0 5 8A3 3 0 1 0 5 2Z",
  "path://M0 0L1 0L5 4L9 0L10 0L10 1L6 5L10 9L10 10L9 10L5 6L1 10L0 10L0 9L4 5L0 1Z",
];

export function looks(dark: boolean): Looks {
  return dark ? DARK : LIGHT;
}
