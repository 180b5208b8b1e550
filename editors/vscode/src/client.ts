// The client of the language server, as the settings want it.
import { Uri, workspace } from "vscode";
import { LanguageClient, type LanguageClientOptions, type ServerOptions } from "vscode-languageclient/node";
import { showResult } from "./commands";

// What runs now; undefined while nothing does.
export interface Server {
  client: LanguageClient | undefined;
}

function withFolder(text: string): string {
  const folder = workspace.workspaceFolders?.[0]?.uri.fsPath ?? "";
  return text.replaceAll("${workspaceFolder}", folder);
}

export function makeClient(): LanguageClient {
  const settings = workspace.getConfiguration("nddlc");
  const dialect = settings.get<string>("dialect", "");
  const options: ServerOptions = {
    command: withFolder(settings.get<string>("command", "nddlc")),
    args: ["lsp", ...(dialect ? ["--dialect", dialect] : [])],
    options: { cwd: workspace.workspaceFolders?.[0]?.uri.fsPath },
  };
  const clientOptions: LanguageClientOptions = {
    documentSelector: [
      { language: "nddl" },
      { scheme: "file", pattern: "**/mission*.toml" },
      { scheme: "file", pattern: "**/*solver*.toml" },
      { scheme: "file", pattern: "**/nddlc.toml" },
      { scheme: "file", language: "xml" },
      { scheme: "file", pattern: "**/*.cfg" },
    ],
    initializationOptions: {
      includeDirectories: settings.get<string[]>("includeDirectories", []).map(withFolder),
      isTrusted: workspace.isTrusted,
      showsResults: true,
      inlayHints: settings.get("inlayHints", {}),
    },
    middleware: {
      // A lens calls a command of the server, whose answer the client would drop.
      executeCommand: async (command, args, next) => {
        await workspace.saveAll(false);
        const result: unknown = await next(command, args);
        if (typeof args[0] === "string") {
          void showResult(command, result, Uri.parse(args[0]));
        }
        return result;
      },
    },
    synchronize: { configurationSection: "nddlc" },
  };
  return new LanguageClient("nddlc", "NDDL", options, clientOptions);
}
