// Commands: check a mission, explain its last failure, show a plan, show places that a lens counts.
import { commands, type Disposable, Location, Position, Uri, ViewColumn, window, workspace } from "vscode";
import type { Server } from "./client";
import { showPage, showText } from "./views";

export interface Fault {
  code: string;
  meaning: string;
  because: string;
  count: number;
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
    commands.registerCommand("nddlc.viewConflict", (uri?: Uri) => tell(() => viewConflict(server, uri))),
    commands.registerCommand("nddlc.showReferences", showPlaces("vscode.executeReferenceProvider")),
    commands.registerCommand("nddlc.showRules", showPlaces("vscode.executeImplementationProvider")),
  ];
}

export async function checkMission(server: Server, uri: Uri): Promise<CheckResult> {
  await workspace.saveAll(false);
  const missions = workspace.getConfiguration("nddlc").get<number>("missions", 0);
  return ask(server, "workspace/executeCommand", { command: "nddl.check", arguments: [uri.toString(), missions] });
}

export function summary(result: CheckResult): string {
  const { pass, fail, error } = result.counts;
  const reasons = result.faults.map((fault) => `${fault.count} × ${fault.code}, ${fault.meaning}: ${fault.because}`);
  return [`${pass + fail + error} missions: ${fail} failed, ${error} ended with an error`, ...reasons].join("\n");
}

async function ask<Answer>(server: Server, method: string, params: object): Promise<Answer> {
  if (server.client === undefined) {
    throw new Error("the language server does not run");
  }
  return server.client.sendRequest<Answer>(method, params);
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

async function checkAndTell(server: Server, given?: Uri): Promise<void> {
  await showResult("nddl.check", await checkMission(server, chosen(given)));
}

async function carryOut(server: Server, command: string, given?: Uri): Promise<void> {
  const uri = chosen(given).toString();
  await workspace.saveAll(false);
  await showResult(command, await ask(server, "workspace/executeCommand", { command, arguments: [uri] }));
}

// Show the user how a command of the server ended.
export async function showResult(command: string, result: unknown): Promise<void> {
  switch (command) {
    case "nddl.check":
      return showCheck(result as CheckResult);
    case "nddl.explain":
      return showText("Last failure", String(result));
    case "nddl.certify":
      return showText("Certificate", String(result));
  }
}

async function showCheck(result: CheckResult): Promise<void> {
  const choice = await window.showInformationMessage(summary(result), "Show the report");
  if (choice !== undefined) {
    const report = Uri.parse(result.report);
    showPage(report.path.split("/").at(-1) ?? "report", new TextDecoder().decode(await workspace.fs.readFile(report)));
  }
}

async function viewPlan(server: Server, given?: Uri): Promise<void> {
  const uri = chosen(given);
  await workspace.saveAll(false);
  const view = await ask<View>(server, "nddl/viewPlan", { uri: uri.toString() });
  if (view.text.trim()) {
    showPage(`Plan of ${uri.path.split("/").at(-1)}`, view.text);
  } else {
    throw new Error(view.errors.trim() || "there is no plan");
  }
}

async function viewConflict(server: Server, given?: Uri): Promise<void> {
  const uri = chosen(given);
  await workspace.saveAll(false);
  const view = await ask<View>(server, "nddl/viewConflict", { uri: uri.toString() });
  showText(`Search of ${uri.path.split("/").at(-1)}`, view.text + view.errors);
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
