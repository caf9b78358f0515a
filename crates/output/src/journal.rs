//! Finished work on disk, so that an interrupted run can be resumed.
//!
//! The first line contains the kind of work and its identity. A text with details and the records follow, which are
//! only appended: length, content, and a checksum of both. A truncated or damaged record ends the journal; all later
//! work is repeated.

use crate::error::OutputError;
use crate::handle::without_links;
use std::fs::{File, OpenOptions};
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// First bytes of every journal; the number is the version of the format.
const BEGIN: &str = "hertzlamb journal 1 of a ";
/// First bytes of earlier versions, which cannot be resumed.
const EARLIER: [&[u8]; 2] = [b"hlsweep", b"hertzlamb kernel blocks "];
/// Largest size in bytes of the first line, and of the text after it.
const MOST_TEXT_BYTES: u64 = 1 << 20;
/// Bytes of a record in addition to its content.
const FRAME: u64 = 8 + 8;
/// Time between two flushes: work that a power failure may cost, in addition to unrecorded work.
const FLUSH: Duration = Duration::from_secs(5);

/// Title of a journal.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Title {
    /// Kind of work, such as `sweep`.
    pub kind: &'static str,
    /// Identity: the same for the same work.
    pub identity: String,
    /// Details of the work.
    pub about: String,
}

impl Title {
    fn text(&self) -> String {
        let (kind, identity, about) = (self.kind, &self.identity, &self.about);
        format!("{BEGIN}{kind}: {identity} {}\n{about}", about.len())
    }
}

/// A journal open for appending.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: File,
    end: u64,
    flushed: Instant,
}

/// Offset of a record in a journal.
pub type Record = u64;

impl Journal {
    /// Opens or begins the journal at `path`, whose output was claimed, and passes its records to `take`, which returns
    /// whether they are valid.
    ///
    /// Another journal of the same kind is replaced if `drops` returns true for it.
    ///
    /// # Errors
    /// [`OutputError`].
    pub fn open(
        path: &Path,
        title: &Title,
        drops: impl Fn(&Title) -> bool,
        mut take: impl FnMut(Record, &[u8]) -> bool,
    ) -> Result<Self, OutputError> {
        let (path, kind) = (path.to_owned(), title.kind);
        let there = std::fs::symlink_metadata(&path);
        if there.as_ref().is_ok_and(|there| !there.is_file()) {
            return Err(strange(&path));
        }
        let mut options = OpenOptions::new();
        options.read(true).write(true).create_new(there.is_err());
        let mut file = without_links(&mut options)
            .open(&path)
            .map_err(|error| OutputError::writing(&path, error))?;
        let unreadable =
            |error: io::Error| OutputError::Unreadable(path.clone(), error.to_string());
        let opened = file.try_clone();
        let found = opened.and_then(|file| Records::read(file, kind));
        let mut end = 0;
        let other = match found.map_err(unreadable)? {
            Some(mut records) if records.title == *title => {
                end = records.at;
                while let Some((record, kept)) = records.next()
                    && take(record, &kept)
                {
                    end = records.at;
                }
                None
            }
            Some(records) => Some(records.title),
            None => match without_title(&file, title).map_err(unreadable)? {
                Some(earlier) => earlier.then(|| Title {
                    kind,
                    ..Title::default()
                }),
                None => return Err(strange(&path)),
            },
        };
        if other.is_some_and(|other| !drops(&other)) {
            return Err(OutputError::Begun(path, kind));
        }
        let cut = file.set_len(end);
        cut.and_then(|()| file.seek(SeekFrom::Start(end)))
            .map_err(unreadable)?;
        let mut journal = Self {
            path,
            file,
            end,
            flushed: Instant::now(),
        };
        if end == 0 {
            journal.write(title.text().as_bytes())?;
        }
        Ok(journal)
    }

    /// Appends a finished piece of work.
    ///
    /// # Errors
    /// [`OutputError`].
    pub fn append(&mut self, kept: &[u8]) -> Result<Record, OutputError> {
        let record = self.end;
        self.write(&(kept.len() as u64).to_le_bytes())?;
        self.write(kept)?;
        self.write(&sum(kept))?;
        if self.flushed.elapsed() > FLUSH {
            self.flushed = Instant::now();
            let flushed = self.file.sync_data();
            flushed.map_err(|error| OutputError::writing(&self.path, error))?;
        }
        Ok(record)
    }

    /// Reads the content of a record into the buffer `kept`.
    ///
    /// # Errors
    /// An error of the operating system, or a changed journal.
    pub fn read(&self, record: Record, kept: &mut Vec<u8>) -> io::Result<()> {
        let mut file = &self.file;
        file.seek(SeekFrom::Start(record))?;
        if next(&mut file, self.end.saturating_sub(record), kept)? {
            return Ok(());
        }
        let path = self.path.display();
        let changed = format!("{path} was changed while it was read");
        Err(io::Error::other(changed))
    }

    /// Removes the file, whose content is then written elsewhere.
    pub fn remove(self) {
        let _ = std::fs::remove_file(&self.path);
    }

    fn write(&mut self, bytes: &[u8]) -> Result<(), OutputError> {
        let written = self.file.write_all(bytes);
        written.map_err(|error| OutputError::writing(&self.path, error))?;
        self.end += bytes.len() as u64;
        Ok(())
    }
}

/// Whole numbers at the beginning of a record's content: eight bytes each.
pub fn packed<const N: usize>(numbers: [usize; N]) -> Vec<u8> {
    let bytes = numbers.map(|number| (number as u64).to_le_bytes());
    bytes.concat()
}

/// The whole numbers at the beginning of a record's content, and the rest.
pub fn unpacked<const N: usize>(kept: &[u8]) -> Option<([usize; N], &[u8])> {
    let (numbers, rest) = kept.split_at_checked(8 * N)?;
    let (words, _) = numbers.as_chunks();
    let number = |i: usize| u64::from_le_bytes(words[i]) as usize;
    Some((std::array::from_fn(number), rest))
}

/// The error for a file of another program or version.
fn strange(path: &Path) -> OutputError {
    let what =
        "exists and is not work that this program can resume: choose another name for the output";
    OutputError::Refused(path.to_owned(), what.to_owned())
}

/// The contents of a journal's records, in order.
#[derive(Debug)]
pub struct Records {
    /// Title of the journal.
    pub title: Title,
    reader: BufReader<File>,
    /// Offset of the next record.
    at: u64,
    length: u64,
}

impl Records {
    /// Opens a journal of a kind without changing it; none if the file is not such a journal.
    ///
    /// # Errors
    /// [`OutputError::Unreadable`].
    pub fn open(path: &Path, kind: &'static str) -> Result<Option<Self>, OutputError> {
        let open = || {
            // checked before opening: a pipe would block
            if !std::fs::metadata(path)?.is_file() {
                return Err(io::Error::other("it is not a file"));
            }
            Self::read(File::open(path)?, kind)
        };
        open().map_err(|error| OutputError::Unreadable(path.to_owned(), error.to_string()))
    }

    fn read(mut file: File, kind: &'static str) -> io::Result<Option<Self>> {
        let length = file.metadata()?.len();
        file.rewind()?;
        let mut reader = BufReader::new(file);
        let (mut line, mut about) = (Vec::new(), Vec::new());
        reader
            .by_ref()
            .take(MOST_TEXT_BYTES)
            .read_until(b'\n', &mut line)?;
        let parsed = || {
            let line = std::str::from_utf8(&line).ok()?.strip_suffix('\n')?;
            let named = line.strip_prefix(BEGIN)?.strip_prefix(kind)?;
            let (identity, bytes) = named.strip_prefix(": ")?.split_once(' ')?;
            Some((identity.to_owned(), bytes.parse::<u64>().ok()?))
        };
        let Some((identity, bytes)) = parsed().filter(|(_, bytes)| *bytes <= MOST_TEXT_BYTES)
        else {
            return Ok(None);
        };
        let found = reader.by_ref().take(bytes).read_to_end(&mut about)? as u64;
        let about = String::from_utf8(about).ok().filter(|_| found == bytes);
        Ok(about.map(|about| Self {
            title: Title {
                kind,
                identity,
                about,
            },
            reader,
            at: line.len() as u64 + bytes,
            length,
        }))
    }
}

impl Iterator for Records {
    type Item = (Record, Vec<u8>);

    /// None at the end and after damage.
    fn next(&mut self) -> Option<Self::Item> {
        let mut kept = Vec::new();
        let found = next(&mut self.reader, self.length - self.at, &mut kept);
        found.ok().filter(|&is_whole| is_whole)?;
        let at = self.at;
        self.at += kept.len() as u64 + FRAME;
        Some((at, kept))
    }
}

/// Reads the next record; false if it is not valid. `left` is the rest of the file, which limits the memory.
fn next(reader: &mut impl Read, left: u64, kept: &mut Vec<u8>) -> io::Result<bool> {
    let (mut length, mut stated) = ([0; 8], [0; 8]);
    if left < FRAME {
        return Ok(false);
    }
    reader.read_exact(&mut length)?;
    let bytes = u64::from_le_bytes(length);
    if bytes > left - FRAME {
        return Ok(false);
    }
    kept.resize(bytes as usize, 0);
    reader.read_exact(kept)?;
    reader.read_exact(&mut stated)?;
    Ok(sum(kept) == stated)
}

/// Fowler-Noll-Vo hash over words of eight bytes and the length: rows are read back several times, at more than a
/// million per second.
pub(crate) fn sum(kept: &[u8]) -> [u8; 8] {
    let (words, rest) = kept.as_chunks::<8>();
    let mut last = [0; 8];
    last[..rest.len()].copy_from_slice(rest);
    let words = words.iter().copied().map(u64::from_le_bytes);
    let all = words.chain([u64::from_le_bytes(last), kept.len() as u64]);
    let hash = all.fold(0xcbf2_9ce4_8422_2325_u64, |hash, word| {
        let mixed = (hash ^ word).wrapping_mul(0x0100_0000_01b3);
        mixed ^ (mixed >> 29)
    });
    hash.to_le_bytes()
}

/// Whether a file without a readable title is empty or the journal of an earlier version; none for a file of another
/// program.
fn without_title(file: &File, title: &Title) -> io::Result<Option<bool>> {
    let (mut file, mut found) = (file, Vec::new());
    file.rewind()?;
    file.take(MOST_TEXT_BYTES).read_to_end(&mut found)?;
    let begin = format!("{BEGIN}{}: ", title.kind);
    let compared = found.len().min(begin.len());
    // new, or truncated within its title
    let cut_short = found[..compared] == begin.as_bytes()[..compared]
        && (!found.contains(&b'\n') || title.text().as_bytes().starts_with(&found));
    let earlier = EARLIER.iter().any(|begin| found.starts_with(begin));
    Ok((cut_short || earlier).then_some(earlier))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn title(identity: &str) -> Title {
        Title {
            kind: "test",
            identity: identity.to_owned(),
            about: "two\nlines".to_owned(),
        }
    }

    fn open(path: &Path, identity: &str) -> Result<(Journal, Vec<Vec<u8>>), OutputError> {
        let mut found = Vec::new();
        let journal = Journal::open(
            path,
            &title(identity),
            |_| false,
            |_, kept| {
                found.push(kept.to_vec());
                true
            },
        )?;
        Ok((journal, found))
    }

    /// Two records, and the offset of the second.
    fn two(path: &Path) -> usize {
        let (mut journal, none) = open(path, "mine").unwrap();
        assert!(none.is_empty());
        journal.append(b"first").unwrap();
        let second = journal.append(b"second").unwrap();
        let mut kept = b"what was read before".to_vec();
        journal.read(second, &mut kept).unwrap();
        assert_eq!(kept, b"second");
        second as usize
    }

    #[test]
    fn whatever_is_lost_or_changed_the_records_before_it_are_there() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("journal");
        let begin = two(&path);
        let good = std::fs::read(&path).unwrap();
        for length in 0..=good.len() {
            std::fs::write(&path, &good[..length]).unwrap();
            let (mut journal, found) = open(&path, "mine").unwrap();
            let first = title("mine").text().len() + 5 + FRAME as usize;
            let whole = usize::from(length >= first) + usize::from(length >= good.len());
            assert_eq!(found.len(), whole, "{length} bytes");
            journal.append(b"more").unwrap();
            assert_eq!(open(&path, "mine").unwrap().1.len(), whole + 1);
        }
        for place in begin..good.len() {
            let mut bad = good.clone();
            bad[place] ^= 1;
            std::fs::write(&path, &bad).unwrap();
            assert_eq!(open(&path, "mine").unwrap().1, [b"first"], "byte {place}");
        }
    }

    #[test]
    fn what_is_not_of_this_run_is_kept() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("journal");
        two(&path);
        let good = std::fs::read(&path).unwrap();
        assert!(matches!(open(&path, "other"), Err(OutputError::Begun(..))));
        assert_eq!(std::fs::read(&path).unwrap(), good);
        for strange in [
            "mine",
            "hertzlamb journal 1 of a cake: x 3\nabc",
            "hertzlamb\n",
        ] {
            std::fs::write(&path, strange).unwrap();
            assert!(matches!(open(&path, "mine"), Err(OutputError::Refused(..))));
            assert_eq!(std::fs::read_to_string(&path).unwrap(), strange);
        }
        std::fs::write(&path, &good).unwrap();
        let dropped = Journal::open(
            &path,
            &title("other"),
            |of| of.identity == "mine",
            |_, _| true,
        );
        dropped.unwrap().append(b"third").unwrap();
        assert_eq!(open(&path, "other").unwrap().1, [b"third"]);
    }
}
