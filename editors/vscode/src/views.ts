// Pages in a panel beside the text. They hold no scripts, load nothing, and may not leave the panel.
import { ViewColumn, type WebviewPanel, window } from "vscode";

const POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:";
const panels = new Map<string, WebviewPanel>();

export function showPage(title: string, html: string): void {
  let panel = panels.get(title);
  if (panel === undefined) {
    panel = window.createWebviewPanel("nddlc", title, { viewColumn: ViewColumn.Beside, preserveFocus: true }, {
      enableScripts: false,
      localResourceRoots: [],
    });
    panel.onDidDispose(() => panels.delete(title));
    panels.set(title, panel);
  }
  panel.webview.html = guarded(html);
  panel.reveal(undefined, true);
}

export function showText(title: string, text: string): void {
  const escaped = text.replaceAll("&", "&amp;").replaceAll("<", "&lt;");
  const style = "pre { white-space: pre-wrap; font-family: var(--vscode-editor-font-family); }";
  showPage(title, `<!DOCTYPE html><html><head><style>${style}</style></head><body><pre>${escaped}</pre></body></html>`);
}

export function guarded(html: string): string {
  const policy = `<meta http-equiv="Content-Security-Policy" content="${POLICY}">`;
  return html.includes("<head>") ? html.replace("<head>", `<head>${policy}`) : `${policy}${html}`;
}
