//! Charts are well-formed, honest about bad numbers, and the same every time.

use hexbench_report::plot::{
    Axis, Bars, Chart, HeatMap, Panels, PlotError, Raster, Reliability, ReliabilityBin, Series,
};

const TITLE: &str = "Load & <deflection>";

fn chart() -> Chart {
    Chart::new(TITLE, Axis::new("Load", "N"), Axis::new("Deflection", "µm"))
        .with(Series::band("band", vec![[0.0, -1.0, 1.0], [300.0, 17.0, 19.0]]))
        .with(Series::line("line", vec![[0.0, 0.0], [300.0, 18.0]]))
        .with(Series::marked_line("both", vec![[0.0, 0.5], [300.0, 18.5]]))
        .with(Series::markers("markers", vec![[100.0, 6.2], [200.0, 11.7]]).with_errors(vec![0.8, 0.8]))
        .with(Series::line("", vec![[0.0, 15.0], [300.0, 15.0]]).as_reference())
}

fn names(n: usize) -> Vec<String> {
    (0..n).map(|i| format!("a rather long name {i}")).collect()
}

fn bars(values: Vec<f64>) -> Bars {
    Bars::new(TITLE, names(3), Axis::new("Error", "noise")).with("set", values).with_errors(vec![0.1; 3])
}

fn heat_map(value: f64) -> HeatMap {
    HeatMap::new(TITLE, names(2), names(3), vec![vec![1.0, 0.0, value], vec![0.25, 0.5, 0.75]])
        .with_axis_titles("Hidden", "Named")
        .with_decimals(2)
}

fn reliability(observed: f64) -> Reliability {
    let bin = |k: usize| ReliabilityBin {
        edges: [k as f64 / 5.0, (k + 1) as f64 / 5.0],
        stated: k as f64 / 5.0 + 0.1,
        observed,
        interval: [0.3, 0.7],
        count: 10 * k,
    };
    Reliability::new(TITLE, (0..5).map(bin).collect())
}

fn raster(value: f64) -> Raster {
    let row = |name: &str| (name.to_owned(), vec![0.5, -1.5, 9.0, value]);
    Raster::new(TITLE, vec![1.0, 2.0, 4.0])
        .with_words("longer", "shorter", "condition")
        .with("first", vec![row("leg 1"), row("leg 2")])
        .with("second", vec![row("leg 1"), row("leg 2")])
}

fn all() -> Vec<(&'static str, String)> {
    vec![
        ("chart", chart().to_svg().unwrap()),
        ("panels", Panels::new(TITLE, 2).with(chart()).with(chart()).with(chart()).to_svg().unwrap()),
        ("bars", bars(vec![1.0, -2.0, 3.0]).to_svg().unwrap()),
        ("heat map", heat_map(-0.5).to_svg().unwrap()),
        ("raster", raster(-5.0).to_svg().unwrap()),
        ("reliability", reliability(0.5).to_svg().unwrap()),
    ]
}

/// Every piece of text of an SVG.
fn texts(svg: &str) -> Vec<String> {
    let document = roxmltree::Document::parse(svg).unwrap();
    let found = document.descendants().filter(|n| n.has_tag_name("text"));
    found.map(|n| n.text().unwrap_or("").trim().to_owned()).collect()
}

/// Every place that a path names, without its relative steps.
fn places(path: &str) -> Vec<[f64; 2]> {
    let runs = path.split('M').map(|run| run.split(|c: char| c.is_ascii_alphabetic()).next().unwrap_or(""));
    let numbers = runs.flat_map(str::split_whitespace).map(|x| x.parse::<f64>().unwrap());
    numbers.collect::<Vec<_>>().chunks(2).map(|p| [p[0], p[1]]).collect()
}

#[test]
fn many_markers_are_one_element() {
    let points = |n: u32| (0..n).map(|k| [f64::from(k), f64::from(k * k)]).collect();
    let chart = |n| {
        let axes = [Axis::new("", ""), Axis::new("", "")];
        let [x, y] = axes;
        Chart::new("", x, y)
            .with(Series::markers("d", points(n)).with_marker_size(2.0))
            .with(Series::markers("m", points(n)))
    };
    let svg = chart(900).to_svg().unwrap();
    assert!(svg.matches("<path").count() < 12, "{} paths", svg.matches("<path").count());
    let each = (svg.len() - chart(100).to_svg().unwrap().len()) as f64 / 1600.0;
    assert!(each < 16.0, "{each} bytes for a marker");
}

#[test]
fn every_chart_is_well_formed_and_carries_its_title_as_text() {
    for (name, svg) in all() {
        let document = roxmltree::Document::parse(&svg).unwrap();
        assert!(document.root_element().has_tag_name("svg"), "{name}");
        assert!(texts(&svg).iter().any(|t| t == TITLE), "{name}: {:?}", texts(&svg));
    }
}

#[test]
fn nothing_is_drawn_outside_the_sheet_or_at_no_number() {
    const SLACK: f64 = 1.0;
    for (name, svg) in all() {
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{name}");
        let document = roxmltree::Document::parse(&svg).unwrap();
        let view: Vec<f64> = document
            .root_element()
            .attribute("viewBox")
            .unwrap()
            .split(' ')
            .map(|x| x.parse().unwrap())
            .collect();
        for node in document.descendants() {
            for (key, limit) in
                [("x", view[2]), ("cx", view[2]), ("x1", view[2]), ("y", view[3]), ("cy", view[3])]
            {
                let Some(value) = node.attribute(key) else { continue };
                let value: f64 = value.parse().unwrap();
                assert!((-SLACK..=limit + SLACK).contains(&value), "{name}: {key} = {value} of {limit}");
            }
            for [x, y] in places(node.attribute("d").unwrap_or("")) {
                let within =
                    (-SLACK..=view[2] + SLACK).contains(&x) && (-SLACK..=view[3] + SLACK).contains(&y);
                assert!(within, "{name}: {x} {y} of {view:?}");
            }
        }
    }
}

#[test]
fn axis_titles_carry_their_unit_and_the_legend_every_name() {
    let texts = texts(&chart().to_svg().unwrap());
    for wanted in ["Load (N)", "Deflection (µm)", "band", "line", "both", "markers", "300"] {
        assert!(texts.iter().any(|t| t == wanted), "{wanted} in {texts:?}");
    }
}

#[test]
fn panels_share_one_legend() {
    let svg = Panels::new("", 2).with(chart()).with(chart()).to_svg().unwrap();
    assert_eq!(texts(&svg).iter().filter(|t| *t == "both").count(), 1);
}

/// A number of the head of a drawing.
fn size(svg: &str, name: &str) -> f64 {
    let from = svg.find(name).unwrap() + name.len();
    svg[from..].split('"').next().unwrap().parse().unwrap()
}

#[test]
fn panels_one_by_one_fit_a_phone_and_say_everything_that_they_say_together() {
    let chart = Chart::new("", Axis::new("length", "mm"), Axis::new("leg 1", "um"))
        .with(Series::line("line", vec![[0.0, 0.0], [300.0, 18.0]]))
        .with(Series::line("other line", vec![[0.0, 1.0], [300.0, 8.0]]));
    for (columns, width) in [(3, 300.0), (2, 450.0)] {
        let one = Panels::new("", columns).with_panel_size(width, 190.0);
        let six = (0..6).fold(one, |all, _| all.with(chart.clone()));
        let (legend, panels) = six.pieces().unwrap();
        assert_eq!(panels.len(), 6);
        let pieces: Vec<String> = legend.into_iter().chain(panels).collect();
        assert!(pieces.len() == 7 && pieces.iter().all(|piece| size(piece, "width=\"") <= 340.0));
        // A smaller panel has fewer numbers along its axes.
        let words = |svg: &str| texts(svg).into_iter().filter(|text| text.parse::<f64>().is_err());
        let mut apart: Vec<String> = pieces.iter().flat_map(|piece| words(piece)).collect();
        let mut together: Vec<String> = words(&six.to_svg().unwrap()).collect();
        apart.sort();
        together.sort();
        assert!(together.iter().filter(|t| **t == "length (mm)").count() == 6);
        assert_eq!(apart, together);
    }
}

#[test]
fn a_number_that_is_none_is_refused_with_its_place() {
    let bad = chart().with(Series::line("bad", vec![[0.0, 1.0], [1.0, f64::NAN]])).to_svg();
    let message = bad.unwrap_err().to_string();
    assert_eq!(
        message,
        "chart \"Load & <deflection>\": number 2 of series \"bad\" is NaN; only finite numbers can be drawn"
    );
    for refused in [
        bars(vec![1.0, f64::INFINITY, 0.0]).to_svg(),
        heat_map(f64::NAN).to_svg(),
        raster(f64::INFINITY).to_svg(),
        reliability(f64::NAN).to_svg(),
        Panels::new("", 1).with(chart().with_size(f64::NAN, 1.0)).to_svg(),
    ] {
        assert!(matches!(refused, Err(PlotError::NotFinite { .. })), "{refused:?}");
    }
}

#[test]
fn a_logarithmic_axis_refuses_what_is_not_positive() {
    let over = |x: f64| {
        let axis = Axis::new("Distance", "").with_logarithm();
        Chart::new("Power", axis, Axis::new("", "")).with(Series::line("p", vec![[x, 0.0], [10.0, 1.0]]))
    };
    assert!(over(1.0).to_svg().is_ok_and(|svg| !svg.contains("NaN")));
    let message = over(0.0).to_svg().unwrap_err().to_string();
    assert_eq!(
        message,
        "chart \"Power\": number 1 of the x axis is 0; a logarithmic axis shows positive numbers only"
    );
    let bars = Bars::new("", names(1), Axis::new("", "").with_logarithm()).with("b", vec![1.0]);
    assert!(matches!(bars.to_svg(), Err(PlotError::NotPositive { .. })));
}

#[test]
fn lists_of_unequal_length_and_empty_charts_are_refused() {
    assert!(matches!(bars(vec![1.0]).to_svg(), Err(PlotError::Length { found: 1, expected: 3, .. })));
    let empty = Chart::new("", Axis::new("", ""), Axis::new("", ""));
    assert!(matches!(empty.to_svg(), Err(PlotError::Empty { .. })));
    assert!(matches!(Reliability::new("", Vec::new()).to_svg(), Err(PlotError::Empty { .. })));
}

#[test]
fn a_flat_series_and_a_single_point_have_a_place() {
    let flat = |y: f64| {
        Chart::new("", Axis::new("", ""), Axis::new("", "")).with(Series::markers("p", vec![[0.0, y]]))
    };
    for y in [0.0, 1e-9, -3.0e8] {
        let svg = flat(y).to_svg().unwrap();
        assert!(svg.contains("stroke-linecap=\"round\"") && !svg.contains("NaN"), "{y}");
    }
}

#[test]
fn equal_charts_are_equal_bytes() {
    assert_eq!(all(), all());
}

#[test]
fn bars_of_nothing_still_stand_on_an_axis() {
    let svg = Bars::new("", names(2), Axis::new("Error", "")).with("none", vec![0.0; 2]).to_svg().unwrap();
    assert!(roxmltree::Document::parse(&svg).is_ok() && !svg.contains("NaN"));
}
