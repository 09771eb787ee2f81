//! Tables on a terminal.

/// Widest cell, columns of a terminal.
const WIDEST: usize = 48;

/// Prints rows under a header, each column as wide as it needs.
pub(super) fn print(header: &[&str], rows: &[Vec<String>]) {
    let header: Vec<String> = header.iter().map(|text| (*text).to_owned()).collect();
    let rows: Vec<Vec<String>> = rows.iter().map(|row| row.iter().map(|cell| cut(cell)).collect()).collect();
    let widths: Vec<usize> = (0..header.len())
        .map(|at| {
            std::iter::once(&header).chain(&rows).filter_map(|row| row.get(at)).map(|c| width(c)).max().unwrap_or(0)
        })
        .collect();
    for row in std::iter::once(&header).chain(&rows) {
        let cells = row.iter().zip(&widths).map(|(cell, wide)| format!("{cell}{}", " ".repeat(wide - width(cell))));
        say!("{}", cells.collect::<Vec<_>>().join("  ").trim_end());
    }
}

/// Columns that a text takes; Chinese letters take two.
fn width(text: &str) -> usize {
    text.chars().map(|letter| if crate::catalog::words::is_ideograph(letter) { 2 } else { 1 }).sum()
}

fn cut(text: &str) -> String {
    if width(text) <= WIDEST {
        return text.to_owned();
    }
    let mut out = String::new();
    for letter in text.chars() {
        if width(&out) + 3 > WIDEST {
            break;
        }
        out.push(letter);
    }
    out + "…"
}
