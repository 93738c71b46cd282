//! One value of a document, to be read.

use crate::document::{Content, Document, Node, joined};
use crate::error::{SceneError, WrongKind, did_you_mean};
use crate::nearest::nearest;

#[derive(Clone)]
pub struct Value<'d> {
    pub document: &'d Document,
    /// Its key with those of the tables around it; empty for the document.
    pub path: String,
    pub node: &'d Node,
}

impl<'d> Value<'d> {
    /// A value within this one.
    pub fn child(&self, key: &str, node: &'d Node) -> Self {
        let (document, path) = (self.document, joined(&self.path, key));
        Self { document, path, node }
    }

    pub fn items(&self, allowed: &str) -> Result<Vec<Self>, SceneError> {
        let Content::List(items) = &self.node.content else {
            return Err(self.wrong_type(allowed));
        };
        let item = |(index, node): (usize, &'d Node)| self.child(&index.to_string(), node);
        Ok(items.iter().enumerate().map(item).collect())
    }

    pub fn text(&self, allowed: &str) -> Result<&'d str, SceneError> {
        match &self.node.content {
            Content::Text(text) => Ok(text),
            _ => Err(self.wrong_type(allowed)),
        }
    }

    /// What one of the `words` stands for.
    pub fn word<T: Copy>(&self, words: &[(&str, T)], allowed: &str) -> Result<T, SceneError> {
        let text = self.text(allowed)?;
        let meant = words.iter().find(|(word, _)| *word == text);
        meant.map(|(_, meaning)| *meaning).ok_or_else(|| {
            let near = did_you_mean(nearest(text, words.iter().map(|(word, _)| *word)));
            self.wrong(WrongKind::Value, self.written() + &near, allowed)
        })
    }

    /// As it was written.
    pub fn written(&self) -> String {
        self.document.written(&self.node.span)
    }

    pub fn wrong_type(&self, allowed: impl Into<String>) -> SceneError {
        let kind = match self.node.content {
            Content::Text(_) => "the text ",
            Content::Whole(_) | Content::Number(_) => "the number ",
            Content::Other => "",
            Content::List(_) => "the list ",
            Content::Table(_) => "the table ",
        };
        self.wrong(WrongKind::Value, format!("{kind}{}", self.written()), allowed)
    }

    pub fn wrong(&self, kind: WrongKind, found: impl Into<String>, allowed: impl Into<String>) -> SceneError {
        self.document
            .wrong(kind, &self.node.span, &self.path, found, allowed)
    }
}
