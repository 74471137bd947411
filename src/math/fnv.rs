//! 64-bit FNV-1a (Fowler, Noll, Vo): the one hash for fingerprints and for the stages of a frame.
//!
//! Not for hash tables and not against malice: it is short, defined byte for byte, and the same on every machine.

const OFFSET_BASIS: u64 = 0xcbf2_9ce4_8422_2325;
const PRIME: u64 = 0x0000_0100_0000_01b3;

/// A running FNV-1a hash. Numbers go in as their little-endian bytes, floats as their bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fnv64(u64);

impl Default for Fnv64 {
    fn default() -> Self {
        Self(OFFSET_BASIS)
    }
}

impl Fnv64 {
    /// The hash of nothing.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds bytes in order.
    pub fn bytes(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(PRIME);
        }
    }

    /// Adds one 32-bit number.
    pub fn u32(&mut self, value: u32) {
        self.bytes(&value.to_le_bytes());
    }

    /// Adds one 64-bit number.
    pub fn u64(&mut self, value: u64) {
        self.bytes(&value.to_le_bytes());
    }

    /// Adds the bits of one float: `-0.0` and `0.0` differ.
    pub fn f32(&mut self, value: f32) {
        self.u32(value.to_bits());
    }

    /// The hash of all that was added so far.
    pub fn finish(self) -> u64 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::Fnv64;

    /// Test vectors published with the algorithm.
    #[test]
    fn hash_is_fnv_1a_and_no_other() {
        for (text, expected) in
            [("", 0xcbf2_9ce4_8422_2325), ("a", 0xaf63_dc4c_8601_ec8c), ("foobar", 0x8594_4171_f739_67e8)]
        {
            let mut hash = Fnv64::new();
            hash.bytes(text.as_bytes());
            assert_eq!(hash.finish(), expected, "{text:?}");
        }
    }
}
