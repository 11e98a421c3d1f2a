//! Workbooks as spreadsheets pack them, written by hand so that every byte is known.

use std::fmt::Write as _;
use std::io::{Cursor, Write as _};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// A cell of a sheet.
#[derive(Clone)]
pub(crate) enum Cell {
    Empty,
    Number(f64),
    Text(String),
    /// A number that is shown as a date.
    Date(f64),
    /// `#DIV/0!`.
    Error,
}

/// Rows of a sheet and its name.
pub(crate) type Sheet = (&'static str, Vec<Vec<Cell>>);

/// Cells of a table of text: numbers where there are some.
pub(crate) fn cells(text: &str) -> Vec<Vec<Cell>> {
    let cell = |text: &str| match (text.parse::<f64>(), text.is_empty()) {
        (Ok(number), _) => Cell::Number(number),
        (_, true) => Cell::Empty,
        _ => Cell::Text(text.to_owned()),
    };
    text.lines().map(|line| line.split(',').map(cell).collect()).collect()
}

fn packed(files: &[(&str, String)]) -> Vec<u8> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let stored = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
    for (name, content) in files {
        zip.start_file(*name, stored).unwrap();
        zip.write_all(content.as_bytes()).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

const HEAD: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>";
const MAIN: &str = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
const RELATIONS: &str = "http://schemas.openxmlformats.org/package/2006/relationships";
const OFFICE: &str = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";

/// An .xlsx.
pub(crate) fn xlsx(sheets: &[Sheet]) -> Vec<u8> {
    let (mut list, mut relations) = (String::new(), String::new());
    let mut files = Vec::new();
    for (number, (name, rows)) in (1..).zip(sheets) {
        let _ = write!(list, "<sheet name=\"{name}\" sheetId=\"{number}\" r:id=\"r{number}\"/>");
        let _ = write!(
            relations,
            "<Relationship Id=\"r{number}\" Type=\"{OFFICE}/worksheet\" Target=\"worksheets/sheet{number}.xml\"/>"
        );
        files.push((format!("xl/worksheets/sheet{number}.xml"), xlsx_sheet(rows)));
    }
    let _ = write!(relations, "<Relationship Id=\"rs\" Type=\"{OFFICE}/styles\" Target=\"styles.xml\"/>");
    let styles = format!(
        "{HEAD}<styleSheet xmlns=\"{MAIN}\"><cellXfs count=\"2\"><xf numFmtId=\"0\"/><xf numFmtId=\"14\"/></cellXfs></styleSheet>"
    );
    let mut all = vec![
        (
            "[Content_Types].xml",
            format!("{HEAD}<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\"/>"),
        ),
        (
            "_rels/.rels",
            format!(
                "{HEAD}<Relationships xmlns=\"{RELATIONS}\"><Relationship Id=\"r1\" Type=\"{OFFICE}/officeDocument\" Target=\"xl/workbook.xml\"/></Relationships>"
            ),
        ),
        (
            "xl/workbook.xml",
            format!(
                "{HEAD}<workbook xmlns=\"{MAIN}\" xmlns:r=\"{OFFICE}\"><sheets>{list}</sheets></workbook>"
            ),
        ),
        (
            "xl/_rels/workbook.xml.rels",
            format!("{HEAD}<Relationships xmlns=\"{RELATIONS}\">{relations}</Relationships>"),
        ),
        ("xl/styles.xml", styles),
    ];
    all.extend(files.iter().map(|(name, content)| (name.as_str(), content.clone())));
    packed(&all)
}

fn xlsx_sheet(rows: &[Vec<Cell>]) -> String {
    let mut text = format!("{HEAD}<worksheet xmlns=\"{MAIN}\"><sheetData>");
    for (row, cells) in (1..).zip(rows) {
        let _ = write!(text, "<row r=\"{row}\">");
        for (column, cell) in cells.iter().enumerate() {
            let at = format!("{}{row}", letters(column));
            let _ = match cell {
                Cell::Empty => Ok(()),
                Cell::Number(number) => write!(text, "<c r=\"{at}\"><v>{number}</v></c>"),
                Cell::Date(number) => write!(text, "<c r=\"{at}\" s=\"1\"><v>{number}</v></c>"),
                Cell::Error => write!(text, "<c r=\"{at}\" t=\"e\"><v>#DIV/0!</v></c>"),
                Cell::Text(words) => {
                    write!(text, "<c r=\"{at}\" t=\"inlineStr\"><is><t>{words}</t></is></c>")
                }
            };
        }
        text.push_str("</row>");
    }
    text + "</sheetData></worksheet>"
}

/// A, B, ... Z, AA, ...
fn letters(column: usize) -> String {
    let letter = |k: usize| char::from(b'A' + u8::try_from(k % 26).unwrap());
    if column < 26 {
        letter(column).to_string()
    } else {
        format!("{}{}", letter(column / 26 - 1), letter(column))
    }
}

/// An .ods.
pub(crate) fn ods(sheets: &[Sheet]) -> Vec<u8> {
    const NAMES: &str = "urn:oasis:names:tc:opendocument:xmlns";
    let mut body = String::new();
    for (name, rows) in sheets {
        let _ = write!(body, "<table:table table:name=\"{name}\">");
        for cells in rows {
            body.push_str("<table:table-row>");
            for cell in cells {
                let _ = match cell {
                    Cell::Empty => write!(body, "<table:table-cell/>"),
                    Cell::Number(n) | Cell::Date(n) => write!(
                        body,
                        "<table:table-cell office:value-type=\"float\" office:value=\"{n}\"><text:p>{n}</text:p></table:table-cell>"
                    ),
                    Cell::Error => write!(
                        body,
                        "<table:table-cell office:value-type=\"string\"><text:p>#DIV/0!</text:p></table:table-cell>"
                    ),
                    Cell::Text(words) => write!(
                        body,
                        "<table:table-cell office:value-type=\"string\"><text:p>{words}</text:p></table:table-cell>"
                    ),
                };
            }
            body.push_str("</table:table-row>");
        }
        body.push_str("</table:table>");
    }
    let content = format!(
        "{HEAD}<office:document-content xmlns:office=\"{NAMES}:office:1.0\" xmlns:table=\"{NAMES}:table:1.0\" xmlns:text=\"{NAMES}:text:1.0\" office:version=\"1.2\"><office:body><office:spreadsheet>{body}</office:spreadsheet></office:body></office:document-content>"
    );
    let manifest = format!("{HEAD}<manifest:manifest xmlns:manifest=\"{NAMES}:manifest:1.0\"/>");
    packed(&[
        ("mimetype", "application/vnd.oasis.opendocument.spreadsheet".into()),
        ("META-INF/manifest.xml", manifest),
        ("content.xml", content),
    ])
}
