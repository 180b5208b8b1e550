// Start `nddlc lsp` for models and mission files, start it again when its settings change, and offer its commands.
import { commands, type ExtensionContext, window, workspace } from "vscode";
import { makeClient, type Server } from "./client";
import { registerCommands } from "./commands";
import { registerTests } from "./tests";
import { registerViews } from "./views";

const RESTARTING = ["command", "includeDirectories", "dialect"];

const server: Server = { client: undefined };

async function stop(): Promise<void> {
  try {
    await server.client?.dispose();
  } catch {
    // One that never started, or has crashed, cannot be stopped.
  }
  server.client = undefined;
}

async function start(): Promise<void> {
  await stop();
  const client = makeClient();
  try {
    await client.start();
    server.client = client;
  } catch (problem) {
    const reason = problem instanceof Error ? problem.message : String(problem);
    const setting = "Open the setting";
    void window
      .showErrorMessage(`nddlc could not be started. Install it, or name it in the setting nddlc.command. (${reason})`, setting)
      .then((choice) => choice && commands.executeCommand("workbench.action.openSettings", "nddlc.command"));
  }
}

export async function activate(context: ExtensionContext): Promise<void> {
  context.subscriptions.push(
    commands.registerCommand("nddlc.restart", start),
    workspace.onDidGrantWorkspaceTrust(start),
    workspace.onDidChangeConfiguration(async (event) => {
      if (RESTARTING.some((name) => event.affectsConfiguration(`nddlc.${name}`))) {
        await start();
      }
    }),
    ...registerCommands(server),
    ...registerViews(),
    registerTests(server),
  );
  await start();
}

export const deactivate = stop;
