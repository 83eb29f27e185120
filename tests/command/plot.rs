//! `mms plot` and `--figure`: curves for print.

use roxmltree::Document;

use super::mms::Folder;

/// The texts of a figure, each with its raised parts.
fn texts(svg: &str) -> Vec<String> {
    let document = Document::parse(svg).expect("XML");
    let texts = document.descendants().filter(|it| it.has_tag_name("text"));
    let parts = texts.map(|text| text.descendants().filter(|it| it.is_text()));
    parts.map(|parts| parts.filter_map(|it| it.text()).collect()).collect()
}

/// A judgement of two columns whose errors fall as h^2.
const ERRORS: &str = "h,u_l2,p_l2\n0.4,1.600e-3,4.000\n0.2,4.000e-4,1.000\n0.1,1.000e-4,0.2500\n";

#[test]
fn documents_are_drawn_as_svg_and_as_pdf() {
    let folder = Folder::new();
    let study = "study bar_1d --cells 8,16 --output one --figure one.pdf";
    folder.mms(study).exits(0).prints("one/convergence.json, one.pdf");
    folder.write("errors.csv", ERRORS);
    let judge = "judge --errors errors.csv --output two --figure two.svg";
    folder.mms(judge).exits(0).prints("two/convergence.json, two.svg");
    // The folder of --output has the same figure.
    assert_eq!(folder.read("two.svg"), folder.read("two/convergence.svg"));
    let own = texts(&folder.read("two.svg"));
    for text in ["u, l2, order 2.00", "p, l2, order 2.00", "cell size h", "error"] {
        assert!(own.iter().any(|it| it == text), "{text}: {own:?}");
    }
    let plot = "plot one/convergence.json two/convergence.json -o both.svg --width 85";
    folder.mms(plot).exits(0).prints("wrote both.svg");
    let svg = folder.read("both.svg");
    assert!(svg.contains("width=\"85.00mm\""), "{svg}");
    let both = texts(&svg);
    // Errors in metres and errors without a unit share no panel.
    for text in [
        "(a) updated Lagrangian, cpGIMP, leapfrog",
        "largest error of u over time (m)",
        "(b) ",
        "error",
        "l2, order 1.99",
    ] {
        assert!(both.iter().any(|it| it.starts_with(text)), "{text}: {both:?}");
    }
    // Two documents over the same axes share one, under the names of their files.
    let again = std::fs::read(folder.path("two/convergence.json")).expect("a document");
    std::fs::write(folder.path("again.json"), again).expect("a copy");
    folder.mms("plot again.json two/convergence.json -o both.pdf").exits(0);
    let bytes = std::fs::read(folder.path("both.pdf")).expect("a figure");
    let text: String = bytes.iter().map(|it| char::from(*it)).collect();
    assert!(text.starts_with("%PDF-") && text.contains("(again: u, l2, order 2.00) Tj"), "{text}");
    assert!(text.contains("(convergence: p, l2, order 2.00) Tj"), "{text}");
}

#[test]
fn what_is_no_document_with_curves_is_refused() {
    let folder = Folder::new();
    folder.write("errors.csv", ERRORS);
    folder.mms("judge --errors errors.csv --output two").exits(0);
    let judged = folder.read("two/convergence.json");
    let kind = |from: &str, to: &str| {
        assert!(judged.contains(from), "{from}");
        judged.replace(from, to)
    };
    folder.write("newer.json", &kind("\"document_version\": 2", "\"document_version\": 9"));
    folder.write("unknown.json", &kind("\"kind\": \"judge\"", "\"kind\": \"jugde\""));
    folder.write("list.json", "[1, 2]");
    for (arguments, said) in [
        ("newer.json -o x.svg", "its form is of version 9"),
        ("unknown.json -o x.svg", "expected a document of `mms study`, `judge`"),
        ("list.json -o x.svg", "it has no provenance"),
        ("errors.csv -o x.svg", "`errors.csv`: not JSON"),
        ("two/convergence.json -o x.png", "ends in .svg or .pdf"),
        ("two/convergence.json -o x.svg --width 100", "85, a column, or 170, a page"),
        ("two/convergence.json -o two/convergence.json", "ends in .svg or .pdf"),
    ] {
        folder.mms(&format!("plot {arguments}")).exits(2).complains(said);
    }
    assert!(!folder.path("x.svg").exists());
}

/// In a column the legend is small and lies in rows, and the 1 of the triangle lies above the axis.
#[test]
fn a_figure_in_a_column_is_compact() {
    let folder = Folder::new();
    folder.mms("study bar_1d --cells 8,16,32 --shape cpgimp,linear -o out").exits(1);
    folder.mms("plot out/convergence.json -o column.svg --width 85").exits(0);
    let svg = folder.read("column.svg");
    assert!(texts(&svg).iter().any(|it| it == "updated Lagrangian"), "{svg}");
    let document = Document::parse(&svg).expect("XML");
    let number = |node: roxmltree::Node<'_, '_>, name: &str| {
        node.attribute(name).and_then(|it| it.parse::<f64>().ok()).expect("a number")
    };
    let text = |wanted: &str| {
        let found = document.descendants().filter(|it| it.has_tag_name("text"));
        found.into_iter().find(|it| it.text() == Some(wanted)).expect("a text")
    };
    // The axis ends at the numbers below it, 17 pixels lower.
    let axis = number(text("0.125"), "y") - 17.0;
    assert!(number(text("1"), "y") < axis - 3.0, "{svg}");
    let entry = text("cpGIMP, order 2.00");
    assert_eq!(number(entry, "font-size"), 10.0);
    let slope = text("slope 2");
    assert!(
        number(slope, "x") == number(entry, "x") || number(slope, "y") == number(entry, "y"),
        "{svg}"
    );
}

#[test]
fn a_latex_table_of_methods_fits_a_column() {
    let study = "study bar_1d --cells 8,16 --shape cpgimp,quadratic_bspline --format latex";
    let run = Folder::new().mms(study).exits(0);
    run.prints("\\caption{bar\\_1d: l2 of 2 methods, updated Lagrangian}")
        .prints("    \\multicolumn{5}{l}{quadratic B-splines} \\\\\n")
        .prints("\\begin{tabular}{rrrrr}");
    let one = "study bar_1d --cells 8,16 --format latex";
    Folder::new().mms(one).exits(0).prints("updated Lagrangian, cpGIMP, leapfrog}");
}
