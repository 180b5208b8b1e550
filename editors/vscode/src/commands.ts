// Commands: check a mission, explain its last failure, show a plan, show places that a lens counts.
import { type CancellationToken, commands, type Disposable, Location, Position, Uri, ViewColumn, window, workspace } from "vscode";
import type { Server } from "./client";
import { showPage, showText } from "./views";

export const MISSIONS = "**/mission*.toml";

export interface Fault {
  code: string;
  meaning: string;
  because: string;
  count: number;
  place: { file: string; line: number; column: number } | null;
}

export interface CheckResult {
  verdict: string;
  counts: { pass: number; fail: number; error: number };
  faults: Fault[];
  report: string;
}

interface View {
  code: number;
  text: string;
  errors: string;
}

export function registerCommands(server: Server): Disposable[] {
  return [
    commands.registerCommand("nddlc.checkMission", (uri?: Uri) => tell(() => checkAndTell(server, uri))),
    commands.registerCommand("nddlc.explain", (uri?: Uri) => tell(() => carryOut(server, "nddl.explain", uri))),
    commands.registerCommand("nddlc.certify", (uri?: Uri) => tell(() => carryOut(server, "nddl.certify", uri))),
    commands.registerCommand("nddlc.viewPlan", (uri?: Uri) => tell(() => viewPlan(server, uri))),
    commands.registerCommand("nddlc.showReport", (uri?: Uri) => tell(() => showReport(folderOf(chosen(uri))))),
    commands.registerCommand("nddlc.showReferences", showPlaces("vscode.executeReferenceProvider")),
    commands.registerCommand("nddlc.showRules", showPlaces("vscode.executeImplementationProvider")),
  ];
}

export async function checkMission(server: Server, uri: Uri, token?: CancellationToken): Promise<CheckResult> {
  await workspace.saveAll(false);
  const missions = workspace.getConfiguration("nddlc").get<number>("missions", 0);
  return ask(server, "workspace/executeCommand", { command: "nddl.check", arguments: [uri.toString(), missions] }, token);
}

export function faultText(fault: Fault): string {
  return `${fault.count} × ${fault.code}, ${fault.meaning}: ${fault.because}`;
}

export function summary(result: CheckResult): string {
  const { pass, fail, error } = result.counts;
  const reasons = result.faults.map(faultText);
  return [`${pass + fail + error} missions: ${fail} failed, ${error} ended with an error`, ...reasons].join("\n");
}

async function ask<Answer>(server: Server, method: string, params: object, token?: CancellationToken): Promise<Answer> {
  if (server.client === undefined) {
    throw new Error("the language server does not run");
  }
  // A third argument that is undefined would be taken for a parameter.
  const { client } = server;
  return token ? client.sendRequest<Answer>(method, params, token) : client.sendRequest<Answer>(method, params);
}

async function tell(action: () => Promise<void>): Promise<void> {
  try {
    await action();
  } catch (problem) {
    void window.showErrorMessage(`nddlc: ${problem instanceof Error ? problem.message : String(problem)}`);
  }
}

function chosen(uri: Uri | undefined): Uri {
  const found = uri ?? window.activeTextEditor?.document.uri;
  if (found === undefined) {
    throw new Error("open a file first");
  }
  return found;
}

// The mission file at hand, else the only one of the workspace, else the one that the user picks.
async function chosenMission(given?: Uri): Promise<Uri | undefined> {
  const open = given ?? window.activeTextEditor?.document.uri;
  if (open !== undefined && open.path.endsWith(".toml")) {
    return open;
  }
  const found = await workspace.findFiles(MISSIONS, "**/node_modules/**");
  if (found.length === 0) {
    throw new Error("there is no mission file here: `nddlc new` begins one");
  }
  const items = found.map((uri) => ({ label: workspace.asRelativePath(uri), uri })).sort((a, b) => a.label.localeCompare(b.label));
  return items.length === 1 ? items[0].uri : (await window.showQuickPick(items, { placeHolder: "Which mission?" }))?.uri;
}

async function checkAndTell(server: Server, given?: Uri): Promise<void> {
  const uri = await chosenMission(given);
  if (uri !== undefined) {
    await showResult("nddl.check", await checkMission(server, uri), uri);
  }
}

async function carryOut(server: Server, command: string, given?: Uri): Promise<void> {
  const uri = await chosenMission(given);
  if (uri === undefined) {
    return;
  }
  await workspace.saveAll(false);
  await showResult(command, await ask(server, "workspace/executeCommand", { command, arguments: [uri.toString()] }), uri);
}

// Show the user how a command of the server ended.
export async function showResult(command: string, result: unknown, uri: Uri): Promise<void> {
  switch (command) {
    case "nddl.check":
      return showCheck(result as CheckResult, folderOf(uri));
    case "nddl.explain":
      return showText(`Last failure of ${nameOf(uri)}`, String(result), folderOf(uri));
    case "nddl.certify":
      return showText(`Certificate of ${nameOf(uri)}`, String(result), folderOf(uri));
  }
}

async function showCheck(result: CheckResult, folder: Uri): Promise<void> {
  const choice = await window.showInformationMessage(summary(result), "Show the report");
  if (choice !== undefined) {
    await showReport(folder);
  }
}

async function showReport(folder: Uri): Promise<void> {
  const report = Uri.joinPath(folder, "nddlc-report", "report.html");
  let page: Uint8Array;
  try {
    page = await workspace.fs.readFile(report);
  } catch {
    throw new Error("there is no report yet: check a mission first");
  }
  showPage("Report of the last check", new TextDecoder().decode(page), folder);
}

// Where the server keeps the runs and reports of a mission file: the folder of the workspace, else its own.
function folderOf(uri: Uri): Uri {
  return workspace.getWorkspaceFolder(uri)?.uri ?? Uri.joinPath(uri, "..");
}

function nameOf(uri: Uri): string {
  return uri.path.slice(uri.path.lastIndexOf("/") + 1);
}

async function viewPlan(server: Server, given?: Uri): Promise<void> {
  const uri = chosen(given);
  await workspace.saveAll(false);
  const view = await ask<View>(server, "nddl/viewPlan", { uri: uri.toString() });
  if (view.text.trim()) {
    showPage(`Plan of ${nameOf(uri)}`, view.text, folderOf(uri));
  } else {
    throw new Error(view.errors.trim() || "there is no plan");
  }
}

// A lens counts places; the editor looks them up and shows them.
function showPlaces(provider: string): (uri: string, at: { line: number; character: number }) => Promise<void> {
  return async (uri, at) => {
    const target = Uri.parse(uri);
    const position = new Position(at.line, at.character);
    const places = await commands.executeCommand<Location[]>(provider, target, position);
    await window.showTextDocument(target, { viewColumn: ViewColumn.Active });
    await commands.executeCommand("editor.action.showReferences", target, position, places ?? []);
  };
}
