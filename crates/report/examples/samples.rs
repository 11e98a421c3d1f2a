//! One of each chart, written into a folder: `cargo run -p hexbench-report --example samples -- DIR`.

use std::error::Error;
use std::path::PathBuf;

use hexbench_report::plot::{
    Axis, Bars, Chart, HeatMap, Panels, Raster, Reliability, ReliabilityBin, Series,
};

fn main() -> Result<(), Box<dyn Error>> {
    let folder: PathBuf = std::env::args_os().nth(1).ok_or("give a folder")?.into();
    std::fs::create_dir_all(&folder)?;
    let charts = [
        ("chart", chart().to_svg()?),
        ("panels", panels().to_svg()?),
        ("bars", bars().to_svg()?),
        ("heat-map", heat_map().to_svg()?),
        ("raster", raster().to_svg()?),
        ("reliability", reliability().to_svg()?),
    ];
    for (name, svg) in charts {
        std::fs::write(folder.join(name).with_extension("svg"), svg)?;
    }
    Ok(())
}

fn steps(n: u32, from: f64, to: f64) -> impl Iterator<Item = f64> {
    (0..=n).map(move |i| from + (to - from) * f64::from(i) / f64::from(n))
}

fn chart() -> Chart {
    let linear = |x: f64| 0.062 * x;
    let read: Vec<[f64; 2]> = steps(6, 0.0, 300.0).map(|x| [x, linear(x) + 0.4 * (x / 37.0).sin()]).collect();
    let errors = vec![0.8; read.len()];
    Chart::new(
        "Deflection under a growing load",
        Axis::new("Load along Z", "N"),
        Axis::new("Deflection along Z", "µm"),
    )
    .with(Series::band(
        "twice the noise",
        steps(30, 0.0, 300.0).map(|x| [x, linear(x) - 1.6, linear(x) + 1.6]).collect(),
    ))
    .with(Series::line("springs", steps(30, 0.0, 300.0).map(|x| [x, linear(x)]).collect()).with_look(0))
    .with(Series::line(
        "springs + base",
        steps(30, 0.0, 300.0).map(|x| [x, linear(x) + 1e-5 * x * x]).collect(),
    ))
    .with(Series::markers("read", read).with_errors(errors).with_look(3))
    .with(Series::line("limit", vec![[0.0, 18.0], [300.0, 18.0]]).as_reference())
}

fn panels() -> Panels {
    let names = ["da", "db", "dc", "dα", "dβ", "dγ"];
    let panel = |k: usize| {
        let unit = if k < 3 { "µm" } else { "µrad" };
        let curve = |x: f64| (k as f64 - 2.0) * 3.0 + 0.1 * x * (k as f64 - 1.0);
        let read: Vec<[f64; 2]> =
            steps(4, -30.0, 30.0).map(|x| [x, curve(x) + (x + k as f64).sin()]).collect();
        Chart::new(
            names[k],
            Axis::new("X", "mm").with_ticks(steps(4, -30.0, 30.0).collect()),
            Axis::new("", unit),
        )
        .with(Series::line("predicted", steps(4, -30.0, 30.0).map(|x| [x, curve(x)]).collect()))
        .with(Series::markers("measured", read).with_errors(vec![1.0; 5]))
    };
    (0..6).fold(Panels::new("Deflection along X", 3), |panels, k| panels.with(panel(k)))
}

fn bars() -> Bars {
    let names = ["a", "b", "c", "alpha", "beta", "gamma"].map(String::from).to_vec();
    Bars::new("Error of prediction", names, Axis::new("Root mean square", "noise"))
        .with("springs", vec![3.3, 3.8, 2.7, 0.7, 0.9, 1.3])
        .with_errors(vec![0.4; 6])
        .with("springs + plate", vec![1.1, 0.9, 1.05, 0.95, 1.0, 1.1])
        .with_errors(vec![0.25; 6])
}

fn heat_map() -> HeatMap {
    let names: Vec<String> = [
        "leg-length-compliance",
        "leg-nonlinearity",
        "leg-asymmetry",
        "leg-backlash",
        "joint-friction",
        "joint-rotation-stiffness",
        "bracket-compliance",
        "leg-coupling",
        "base-compliance",
        "platform-compliance",
        "load-offset",
        "load-tilt",
        "outside",
        "none",
    ]
    .map(String::from)
    .to_vec();
    let value = |i: usize, j: usize| match i.abs_diff(j) {
        0 => 88.0 - 5.0 * (i % 4) as f64,
        1 => 7.0,
        3 => f64::from(u8::from(i.is_multiple_of(3))) * 2.0,
        _ => 0.0,
    };
    let values = (0..names.len()).map(|i| (0..names.len()).map(|j| value(i, j)).collect()).collect();
    HeatMap::new("What was hidden and what was named, percent", names.clone(), names, values)
        .with_axis_titles("Hidden", "Named")
}

fn raster() -> Raster {
    let row = |leg: u32| {
        let size = |k: u32| 5.0 * (f64::from(k * leg) / 9.0).sin().powi(3);
        (format!("leg {leg}"), (0..60).map(size).collect())
    };
    Raster::new("Residual elongation over its noise", vec![1.5, 3.0, 4.5])
        .with_words("longer", "shorter", "condition")
        .with("springs alone", (1..=6).map(row).collect())
}

fn reliability() -> Reliability {
    let bin = |i: u32| {
        let (from, n) = (f64::from(i) / 10.0, 20 + 9 * i * i);
        let observed = (from + 0.05 + 0.03 * (f64::from(i) * 1.7).sin()).clamp(0.0, 1.0);
        let half = 2.0 * (observed * (1.0 - observed) / f64::from(n)).sqrt();
        ReliabilityBin {
            edges: [from, from + 0.1],
            stated: from + 0.055,
            observed,
            interval: [(observed - half).max(0.0), (observed + half).min(1.0)],
            count: n as usize,
        }
    };
    Reliability::new("Do probabilities mean what they say?", (0..10).map(bin).collect())
}
