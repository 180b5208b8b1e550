// Mission files as tests: one passes if `nddlc check` finds that not too many of its missions fail.
import {
  type CancellationToken,
  type Disposable,
  RelativePattern,
  type TestController,
  TestMessage,
  type TestRunRequest,
  TestRunProfileKind,
  tests,
  type Uri,
  workspace,
} from "vscode";
import type { Server } from "./client";
import { checkMission, summary } from "./commands";

const PATTERN = "**/mission*.toml";

export function registerTests(server: Server): Disposable {
  const controller = tests.createTestController("nddlc", "NDDL missions");
  const add = (uri: Uri) => controller.items.add(controller.createTestItem(uri.toString(), workspace.asRelativePath(uri), uri));
  controller.resolveHandler = async (item) => {
    if (item === undefined) {
      for (const folder of workspace.workspaceFolders ?? []) {
        (await workspace.findFiles(new RelativePattern(folder, PATTERN), "**/node_modules/**")).forEach(add);
      }
    }
  };
  const watcher = workspace.createFileSystemWatcher(PATTERN, false, true, false);
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
      const result = await checkMission(server, item.uri);
      if (result.verdict === "holds") {
        session.passed(item, Date.now() - begun);
      } else {
        session.failed(item, new TestMessage(summary(result)), Date.now() - begun);
      }
    } catch (problem) {
      session.errored(item, new TestMessage(problem instanceof Error ? problem.message : String(problem)));
    }
  }
  session.end();
}
