//! Deflation undone.

use zlib_rs::{Inflate, InflateFlush, Status};

/// Bits of the largest window of a stream.
const WINDOW: u8 = 15;

/// Bytes of a stream with its header and checksum, of which some have been made.
struct Stream<'d> {
    inflate: Inflate,
    rest: &'d [u8],
    is_at_end: bool,
}

impl<'d> Stream<'d> {
    fn new(data: &'d [u8]) -> Self {
        Self { inflate: Inflate::new(true, WINDOW), rest: data, is_at_end: false }
    }

    /// The number of bytes that come next, as many as there is room for or as there are; none if
    /// the stream is broken.
    fn fill(&mut self, mut room: &mut [u8]) -> Option<usize> {
        let whole = room.len();
        while !self.is_at_end {
            let before = [self.inflate.total_in(), self.inflate.total_out()];
            let status = self.inflate.decompress(self.rest, room, InflateFlush::NoFlush).ok()?;
            let taken = (self.inflate.total_in() - before[0]) as usize;
            let given = (self.inflate.total_out() - before[1]) as usize;
            (self.rest, room) = (&self.rest[taken..], &mut room[given..]);
            self.is_at_end = status == Status::StreamEnd;
            if !self.is_at_end && room.is_empty() {
                break;
            }
            if !self.is_at_end && taken + given == 0 {
                // it has ended too soon
                return None;
            }
        }
        Some(whole - room.len())
    }

    /// True if so many bytes come next.
    fn skip(&mut self, mut bytes: u64) -> bool {
        let mut sink = [0; 1 << 12];
        while bytes > 0 {
            let room = bytes.min(sink.len() as u64);
            if self.fill(&mut sink[..room as usize]) != Some(room as usize) {
                return false;
            }
            bytes -= room;
        }
        true
    }

    /// True if nothing comes any more; the checksum at the end has been looked at then.
    fn ends(&mut self) -> bool {
        self.fill(&mut [0]) == Some(0)
    }
}

/// The first `keep` bytes of each of `count` planes of `length` bytes; of whole planes the stream
/// must end with them.
pub(super) fn planes(data: &[u8], count: usize, length: u64, keep: usize) -> Option<Vec<u8>> {
    let (mut planes, mut stream) = (vec![0; keep * count], Stream::new(data));
    if keep as u64 == length {
        let is_whole = stream.fill(&mut planes)? == planes.len() && stream.ends();
        return is_whole.then_some(planes);
    }
    for (k, plane) in planes.chunks_exact_mut(keep.max(1)).enumerate() {
        let skipped = if k + 1 < count { length - keep as u64 } else { 0 };
        if stream.fill(plane)? != keep || !stream.skip(skipped) {
            return None;
        }
    }
    Some(planes)
}

/// All bytes, at most so many.
pub(super) fn all(data: &[u8], most: usize) -> Option<Vec<u8>> {
    let (mut all, mut stream) = (Vec::new(), Stream::new(data));
    while !stream.is_at_end && all.len() < most {
        let begun = all.len();
        all.resize(most.min(2 * begun + STEP), 0);
        let count = stream.fill(&mut all[begun..])?;
        all.truncate(begun + count);
    }
    Some(all)
}

/// Bytes that are made at once at first.
const STEP: usize = 1 << 16;

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;

    fn deflated(bytes: &[u8]) -> Vec<u8> {
        crate::hdf5::layout::deflated(bytes).expect("a stream")
    }

    /// Bytes that shrink to about a half.
    fn bytes(length: usize) -> Vec<u8> {
        let mut random = Random(9);
        (0..length).map(|_| (16.0 * random.unit()) as u8).collect()
    }

    #[test]
    fn beginnings_of_planes() {
        for (count, length) in [(1, 100_000), (8, 10_000), (3, 5)] {
            let bytes = bytes(count * length);
            let stream = deflated(&bytes);
            for keep in [1, length / 2, length - 1, length] {
                let expected: Vec<_> = bytes.chunks(length).flat_map(|p| &p[..keep]).collect();
                let found = planes(&stream, count, length as u64, keep).expect("whole");
                assert!(found.iter().eq(expected), "{keep} of {length}");
            }
        }
    }

    /// A stream that ends too soon, goes on, or has a wrong checksum.
    #[test]
    fn broken_streams() {
        let bytes = bytes(10_000);
        let stream = deflated(&bytes);
        let whole = |stream: &[u8], length: usize| planes(stream, 1, length as u64, length);
        assert!(whole(&stream, bytes.len()).is_some());
        assert!(whole(&stream, bytes.len() - 1).is_none() && whole(&stream, 10_001).is_none());
        for end in [0, 1, 2, 1000, stream.len() - 5, stream.len() - 1] {
            assert!(whole(&stream[..end], bytes.len()).is_none(), "{end}");
        }
        let mut wrong = stream.clone();
        *wrong.last_mut().expect("a checksum") ^= 1;
        assert!(whole(&wrong, bytes.len()).is_none());
        // the checksum of what is left out is not asked for
        assert!(planes(&wrong, 1, 10_000, 9_999).is_some());
        assert!(planes(&stream, 2, 10_000, 100).is_none());
    }

    #[test]
    fn as_much_as_there_is_room_for() {
        let bytes = bytes(300_000);
        let stream = deflated(&bytes);
        assert_eq!(all(&stream, 1 << 20).as_deref(), Some(bytes.as_slice()));
        assert_eq!(all(&stream, 70_000).as_deref(), Some(&bytes[..70_000]));
        assert_eq!(all(&stream[..1000], 1 << 20), None);
    }
}
