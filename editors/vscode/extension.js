// Start `nddlc lsp` for NDDL texts, and start it again when its settings change.
const { commands, window, workspace } = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client;

function withFolder(text) {
  const folder = workspace.workspaceFolders?.[0]?.uri.fsPath ?? "";
  return text.replaceAll("${workspaceFolder}", folder);
}

function makeClient() {
  const settings = workspace.getConfiguration("nddlc");
  const dialect = settings.get("dialect");
  const server = {
    command: withFolder(settings.get("command")),
    args: ["lsp", ...(dialect ? ["--dialect", dialect] : [])],
    options: { cwd: workspace.workspaceFolders?.[0]?.uri.fsPath },
  };
  return new LanguageClient("nddlc", "NDDL", server, {
    documentSelector: [{ language: "nddl" }],
    initializationOptions: {
      includeDirectories: settings.get("includeDirectories").map(withFolder),
      isTrusted: workspace.isTrusted,
    },
    synchronize: { fileEvents: workspace.createFileSystemWatcher("**/*.nddl") },
  });
}

async function stop() {
  try {
    await client?.dispose();
  } catch {
    // One that never started, or has crashed, cannot be stopped.
  }
}

async function start() {
  await stop();
  client = makeClient();
  try {
    await client.start();
  } catch (problem) {
    window.showErrorMessage(
      `nddlc could not be started (${problem.message}). Install it, or name it in the setting nddlc.command.`,
    );
  }
}

async function activate(context) {
  context.subscriptions.push(
    commands.registerCommand("nddlc.restart", start),
    workspace.onDidGrantWorkspaceTrust(start),
    workspace.onDidChangeConfiguration((event) => {
      if (["command", "includeDirectories", "dialect"].some((name) => event.affectsConfiguration(`nddlc.${name}`))) {
        return start();
      }
    }),
  );
  await start();
}

module.exports = { activate, deactivate: stop };
