//! The drafter that asks a language model, over the chat protocol that OpenAI's, llama.cpp's, Ollama's and vLLM's servers speak.
//!
//! ```text
//! prompt ─ ask ─► messages ─ client ─► text ─ parse ─► Answer ─ to_wish ─► Wish ─ contradict ─► problems
//!                    ▲                                                                             │
//!                    └───────────────────────── repair, at most three rounds ◄─────────────────────┘
//! ```
//! A model's text gets nowhere but through the typed answer, and what the answer says must be said by the prompt.

mod answer;
mod ask;
mod client;
mod drafter;
mod error;
mod evidence;
mod exchange;
mod format;
mod key;
mod parse;
mod reply;
mod server;
mod settle;
mod shape;
mod to_wish;
mod translate;

pub use client::{Client, Settings};
pub use drafter::{Asked, Held, ModelDrafter, NotUnderstood, Understood};
pub use error::{Fault, ModelError};
pub use format::{Form, Message, Question, Role};
pub use key::Key;
pub use parse::parse;
pub use reply::Reply;
pub use server::Server;
pub use shape::{Field, Needed, Shape};
