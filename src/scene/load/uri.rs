//! URIs of buffers and images: data URIs, percent coding, and what we refuse to fetch.

/// Where a URI points.
#[derive(Debug, PartialEq)]
pub enum Target {
    /// The bytes of a data URI.
    Data(Vec<u8>),
    /// A path as the file writes it, percent-decoded; see [`leads_out`].
    Relative(String),
}

/// Takes a URI apart; the error says what is wrong with it.
pub fn parse(uri: &str) -> Result<Target, String> {
    if let Some(rest) = uri.strip_prefix("data:") {
        return data(rest).map(Target::Data);
    }
    // A scheme has at least two letters here, so that `C:` reads as the absolute path it is.
    let scheme = uri.split_once(':').map(|(scheme, _)| scheme).filter(|s| s.len() > 1);
    if let Some(scheme) = scheme.filter(|s| s.chars().all(|c| c.is_ascii_alphanumeric() || "+-.".contains(c))) {
        return Err(format!("a `{scheme}:` URI, expected a relative path or a data URI"));
    }
    let path = String::from_utf8(percent_decode(uri)).map_err(|_| "its URI is not UTF-8".to_string())?;
    if path.is_empty() || path.contains('\0') {
        return Err(format!("the path `{}`, expected one relative to the model's file", path.escape_default()));
    }
    Ok(Target::Relative(path))
}

/// Whether a path is absolute or climbs above where it starts, whatever lies there: on any system, so that a file means
/// the same on all.
pub fn leads_out(path: &str) -> bool {
    let absolute = path.starts_with(['/', '\\']) || path.as_bytes().get(1) == Some(&b':');
    let mut depth = 0i64;
    let climbs = path.split(['/', '\\']).any(|part| {
        depth += match part {
            "" | "." => 0,
            ".." => -1,
            _ => 1,
        };
        depth < 0
    });
    absolute || climbs
}

fn data(rest: &str) -> Result<Vec<u8>, String> {
    let (head, body) = rest.split_once(',').ok_or("a data URI without a comma")?;
    let bytes = percent_decode(body);
    if head.ends_with(";base64") { base64(&bytes) } else { Ok(bytes) }
}

fn percent_decode(text: &str) -> Vec<u8> {
    let bytes = text.as_bytes();
    let mut out = Vec::with_capacity(bytes.len());
    let mut at = 0;
    while at < bytes.len() {
        let pair = (bytes[at] == b'%').then(|| (hex(bytes.get(at + 1)), hex(bytes.get(at + 2))));
        if let Some((Some(high), Some(low))) = pair {
            out.push(high << 4 | low);
            at += 3;
        } else {
            out.push(bytes[at]);
            at += 1;
        }
    }
    out
}

fn hex(digit: Option<&u8>) -> Option<u8> {
    char::from(*digit?).to_digit(16).map(|d| d as u8)
}

/// RFC 4648, both alphabets, padding optional, white space skipped.
fn base64(text: &[u8]) -> Result<Vec<u8>, String> {
    let mut out = Vec::with_capacity(text.len() / 4 * 3);
    let (mut bits, mut held) = (0u32, 0);
    for (at, c) in text.iter().enumerate() {
        let digit = match c {
            b'A'..=b'Z' => c - b'A',
            b'a'..=b'z' => c - b'a' + 26,
            b'0'..=b'9' => c - b'0' + 52,
            b'+' | b'-' => 62,
            b'/' | b'_' => 63,
            b'=' => break,
            c if c.is_ascii_whitespace() => continue,
            c => return Err(format!("`{}` at character {at} of its base64 data", c.escape_ascii())),
        };
        bits = bits << 6 | u32::from(digit);
        held += 6;
        if held >= 8 {
            held -= 8;
            out.push((bits >> held) as u8);
        }
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_uris() {
        for (uri, expected) in [
            ("data:application/octet-stream;base64,AAECA/8=", &[0u8, 1, 2, 3, 255][..]),
            ("data:application/octet-stream;base64,AAECA_8", &[0, 1, 2, 3, 255]),
            ("data:;base64,", &[]),
            ("data:text/plain,a%20b", b"a b"),
        ] {
            assert_eq!(parse(uri), Ok(Target::Data(expected.to_vec())), "{uri}");
        }
        assert!(parse("data:;base64,A*").is_err());
        assert!(parse("data:nothing").is_err());
    }

    #[test]
    fn paths() {
        assert_eq!(parse("a%20b/c.bin"), Ok(Target::Relative("a b/c.bin".into())));
        assert_eq!(parse("100%.png"), Ok(Target::Relative("100%.png".into())));
        for refused in ["http://host/x.bin", "file:///x.bin", "", "a%00b"] {
            assert!(parse(refused).is_err(), "{refused}");
        }
    }

    #[test]
    fn paths_that_lead_out_of_the_folder() {
        let leads_out = |uri: &str| match parse(uri) {
            Ok(Target::Relative(path)) => leads_out(&path),
            other => panic!("{uri}: {other:?}"),
        };
        for out in
            ["/etc/x", "C:\\x", "%2fx", "..", "../x", "a/../../x", "%2e%2e/x", "..%2fx", "a\\..\\..\\x", "./../x"]
        {
            assert!(leads_out(out), "{out}");
        }
        for inside in ["x", "a/../x", "./x", "...", "a..b/x", "a/b/../../x"] {
            assert!(!leads_out(inside), "{inside}");
        }
    }
}
