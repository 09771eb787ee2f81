//! The built-in drafter: reads requests in English, German, Spanish, French and Chinese with tables of words, offline.

pub(in crate::draft) mod number;
pub(in crate::draft) mod phrases;
pub(in crate::draft) mod place;
pub(in crate::draft) mod quantity;
pub(in crate::draft) mod text;
pub(in crate::draft) mod token;
pub(in crate::draft) mod vocabulary;
