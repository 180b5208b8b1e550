// Pages in a panel beside the text. They hold no scripts, load nothing, and lead nowhere but to lines of models.
import { ColorThemeKind, commands, type Disposable, Range, Uri, ViewColumn, type WebviewPanel, window } from "vscode";

const POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:";
const OPEN = "nddlc.openPlace";
const PLACE = /<span class="at" data-file="([^"]*)" data-line="(\d+)">([^<]*)<\/span>/g;
const SHOWN = /^([ \t]*--> )([^\n]+?):(\d+)/gm; // a place in the text of a command
const LOOK =
  "<style>html { background: var(--vscode-editor-background); } pre a.at { color: var(--vscode-textLink-foreground); }</style>";

interface Page {
  panel: WebviewPanel;
  html: string;
}

const pages = new Map<string, Page>();

export function registerViews(): Disposable[] {
  return [
    window.onDidChangeActiveColorTheme(() => pages.forEach(draw)),
    commands.registerCommand(OPEN, openPlace),
  ];
}

// Show a page; what it says of files is said of those in `folder`.
export function showPage(title: string, html: string, folder: Uri): void {
  const known = pages.get(title);
  const page: Page = known ?? { panel: makePanel(title), html };
  page.html = guarded(linked(html, folder));
  pages.set(title, page);
  draw(page);
  page.panel.reveal(undefined, true);
}

export function showText(title: string, text: string, folder: Uri): void {
  const escaped = text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll('"', "&quot;");
  const marked = escaped.replace(SHOWN, (_, arrow: string, file: string, line: string) =>
    `${arrow}<span class="at" data-file="${file}" data-line="${line}">${file}:${line}</span>`);
  const style = "pre { white-space: pre-wrap; overflow-wrap: anywhere; font-family: var(--vscode-editor-font-family); }";
  showPage(title, `<!DOCTYPE html><html><head><style>${style}</style></head><body><pre>${marked}</pre></body></html>`, folder);
}

function makePanel(title: string): WebviewPanel {
  const panel = window.createWebviewPanel("nddlc", title, { viewColumn: ViewColumn.Beside, preserveFocus: true }, {
    enableScripts: false,
    enableFindWidget: true,
    enableCommandUris: [OPEN],
    localResourceRoots: [],
  });
  panel.onDidDispose(() => pages.delete(title));
  return panel;
}

function draw(page: Page): void {
  const { kind } = window.activeColorTheme;
  page.panel.webview.html = themed(page.html, kind === ColorThemeKind.Dark || kind === ColorThemeKind.HighContrast);
}

// A page follows the theme of the editor, which need not be that of the desktop.
function themed(html: string, isDark: boolean): string {
  return html
    .replace(/@media\s*\(prefers-color-scheme:\s*dark\)/g, isDark ? "@media all" : "@media not all")
    .replace(/color-scheme:\s*light dark/g, `color-scheme: ${isDark ? "dark" : "light"}`);
}

function guarded(html: string): string {
  const policy = `<meta http-equiv="Content-Security-Policy" content="${POLICY}">`;
  return html.replace("<head>", `<head>${policy}`).replace("</head>", `${LOOK}</head>`);
}

function linked(html: string, folder: Uri): string {
  return html.replace(PLACE, (_, file: string, line: string, text: string) => {
    const place = encodeURIComponent(JSON.stringify([folder.toString(), plain(file), Number(line)]));
    return `<a class="at" href="command:${OPEN}?${place}">${text}</a>`;
  });
}

function plain(html: string): string {
  const signs: Record<string, string> = { "&lt;": "<", "&gt;": ">", "&quot;": '"', "&#x27;": "'", "&amp;": "&" };
  return html.replace(/&(?:lt|gt|quot|#x27|amp);/g, (sign) => signs[sign]);
}

async function openPlace(folder: string, file: string, line: number): Promise<void> {
  const root = Uri.parse(folder);
  const uri = /^(\/|[A-Za-z]:)/.test(file) ? Uri.file(file) : Uri.joinPath(root, file);
  const at = new Range(line - 1, 0, line - 1, 0);
  await window.showTextDocument(uri, { viewColumn: ViewColumn.One, selection: at });
}
