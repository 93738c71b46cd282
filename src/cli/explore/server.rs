//! Requests of this machine's browser, each in a thread of its own: those that name this server and know its token are answered.

use std::io::Read;
use std::net::{Ipv4Addr, TcpListener};
use std::sync::Arc;
use std::thread;

use tiny_http::{Header, Request, Response};

use crate::cli::failure::Failure;

/// Largest body of a request \[bytes\].
const LARGEST: usize = 1 << 20;
/// In every reply: it is for this page alone, and kept nowhere.
const HEADERS: [(&str, &str); 6] = [
    ("Cache-Control", "no-store"),
    ("Content-Security-Policy", "frame-ancestors 'none'"),
    ("Cross-Origin-Resource-Policy", "same-origin"),
    ("Referrer-Policy", "no-referrer"),
    ("X-Content-Type-Options", "nosniff"),
    ("X-Frame-Options", "DENY"),
];

/// An answer: its status, its kind as in `Content-Type`, its body.
pub type Reply = (u16, &'static str, Vec<u8>);

/// Status of the last answer, after which the server ends.
pub const LAST: u16 = 205;

/// Why there is no answer.
fn refusal(status: u16, words: &str) -> Reply {
    (status, "text/plain; charset=utf-8", words.into())
}

/// A server on the loopback address, for whoever knows its token.
pub struct Server {
    http: tiny_http::Server,
    port: u16,
    token: String,
}

impl Server {
    /// Listens on `port`, or on one that is free if it is 0.
    pub fn new(port: u16, token: String) -> Result<Self, Failure> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(|error| {
            let found = format!("{port}, which cannot be used: {error}");
            let allowed = "a port of this machine that is free; without it a free one is taken";
            Failure::usage("--port", found, allowed)
        })?;
        let port = listener.local_addr()?.port();
        let http = tiny_http::Server::from_listener(listener, None).map_err(std::io::Error::other)?;
        Ok(Self { http, port, token })
    }

    /// Where the page is.
    pub fn address(&self) -> String {
        format!("http://127.0.0.1:{}/?token={}", self.port, self.token)
    }

    /// Answers requests by `answer`, from method, path and body, until a reply is the last.
    pub fn serve(self, answer: impl Fn(&str, &str, &[u8]) -> Reply + Send + Sync + 'static) {
        let shared = Arc::new((self, answer));
        for mut request in shared.0.http.incoming_requests() {
            let shared = Arc::clone(&shared);
            // If there is no thread, this request has no answer.
            let _ = thread::Builder::new().spawn(move || {
                let (server, answer) = &*shared;
                let reply = server.answered(&mut request, answer);
                let (status, kind, body) = reply.unwrap_or_else(|refusal| refusal);
                let headers = HEADERS.into_iter().chain([("Content-Type", kind)]);
                let headers = headers.filter_map(|(name, value)| Header::from_bytes(name, value).ok());
                let response = Response::from_data(body).with_status_code(status);
                let response = headers.fold(response, Response::with_header);
                // A browser that has gone does not want it.
                let _ = request.respond(response.with_chunked_threshold(usize::MAX));
                if status == LAST {
                    server.http.unblock();
                }
            });
        }
    }

    /// The reply to a request, or why it has none.
    fn answered(
        &self,
        request: &mut Request,
        answer: impl Fn(&str, &str, &[u8]) -> Reply,
    ) -> Result<Reply, Reply> {
        let all = |name: &'static str| {
            let is_named = move |header: &&Header| header.field.equiv(name);
            let named = request.headers().iter().filter(is_named);
            named.map(|header| header.value.as_str())
        };
        let hosts = ["127.0.0.1", "localhost"].map(|host| format!("{host}:{}", self.port));
        let is_own = |host: &str| hosts.iter().any(|own| own == host);
        let from_here = |origin: &str| origin.strip_prefix("http://").is_some_and(is_own);
        if all("Host").count() != 1 || !all("Host").all(is_own) || !all("Origin").all(from_here) {
            return Err(refusal(403, "this server answers its own page alone"));
        }
        let (path, query) = request.url().split_once('?').unwrap_or_default();
        if !self.is_token(query.strip_prefix("token=").unwrap_or_default()) {
            let words = "no token, or a wrong one: take the address that was printed";
            return Err(refusal(403, words));
        }
        let (method, path, mut body) = (request.method().to_string(), path.to_owned(), Vec::new());
        let is_large = |length: usize| length > LARGEST;
        if !request.body_length().is_some_and(is_large) {
            let mut reader = request.as_reader().take(LARGEST as u64 + 1);
            let early = |_| refusal(400, "the request ends too early");
            reader.read_to_end(&mut body).map_err(early)?;
        }
        if is_large(request.body_length().unwrap_or_default().max(body.len())) {
            return Err(refusal(413, "found a body of more than 1 MB"));
        }
        Ok(answer(&method, &path, &body))
    }

    /// Compares all letters, however many are right: the time tells nothing.
    fn is_token(&self, found: &str) -> bool {
        let pairs = found.bytes().zip(self.token.bytes());
        found.len() == self.token.len() && pairs.fold(0, |wrong, (a, b)| wrong | (a ^ b)) == 0
    }
}
