//! Dialects of CSV: read, or named with a remedy.

use std::io::Write as _;

use tempfile::NamedTempFile;

use super::*;

const LIMITS: Limits = Limits { rows: 100, bytes: 10_000 };
const NAMES: [(&str, bool); 3] = [("fy", true), ("t", true), ("none", false)];

fn file(bytes: &[u8]) -> NamedTempFile {
    let mut file = NamedTempFile::new().expect("a file");
    file.write_all(bytes).expect("a file");
    file
}

fn read(bytes: &[u8]) -> Result<Vec<Vec<f64>>, String> {
    columns(file(bytes).path(), &NAMES, LIMITS).map_err(|fault| fault.to_string())
}

#[test]
fn dialects_are_read_as_the_same_table() {
    let wanted = vec![vec![2.0, -4.5e-3], vec![0.0, 0.5], vec![]];
    for (name, text) in [
        ("commas", "t,fx,fy\n0,1,2\n0.5,3,-4.5e-3\n"),
        ("semicolons", "t;fx;fy\n0;1;2\n0.5;3;-4.5e-3\n"),
        ("tabs", "t\tfx\tfy\r\n0\t1\t2\r\n0.5\t3\t-4.5e-3\r\n"),
        ("comments", "# a\n% b, c\nt , fx, fy\n% 1, 2, 3\n0,1,2\n#\n0.5,3,-4.5e-3"),
        ("mark", "\u{feff}t,fx,fy\n0,1,2\n0.5,3,-4.5e-3\n"),
        ("quoted", "\"t\";\"f,x,\";\"fy\"\n0;1;2\n0.5;3;-4.5e-3\n"),
    ] {
        assert_eq!(read(text.as_bytes()).as_ref(), Ok(&wanted), "{name}");
    }
}

#[test]
fn dialects_that_are_not_read_are_named() {
    for (name, text, parts) in [
        ("units", "t,fx,fy\ns,N,mN\n0,1,2\n", &["line 2", "`mN` of fy", "row of units", "`#`"][..]),
        ("decimal", "t;fx;fy\n0;1;2,5\n", &["line 2", "`2,5` of fy", "decimal comma"]),
        ("spaces", "t fx  fy\n0 1 2\n", &["spaces", "semicolons or tabs"]),
        ("heading", "% t, fx, fy\n0,1,2\n3,4,5\n", &["first line has numbers", "comment"]),
        ("missing", "t,fx,fz\n0,1,2\n", &["no column `fy`; there are t, fx, fz"]),
        ("cell", "t,fx,fy\n0,1,2\n1,2,x\n", &["line 3: `x` of fy is no finite number"]),
        ("infinite", "t,fx,fy\n0,1,inf\n", &["line 2: `inf` of fy is no finite number"]),
    ] {
        let error = read(text.as_bytes()).expect_err(name);
        for part in parts {
            assert!(error.contains(part), "{name}: {error}");
        }
        assert!(name == "units" || !error.contains("row of units"), "{error}");
    }
    let utf_16: Vec<u8> = "\u{feff}t,fx\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    assert!(read(&utf_16).expect_err("UTF-16").contains("save it as UTF-8"));
}

#[test]
fn a_table_that_is_too_long_is_refused_and_not_cut() {
    let row = "0.123456789,1,2\n";
    let text = format!("t,fx,fy\n{}", row.repeat(101));
    assert!(read(text.as_bytes()).expect_err("rows").contains("more than 100 rows"));
    let limits = Limits { rows: 1000, bytes: 500 };
    let fault = columns(file(text.as_bytes()).path(), &NAMES, limits).expect_err("bytes");
    assert!(fault.to_string().contains("more than 500 bytes"), "{fault}");
}
