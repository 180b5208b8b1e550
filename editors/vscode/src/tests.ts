// Mission files as tests: one passes if `nddlc check` finds that not too many of its missions fail.
import {
  type CancellationToken,
  type Disposable,
  Location,
  Position,
  RelativePattern,
  type TestController,
  TestMessage,
  type TestRunRequest,
  TestRunProfileKind,
  tests,
  Uri,
  workspace,
} from "vscode";
import type { Server } from "./client";
import { type CheckResult, checkMission, faultText, MISSIONS, summary } from "./commands";

export function registerTests(server: Server): Disposable {
  const controller = tests.createTestController("nddlc", "NDDL missions");
  const add = (uri: Uri) => controller.items.add(controller.createTestItem(uri.toString(), workspace.asRelativePath(uri), uri));
  controller.resolveHandler = async (item) => {
    if (item === undefined) {
      for (const folder of workspace.workspaceFolders ?? []) {
        (await workspace.findFiles(new RelativePattern(folder, MISSIONS), "**/node_modules/**")).forEach(add);
      }
    }
  };
  const watcher = workspace.createFileSystemWatcher(MISSIONS, false, true, false);
  watcher.onDidCreate(add);
  watcher.onDidDelete((uri) => controller.items.delete(uri.toString()));
  controller.createRunProfile("Check", TestRunProfileKind.Run, (request, token) => run(server, controller, request, token), true);
  return { dispose: () => [controller, watcher].forEach((each) => each.dispose()) };
}

async function run(
  server: Server,
  controller: TestController,
  request: TestRunRequest,
  token: CancellationToken,
): Promise<void> {
  const items = request.include ?? [...controller.items].map(([, item]) => item);
  const session = controller.createTestRun(request);
  for (const item of items) {
    if (token.isCancellationRequested || item.uri === undefined || request.exclude?.includes(item)) {
      session.skipped(item);
      continue;
    }
    session.started(item);
    const begun = Date.now();
    try {
      const result = await checkMission(server, item.uri, token);
      session.appendOutput(`${summary(result).replaceAll("\n", "\r\n")}\r\n`, undefined, item);
      if (result.verdict === "holds") {
        session.passed(item, Date.now() - begun);
      } else {
        session.failed(item, messages(result, item.uri), Date.now() - begun);
      }
    } catch (problem) {
      if (token.isCancellationRequested) {
        session.skipped(item);
        continue;
      }
      session.errored(item, new TestMessage(problem instanceof Error ? problem.message : String(problem)));
    }
  }
  session.end();
}

// What failed, each reason at the line that gave way.
function messages(result: CheckResult, mission: Uri): TestMessage[] {
  const found = result.faults.map((fault) => {
    const message = new TestMessage(faultText(fault));
    if (fault.place) {
      const { file, line, column } = fault.place;
      const uri = file.startsWith("/") ? mission.with({ path: file }) : Uri.joinPath(mission, "..", file);
      message.location = new Location(uri, new Position(line - 1, column - 1));
    }
    return message;
  });
  return found.length > 0 ? found : [new TestMessage(summary(result))];
}
