//! Starts `nddlc lsp` for models and mission files.

use zed_extension_api::settings::LspSettings;
use zed_extension_api::{register_extension, Command, Extension, LanguageServerId, Result, Worktree};

struct Nddl;

impl Extension for Nddl {
    fn new() -> Self {
        Nddl
    }

    /// The command of the settings (`lsp.nddlc.binary`), else the `nddlc` on the path of the project.
    fn language_server_command(&mut self, server: &LanguageServerId, worktree: &Worktree) -> Result<Command> {
        let binary = LspSettings::for_worktree(server.as_ref(), worktree)?.binary;
        let (path, arguments) = binary.map_or((None, None), |binary| (binary.path, binary.arguments));
        let command = path
            .or_else(|| worktree.which("nddlc"))
            .ok_or("nddlc is not on the path: `pip install nddlc`, or set lsp.nddlc.binary.path")?;
        Ok(Command {
            command,
            args: arguments.unwrap_or_else(|| vec!["lsp".into()]),
            env: worktree.shell_env(),
        })
    }
}

register_extension!(Nddl);
