//! What a page was made from, so that it can be checked later.

/// A file that was read for a page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// Its name.
    pub name: String,
    /// SHA-256 of its content, in hexadecimal digits, as `sha256sum` prints it.
    pub sha256: String,
}

impl Source {
    /// The file `name` with this content.
    ///
    /// ```
    /// use creepage_report::Source;
    ///
    /// // FIPS 180-2, appendix B.1.
    /// let source = Source::new("abc.txt", b"abc");
    /// assert_eq!(source.sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    /// ```
    pub fn new(name: impl Into<String>, content: &[u8]) -> Self {
        let digest = hmac_sha256::Hash::hash(content);
        let sha256: Vec<String> = digest.iter().map(|byte| format!("{byte:02x}")).collect();
        Self {
            name: name.into(),
            sha256: sha256.concat(),
        }
    }
}
