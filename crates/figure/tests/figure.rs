//! Figures: well-formed SVG with all names in it, points where the axes say, errors instead of wrong pictures.

mod xml;

use plain_figure::{Axis, Chart, FigureError, Panels, Reference, Series};
use xml::{Element, parse};

fn texts(elements: &[Element]) -> Vec<&str> {
    elements
        .iter()
        .filter(|e| e.name == "text")
        .map(|e| e.text.as_str())
        .collect()
}

/// Where the tick with this label stands: x of a label below the plot, y of one beside it \[px\].
fn tick(elements: &[Element], label: &str, anchor: &str) -> f64 {
    let found: Vec<&Element> = elements
        .iter()
        .filter(|e| e.name == "text" && e.text == label && e.get("text-anchor") == anchor)
        .collect();
    assert_eq!(found.len(), 1, "label {label}: {found:?}");
    found[0].number(if anchor == "end" { "y" } else { "x" })
}

/// The points of the one solid line in the first series' colour.
fn first_line(elements: &[Element]) -> Vec<(f64, f64)> {
    let lines: Vec<&Element> = elements
        .iter()
        .filter(|e| e.name == "polyline" && e.get("stroke") == "#0072B2" && e.points().len() > 2)
        .collect();
    assert_eq!(lines.len(), 1);
    lines[0].points()
}

fn line() -> Series {
    Series::line("line", [(0.0, 0.0), (1.0, 1.0)])
}

fn axes() -> (Axis, Axis) {
    (Axis::linear("x"), Axis::linear("y"))
}

fn chart(series: Series) -> Chart {
    let (x, y) = axes();
    Chart::new("chart", x, y).with(series)
}

#[test]
fn a_chart_is_well_formed_and_names_everything() {
    let (x, y) = (Axis::linear("place, m"), Axis::linear("D_l, µm"));
    let points = [(0.0, 1.0), (1.0, 3.0), (2.0, -1.0)];
    let chart = Chart::new("a < b & \"c\"", x, y)
        .with(Series::line("a line", points))
        .with(Series::points("points <2>", points))
        .with(Series::line_points("both & all", points))
        .with(Series::line("dashes", points).dashed())
        .with(Series::area("area\u{1}", points))
        .refer(Reference::horizontal(2.0, "limit"))
        .refer(Reference::vertical_band(0.5, 0.7, "band"));
    let svg = chart.to_svg().expect("svg");
    let elements = parse(&svg);
    let texts = texts(&elements);
    #[rustfmt::skip]
    let names = [
        "a < b & \"c\"", "place, m", "D_l, µm", "a line", "points <2>", "both & all", "dashes", "area\u{fffd}", "limit", "band",
    ];
    for text in names {
        assert_eq!(
            texts.iter().filter(|found| **found == text).count(),
            1,
            "{text} in {texts:?}"
        );
    }
    assert_eq!(elements[0].get("role"), "img");
    assert_eq!(
        (elements[1].name.as_str(), elements[1].text.as_str()),
        ("title", "a < b & \"c\"")
    );
    assert_eq!(
        (elements[2].name.as_str(), elements[2].get("fill")),
        ("rect", "#FFFFFF")
    );
    // 14 px of a figure 800 px wide, and nothing drawn outside of it.
    assert_eq!(elements[0].get("viewBox"), "0 0 800 500");
    for element in elements.iter().filter(|e| e.name == "text") {
        assert!(element.number("font-size") >= 14.0, "{element:?}");
        assert!((0.0..=800.0).contains(&element.number("x")), "{element:?}");
        assert!((0.0..=500.0).contains(&element.number("y")), "{element:?}");
    }
    assert_eq!(svg, chart.to_svg().expect("svg"), "the same figure twice");
}

#[test]
fn points_lie_at_their_ticks() {
    let linear = Chart::new(
        "",
        Axis::linear("x").range(0.0, 12.0),
        Axis::linear("y").range(-50.0, 100.0),
    )
    .with(Series::line("", [(2.0, -40.0), (4.0, 20.0), (10.0, 80.0)]));
    let logarithmic = Chart::new(
        "",
        Axis::logarithmic("x").range(0.5, 2e4),
        Axis::logarithmic("y").range(1e-7, 1e-3),
    )
    .with(Series::line("", [(1.0, 1e-6), (10.0, 1e-4), (1e4, 1e-5)]));
    let cases = [
        (linear, [["2", "−40"], ["4", "20"], ["10", "80"]]),
        (logarithmic, [["1", "10⁻⁶"], ["10", "10⁻⁴"], ["10000", "10⁻⁵"]]),
    ];
    for (chart, labels) in cases {
        let elements = parse(&chart.to_svg().expect("svg"));
        let points = first_line(&elements);
        assert_eq!(points.len(), 3);
        for ((x, y), [below, beside]) in points.into_iter().zip(labels) {
            assert!((x - tick(&elements, below, "middle")).abs() <= 0.1, "{x} {below}");
            assert!((y - tick(&elements, beside, "end")).abs() <= 0.1, "{y} {beside}");
        }
    }
}

#[test]
fn what_lies_beyond_the_range_is_cut_off() {
    let series = Series::line("", [(-5.0, 0.5), (0.5, 0.5), (0.5, 0.7), (9.0, 0.7)]);
    let chart = Chart::new(
        "",
        Axis::linear("x").range(0.0, 1.0),
        Axis::linear("y").range(0.0, 1.0),
    )
    .with(series);
    let elements = parse(&chart.to_svg().expect("svg"));
    // The line stands in an element of its own, which ends with the axes.
    let place = elements
        .iter()
        .position(|e| e.name == "polyline" && e.points().len() == 4);
    let place = place.expect("the line, as it was given");
    let clip = &elements[place - 1];
    assert_eq!(clip.name, "svg");
    let [left, right] = ["0", "1"].map(|label| tick(&elements, label, "middle"));
    let [bottom, top] = ["0", "1"].map(|label| tick(&elements, label, "end"));
    let [x, y, width, height] = ["x", "y", "width", "height"].map(|name| clip.number(name));
    for (found, wanted) in [(x, left), (x + width, right), (y, top), (y + height, bottom)] {
        assert!((found - wanted).abs() <= 0.2, "{found} px, {wanted} px");
    }
    assert_eq!(clip.get("viewBox"), format!("{x} {y} {width} {height}"));
}

#[test]
fn a_map_colours_each_cell() {
    let classes = || ["right", "wrong", "refused"];
    let x = || Axis::logarithmic("step, s").cells([1e-3, 1e-2, 1e-1]);
    let y = || Axis::names("law", ["coulomb", "sigmoid"]);
    let map = Chart::of_classes("stability", x(), y(), classes(), [0, 1, 2, 0, 0, 1])
        .with(Series::line("limit", [(3e-3, -0.5), (3e-3, 1.5)]));
    let elements = parse(&map.to_svg().expect("svg"));
    let texts = texts(&elements);
    #[rustfmt::skip]
    let names = ["stability", "right", "wrong", "refused", "limit", "coulomb", "sigmoid", "step, s", "law"];
    for text in names {
        assert!(texts.contains(&text), "{text} in {texts:?}");
    }
    let filled = |colour: &str| {
        elements
            .iter()
            .filter(|e| e.name == "polygon" && e.get("fill") == colour)
            .count()
    };
    // One more of each in the legend.
    assert_eq!(["#56B4E9", "#D55E00", "#F0E442"].map(filled), [4, 3, 2]);
    // The cell of class 2 lies around the tick of 0.1 s, at the height of the first name.
    let cell = elements
        .iter()
        .find(|e| e.get("fill") == "#F0E442" && e.name == "polygon")
        .expect("the cell")
        .points();
    let (x_sum, y_sum) = cell.iter().fold((0.0, 0.0), |sum, p| (sum.0 + p.0, sum.1 + p.1));
    for (middle, tick) in [
        (0.25 * x_sum, tick(&elements, "0.1", "middle")),
        (0.25 * y_sum, tick(&elements, "coulomb", "end")),
    ] {
        assert!((middle - tick).abs() <= 0.1, "{middle}, {tick}");
    }

    let values = [Some(1.0), Some(10.0), None, Some(3.0), Some(5.0), Some(100.0)];
    let map = Chart::of_values("error", x(), y(), Axis::logarithmic("error, %"), values);
    let elements = parse(&map.to_svg().expect("svg"));
    // The lowest and the highest value have the ends of the scale.
    for colour in ["#440154", "#FDE725"] {
        assert!(elements.iter().any(|e| e.get("fill") == colour), "{colour}");
    }
}

#[test]
fn panels_stand_in_rows() {
    let panels = Panels::new("all").columns(2).panel_size(400.0, 300.0);
    let panels = ["a", "b", "c"].into_iter().fold(panels, |panels, name| {
        panels.with(Chart::new(format!("panel {name}"), axes().0, axes().1).with(line()))
    });
    let elements = parse(&panels.to_svg().expect("svg"));
    assert_eq!(elements[1].text, "all; panel a; panel b; panel c");
    let title = |name: &str| {
        let found = elements
            .iter()
            .find(|e| e.name == "text" && e.text == name)
            .expect("title");
        (found.number("x"), found.number("y"))
    };
    assert_eq!(title("panel a").0 + 400.0, title("panel b").0);
    assert_eq!(title("panel a").1 + 300.0, title("panel c").1);
    assert_eq!(title("panel a").0, title("panel c").0);
}

/// The name of the error of a drawing.
fn fault(drawn: Result<String, FigureError>) -> &'static str {
    match drawn.expect_err("an error") {
        FigureError::Empty { .. } => "empty",
        FigureError::NoPlace { .. } => "no place",
        FigureError::BadRange { .. } => "bad range",
        FigureError::BadCells(_) => "bad cells",
        FigureError::NoRoom { .. } => "no room",
        other => panic!("{other}"),
    }
}

#[test]
fn errors_instead_of_wrong_pictures() {
    let (x, y) = axes();
    let long = "long ".repeat(40);
    let on_logarithmic = |series| Chart::new("", Axis::logarithmic("x"), Axis::linear("y")).with(series);
    let in_range = |from, to| {
        let x = Axis::linear("x").range(from, to);
        Chart::new("", x, Axis::linear("y")).with(line())
    };
    let positive = Series::line("", [(1.0, 1.0), (2.0, 2.0)]);
    let mut cases = vec![
        (Chart::new("none", x, y), "empty"),
        (chart(Series::line("none", [])), "empty"),
        (on_logarithmic(line()), "no place"),
        (
            on_logarithmic(positive).refer(Reference::vertical(0.0, "")),
            "no place",
        ),
        (in_range(1.0, 1.0), "bad range"),
        (in_range(2.0, 1.0), "bad range"),
        (in_range(f64::NAN, 1.0), "bad range"),
        (in_range(0.0, f64::INFINITY), "bad range"),
        (chart(Series::line(&long, [(0.0, 0.0), (1.0, 1.0)])), "no room"),
        (
            Chart::new("", Axis::linear(&long), Axis::linear("y")).with(line()),
            "no room",
        ),
        (chart(line()).refer(Reference::horizontal(0.5, &long)), "no room"),
    ];
    for value in [f64::NAN, f64::INFINITY] {
        cases.push((chart(line()).refer(Reference::horizontal(value, "")), "no place"));
        // Both tell which of the numbers it is.
        let bad = chart(Series::line("bad", [(0.0, 0.0), (value, 0.0)]));
        let sized = Panels::new("").panel_size(400.0, value).with(chart(line()));
        for refused in [bad.to_svg(), sized.to_svg()] {
            assert!(
                matches!(refused, Err(FigureError::NoPlace { index: 1, .. })),
                "{refused:?}"
            );
        }
    }
    for (chart, expected) in cases {
        assert_eq!(fault(chart.to_svg()), expected);
    }
    let small = Panels::new("").panel_size(100.0, 100.0).with(chart(line()));
    assert_eq!(
        [small, Panels::new("none")].map(|panels| fault(panels.to_svg())),
        ["no room", "empty"]
    );
}

#[test]
fn errors_of_maps() {
    let grid = |values: [f64; 2]| Axis::linear("x").cells(values);
    let unit = || grid([0.0, 1.0]);
    let classes = |cells: &[usize], x| Chart::of_classes("", x, unit(), ["a", "b"], cells.to_vec()).to_svg();
    let values = |cells: [Option<f64>; 4], axis| Chart::of_values("", unit(), unit(), axis, cells).to_svg();
    let linear = || Axis::linear("v");
    assert!(classes(&[0, 1, 1, 0], unit()).is_ok());
    assert!(values([Some(1.0), None, None, Some(2.0)], linear()).is_ok());
    for (refused, expected) in [
        (classes(&[], unit()), "empty"),
        (classes(&[0, 1, 1], unit()), "bad cells"),
        (classes(&[0, 1, 2, 0], unit()), "bad cells"),
        (classes(&[0; 4], grid([1.0, 1.0])), "bad range"),
        (classes(&[0; 4], grid([0.0, f64::NAN])), "no place"),
        (
            classes(&[0; 4], Axis::logarithmic("x").cells([0.0, 1.0])),
            "no place",
        ),
        (values([None; 4], linear()), "empty"),
        (values([Some(f64::NAN); 4], linear()), "no place"),
        (values([Some(0.0); 4], Axis::logarithmic("v")), "no place"),
    ] {
        assert_eq!(fault(refused), expected);
    }
}

/// No number, however large or small, makes the drawing panic.
#[test]
fn extreme_numbers_give_a_figure_or_an_error() {
    const TINY: f64 = f64::MIN_POSITIVE;
    #[rustfmt::skip]
    let numbers = [-f64::MAX, -1.0, -TINY, 0.0, TINY, 1e-300, 1.0, 1.0 + f64::EPSILON, 1e300, f64::MAX];
    for a in numbers {
        for b in numbers {
            for axis in [
                Axis::linear("v"),
                Axis::logarithmic("v"),
                Axis::linear("v").range(0.0, 1.0),
            ] {
                for series in [
                    Series::area("", [(a, b), (b, a)]),
                    Series::line_points("", [(a, a), (b, b)]),
                ] {
                    if let Ok(svg) = Chart::new("", axis.clone(), axis.clone()).with(series).to_svg() {
                        parse(&svg);
                    }
                }
            }
            let (x, y) = (Axis::linear("x").cells([a, b]), Axis::linear("y").cells([b]));
            let _ = Chart::of_values("", x, y, Axis::linear("v"), [Some(a), Some(b)]).to_svg();
        }
    }
}
