//! Damage to an input: to its bytes, or to a text so that most of its grammar stays.

use crate::draws::Draws;

/// Numbers at the edges of what is allowed, of what a float holds, and beyond.
const NUMBERS: [&str; 48] = [
    "0",
    "-0.0",
    "-1",
    "1",
    "2",
    "3",
    "0.5",
    "0.4999999999999999",
    "-0.9999999999999999",
    "5e-324",
    "1e-310",
    "2.2e-308",
    "1e-300",
    "1e-200",
    "1e-160",
    "1e-100",
    "1e-30",
    "1e-15",
    "1e-9",
    "0.1",
    "0.05",
    "1e3",
    "1e6",
    "1e9",
    "1e12",
    "1e15",
    "1e30",
    "1e100",
    "1e150",
    "1e160",
    "1e200",
    "1e300",
    "1.7e308",
    "1e309",
    "nan",
    "inf",
    "-inf",
    "9223372036854775807",
    "-9223372036854775808",
    "18446744073709551616",
    "2001",
    "100000",
    "1000000",
    "10000000",
    "1000000000000",
    "0xffffffff",
    "1_000",
    "true",
];

/// Words of scenes, and values that are none.
const WORDS: [&str; 30] = [
    "\"steel\"",
    "\"granite\"",
    "\"wave\"",
    "\"growing\"",
    "\"auto\"",
    "\"hertz\"",
    "\"radiation\"",
    "\"quasi_static\"",
    "\"explicit\"",
    "\"implicit\"",
    "\"dynamic\"",
    "\"full\"",
    "\"mean\"",
    "\"centre\"",
    "\"log\"",
    "\"uniform\"",
    "\"normal\"",
    "\"../../etc/passwd\"",
    "\"/dev/zero\"",
    "\".\"",
    "\"\"",
    "'x'",
    "[]",
    "[1, 2]",
    "{}",
    "{ a = 1 }",
    "2020-01-01",
    "\"\\u0000\"",
    "\"pulse.csv\"",
    "[[]]",
];

/// Letters that mean something to a parser.
const LETTERS: [&str; 16] = [
    "\0", "\u{ff}", "\u{202e}", "=", "[", "]", "{", "\"", "'''", "\n", "\r", ",", "#", ".", "-",
    "\u{feff}",
];

/// Makes inputs from good ones.
#[derive(Debug, Clone)]
pub struct Mutator {
    draws: Draws,
}

impl Mutator {
    /// The same inputs for the same seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self {
            draws: Draws::new(seed),
        }
    }

    /// A number below a limit.
    pub fn below(&mut self, limit: usize) -> usize {
        self.draws.below(limit)
    }

    /// A text with one to eight changes, now and then a byte of it too.
    pub fn text(&mut self, good: &str) -> Vec<u8> {
        let mut text = good.to_owned();
        for _ in 0..[1, 1, 1, 2, 2, 3, 4, 8][self.below(8)] {
            self.change(&mut text);
        }
        let mut bytes = text.into_bytes();
        if self.below(40) == 0 {
            bytes = self.bytes(&bytes, 0);
        }
        bytes
    }

    /// Bytes with one to four changes, half of them within the first `head`.
    pub fn bytes(&mut self, good: &[u8], head: usize) -> Vec<u8> {
        let mut bytes = good.to_vec();
        for _ in 0..=self.below(4) {
            if bytes.is_empty() {
                return bytes;
            }
            let near = head.min(bytes.len());
            let at = match self.below(2) {
                0 if near > 0 => self.below(near),
                _ => self.below(bytes.len()),
            };
            let end = (at + [1, 2, 4, 8, 64, 512][self.below(6)]).min(bytes.len());
            match self.below(9) {
                0 | 1 => bytes[at] ^= 1 << self.below(8),
                2 => bytes[at] = self.draws.next() as u8,
                3 => bytes[at..end].fill(0),
                4 => bytes[at..end].fill(0xff),
                5 => {
                    let value = [1, 0x7f, 0xffff, 1 << 31, 1 << 40, u64::MAX >> 1][self.below(6)];
                    let word = value.to_le_bytes();
                    let count = 8.min(bytes.len() - at);
                    bytes[at..at + count].copy_from_slice(&word[..count]);
                }
                6 => {
                    let from = self.below(bytes.len());
                    let count = (end - at).min(bytes.len() - from);
                    let to = at.min(bytes.len() - count);
                    bytes.copy_within(from..from + count, to);
                }
                7 if self.below(4) == 0 => bytes.truncate(at),
                _ => {
                    let part = bytes[at..end].to_vec();
                    bytes.splice(at..at, part);
                }
            }
        }
        bytes
    }

    fn change(&mut self, text: &mut String) {
        match self.below(100) {
            0..62 => self.number(text),
            62..84 => self.lines(text),
            84..92 => self.word(text),
            92..96 => {
                let at = self.place(text);
                text.insert_str(at, self.draws.one(&LETTERS));
            }
            96..99 => {
                let (from, to) = (self.place(text), self.place(text));
                let to = to.clamp(from, from.saturating_add(40).min(text.len()));
                if text.is_char_boundary(to) && from <= to {
                    text.replace_range(from..to, "");
                }
            }
            _ => *text = text.repeat(1 + self.below(3)),
        }
    }

    /// Another number in the place of one.
    fn number(&mut self, text: &mut String) {
        let found = numbers(text);
        let Some(&(from, to)) = found.get(self.draws.below(found.len())) else {
            return;
        };
        let scaled = text[from..to].parse::<f64>().ok();
        let number = match (self.below(10), scaled) {
            (0..4, Some(old)) => format!("{:e}", old * 10_f64.powf(12.0 * self.draws.unit() - 6.0)),
            (4..6, _) => format!("{:e}", 10_f64.powf(60.0 * self.draws.unit() - 30.0)),
            (6, _) => format!("{:e}", 10_f64.powf(628.0 * self.draws.unit() - 320.0)),
            _ => self.draws.one(&NUMBERS).to_owned(),
        };
        text.replace_range(from..to, &number);
    }

    /// A line lost, doubled or in another place.
    fn lines(&mut self, text: &mut String) {
        let mut lines: Vec<&str> = text.split('\n').collect();
        let (i, k) = (self.below(lines.len()), self.below(lines.len()));
        match self.below(3) {
            0 => drop(lines.remove(i)),
            1 => lines.insert(k, lines[i]),
            _ => lines.swap(i, k),
        }
        *text = lines.join("\n");
    }

    /// Another value behind an equals sign.
    fn word(&mut self, text: &mut String) {
        let signs: Vec<usize> = text.match_indices('=').map(|(at, _)| at + 1).collect();
        let Some(&from) = signs.get(self.draws.below(signs.len())) else {
            return;
        };
        let to = text[from..].find('\n').map_or(text.len(), |n| from + n);
        let word = format!(" {}", self.draws.one(&WORDS));
        text.replace_range(from..to, &word);
    }

    /// A place between letters.
    fn place(&mut self, text: &str) -> usize {
        let mut at = self.below(text.len() + 1);
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        at
    }
}

/// Where the numbers of a text are.
fn numbers(text: &str) -> Vec<(usize, usize)> {
    let bytes = text.as_bytes();
    let of_number = |b: u8| b.is_ascii_digit() || b".eE+-_".contains(&b);
    let of_word = |b: u8| b.is_ascii_alphanumeric() || b == b'_' || b == b'.';
    let (mut found, mut at) = (Vec::new(), 0);
    while at < bytes.len() {
        let starts = bytes[at].is_ascii_digit() && (at == 0 || !of_word(bytes[at - 1]));
        let mut end = at + 1;
        if starts {
            while end < bytes.len() && of_number(bytes[end]) {
                end += 1;
            }
            found.push((at, end));
        }
        at = end;
    }
    found
}
