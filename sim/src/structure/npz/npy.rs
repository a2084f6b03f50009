//! [`Array`]: an array of `NumPy`'s NPY format, read and written.
//!
//! npyz reads these too, but multiplies the numbers of a shape unchecked, so a damaged header ends the
//! program: the few lines that are needed are here.

use super::super::Fault;

const MAGIC: &[u8] = b"\x93NUMPY";
/// The longest header, bytes, and most dimensions.
const HEADER_MAX: usize = 10_000;
const DIMENSIONS_MAX: usize = 8;
/// Letters of a text.
const TEXT_MAX: usize = 100_000;

/// An array.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Array {
    /// The letter of the type: f, i, u, b, U, S.
    kind: char,
    /// Bytes of an element; letters of a text.
    size: usize,
    big: bool,
    /// Whether the first index runs fastest.
    columns_first: bool,
    shape: Vec<usize>,
    data: Vec<u8>,
}

impl Array {
    pub(super) fn parse(bytes: &[u8]) -> Result<Self, Fault> {
        let ended = |wanted: &str| Fault::Ended { wanted: wanted.to_owned() };
        let rest = bytes.strip_prefix(MAGIC).ok_or(Fault::Format)?;
        let (version, rest) = rest.split_first_chunk::<2>().ok_or_else(|| ended("a version"))?;
        let (length, rest) = if version[0] == 1 {
            let (length, rest) = rest.split_first_chunk::<2>().ok_or_else(|| ended("a header"))?;
            (u16::from_le_bytes(*length).into(), rest)
        } else {
            let (length, rest) = rest.split_first_chunk::<4>().ok_or_else(|| ended("a header"))?;
            (usize::try_from(u32::from_le_bytes(*length)).unwrap_or(usize::MAX), rest)
        };
        if length > HEADER_MAX {
            let (what, range) = (String::from("bytes of a header"), [0, HEADER_MAX]);
            return Err(Fault::Number { what, found: length, range });
        }
        let (header, data) = rest.split_at_checked(length).ok_or_else(|| ended("the header"))?;
        let header = String::from_utf8_lossy(header);
        let (big, kind, size) = kind(value(&header, "descr")?)?;
        let columns_first = value(&header, "fortran_order")?.starts_with("True");
        let shape = shape(value(&header, "shape")?)?;
        let letters = if kind == 'U' { 4 } else { 1 };
        let count = shape.iter().try_fold(size * letters, |count, n| count.checked_mul(*n));
        let Some(count) = count.filter(|count| *count <= data.len()) else {
            return Err(ended(&format!("the data of the shape {shape:?}")));
        };
        let data = data.get(..count).unwrap_or_default().to_vec();
        Ok(Self { kind, size, big, columns_first, shape, data })
    }

    /// Numbers of rows, of columns and so on.
    #[cfg(feature = "tool")]
    pub(crate) fn shape(&self) -> &[usize] {
        &self.shape
    }

    /// Its numbers, rows first; of this shape, where one is wanted, or of one dimension.
    pub(crate) fn numbers(&self, wanted: Option<&[usize]>) -> Result<Vec<f64>, Fault> {
        let fits = wanted.map_or(self.shape.len() == 1, |wanted| wanted == self.shape);
        if !fits {
            let wanted =
                wanted.map_or_else(|| vec![self.data.len() / self.size.max(1)], <[_]>::to_vec);
            return Err(Fault::Shape {
                what: "the array".into(),
                found: self.shape.clone(),
                wanted,
            });
        }
        let stored = self.stored()?;
        if !self.columns_first || self.shape.len() < 2 {
            return Ok(stored);
        }
        // The index of each element, rows first, in an order of columns first.
        let mut strides = vec![1; self.shape.len()];
        for axis in 1..self.shape.len() {
            strides[axis] = strides[axis - 1] * self.shape[axis - 1];
        }
        let place = |mut index: usize| {
            let mut place = 0;
            for (n, stride) in self.shape.iter().zip(&strides).rev() {
                place += index % n * stride;
                index /= n;
            }
            place
        };
        Ok((0..stored.len()).map(|index| stored[place(index)]).collect())
    }

    /// Its numbers in the order of the file.
    fn stored(&self) -> Result<Vec<f64>, Fault> {
        fn as_f64<const N: usize>(array: &Array, of: impl Fn([u8; N]) -> f64) -> Vec<f64> {
            let chunks = array.data.chunks_exact(N).map(|chunk| {
                let mut bytes = [0; N];
                bytes.copy_from_slice(chunk);
                if array.big {
                    bytes.reverse();
                }
                of(bytes)
            });
            chunks.collect()
        }
        #[expect(clippy::cast_precision_loss, reason = "integers of a file of numbers")]
        let values = match (self.kind, self.size) {
            ('f', 8) => as_f64(self, f64::from_le_bytes),
            ('f', 4) => as_f64(self, |bytes| f32::from_le_bytes(bytes).into()),
            ('i', 8) => as_f64(self, |bytes| i64::from_le_bytes(bytes) as f64),
            ('i', 4) => as_f64(self, |bytes| i32::from_le_bytes(bytes).into()),
            ('b', 1) => as_f64(self, |[byte]| byte.into()),
            (kind, size) => {
                let found = format!("{kind}{size}");
                return Err(Fault::Type { found, wanted: "doubles (f8)" });
            }
        };
        Ok(values)
    }

    /// Its texts, of one dimension.
    pub(crate) fn texts(&self) -> Result<Vec<String>, Fault> {
        if self.shape.len() == 1 {
            return self.all_texts();
        }
        let (found, wanted) = (self.shape.clone(), vec![self.shape.iter().product()]);
        Err(Fault::Shape { what: "the array".into(), found, wanted })
    }

    /// Its only text.
    pub(super) fn text(&self) -> Result<String, Fault> {
        let mut texts = self.all_texts()?;
        if let (Some(text), true) = (texts.pop(), texts.is_empty()) {
            return Ok(text);
        }
        let (found, wanted) = (self.shape.clone(), Vec::new());
        Err(Fault::Shape { what: "the text".into(), found, wanted })
    }

    fn all_texts(&self) -> Result<Vec<String>, Fault> {
        match self.kind {
            'S' => {
                let text =
                    |chunk: &[u8]| String::from_utf8_lossy(chunk).trim_end_matches('\0').to_owned();
                Ok(self.data.chunks_exact(self.size).map(text).collect())
            }
            'U' => {
                let letter = |bytes: &[u8]| {
                    let bytes = <[u8; 4]>::try_from(bytes).unwrap_or_default();
                    let code = if self.big {
                        u32::from_be_bytes(bytes)
                    } else {
                        u32::from_le_bytes(bytes)
                    };
                    char::from_u32(code).unwrap_or(char::REPLACEMENT_CHARACTER)
                };
                let text = |chunk: &[u8]| {
                    let letters: String = chunk.chunks_exact(4).map(letter).collect();
                    letters.trim_end_matches('\0').to_owned()
                };
                Ok(self.data.chunks_exact(4 * self.size).map(text).collect())
            }
            kind => {
                let found = format!("{kind}{}", self.size);
                Err(Fault::Type { found, wanted: "texts (U)" })
            }
        }
    }
}

/// What follows a key of the header.
fn value<'a>(header: &'a str, key: &str) -> Result<&'a str, Fault> {
    let found = header.split_once(&format!("'{key}':")).map(|(_, rest)| rest.trim_start());
    found.ok_or_else(|| Fault::Ended { wanted: format!("`{key}` of the header") })
}

/// Whether big-endian, letter, size.
fn kind(text: &str) -> Result<(bool, char, usize), Fault> {
    let text = text.strip_prefix('\'').and_then(|text| text.split_once('\'')).map(|(text, _)| text);
    let parsed = text.and_then(|text| {
        let (order, rest) = text.split_at_checked(1)?;
        let (kind, size) = rest.split_at_checked(1)?;
        let size = size.parse::<usize>().ok().filter(|size| (1..=TEXT_MAX).contains(size))?;
        let kind = kind.chars().next().filter(|kind| "fiubUS".contains(*kind))?;
        matches!(order, "<" | ">" | "|" | "=").then_some((order == ">", kind, size))
    });
    parsed.ok_or_else(|| {
        let found = text.unwrap_or_default().chars().take(40).collect();
        Fault::Type { found, wanted: "doubles (f8) or texts (U)" }
    })
}

fn shape(text: &str) -> Result<Vec<usize>, Fault> {
    let inner =
        text.strip_prefix('(').and_then(|text| text.split_once(')')).map(|(inner, _)| inner);
    let numbers = inner.unwrap_or("?").split(',').map(str::trim).filter(|text| !text.is_empty());
    let shape: Result<Vec<usize>, _> = numbers.map(str::parse).collect();
    match shape {
        Ok(shape) if shape.len() <= DIMENSIONS_MAX => Ok(shape),
        _ => {
            let found = text.chars().take(40).collect();
            Err(Fault::NotNumber { wanted: "a shape".into(), found })
        }
    }
}

/// The bytes of an array of a type.
pub(super) fn array(kind: &str, shape: &[usize], data: &[u8]) -> Vec<u8> {
    let numbers: Vec<_> = shape.iter().map(usize::to_string).collect();
    let comma = if shape.len() == 1 { "," } else { "" };
    let shape = format!("({}{comma})", numbers.join(", "));
    let mut header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}");
    // Magic, version, length, header and its line end fill whole blocks of 64 bytes.
    let before = MAGIC.len() + 4;
    let padding = 64 - (before + header.len() + 1) % 64;
    header.extend(std::iter::repeat_n(' ', padding % 64));
    header.push('\n');
    let mut bytes = MAGIC.to_vec();
    bytes.extend([1, 0]);
    bytes.extend(u16::try_from(header.len()).unwrap_or(u16::MAX).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(data);
    bytes
}

/// The bytes of an array of doubles, rows first.
pub(crate) fn numbers(values: &[f64], shape: &[usize]) -> Vec<u8> {
    let data: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    array("<f8", shape, &data)
}

/// The bytes of an array of texts.
pub(crate) fn texts(values: &[&str], shape: &[usize]) -> Vec<u8> {
    let width = values.iter().map(|text| text.chars().count()).max().unwrap_or(0).max(1);
    let padded = |text: &str| {
        let letters = text.chars().map(u32::from).chain(std::iter::repeat(0));
        letters.take(width).flat_map(u32::to_le_bytes).collect::<Vec<u8>>()
    };
    let data: Vec<u8> = values.iter().flat_map(|text| padded(text)).collect();
    array(&format!("<U{width}"), shape, &data)
}
