// As much of the editor as pages need: it keeps what is shown, and lets a test change the theme.
export const ColorThemeKind = { Light: 1, Dark: 2, HighContrast: 3, HighContrastLight: 4 };
export const ViewColumn = { One: 1, Beside: -2 };
export const shown = new Map();
export const opened = [];
export const registered = new Map();
const listeners = [];

export class Range {
  constructor(...numbers) {
    this.numbers = numbers;
  }
}

export const Uri = {
  parse: (text) => ({ path: new URL(text).pathname, toString: () => text }),
  file: (path) => ({ path, toString: () => `file://${path}` }),
  joinPath: (base, ...parts) => Uri.file(new URL(parts.join("/"), `file://${base.path}/`).pathname),
};

export const window = {
  activeColorTheme: { kind: ColorThemeKind.Light },
  onDidChangeActiveColorTheme: (listener) => listeners.push(listener),
  createWebviewPanel: (_, title, __, options) => {
    const panel = { webview: { html: "" }, options, onDidDispose: (end) => (panel.dispose = end), reveal: () => {} };
    shown.set(title, panel);
    return panel;
  },
  showTextDocument: async (uri, options) => opened.push([uri.path, options.selection.numbers[0]]),
};

export const commands = { registerCommand: (name, action) => registered.set(name, action) };

export function useTheme(kind) {
  window.activeColorTheme = { kind };
  for (const listener of listeners) {
    listener();
  }
}
