"""What Visual Studio Code, Neovim and Emacs say that they can do."""

from typing import Any

LINKS = {"linkSupport": True, "dynamicRegistration": True}
PROFILES: dict[str, Any] = {
    "vscode": {
        "workspace": {
            "applyEdit": True,
            "workspaceEdit": {"documentChanges": True, "changeAnnotationSupport": {"groupsOnLabel": True}},
            "didChangeWatchedFiles": {"dynamicRegistration": True, "relativePatternSupport": True},
            "configuration": True,
            "workspaceFolders": True,
            "diagnostics": {"refreshSupport": True},
            "codeLens": {"refreshSupport": True},
        },
        "textDocument": {
            "completion": {"completionItem": {"snippetSupport": True, "documentationFormat": ["markdown"]}},
            "codeAction": {"resolveSupport": {"properties": ["edit"]}, "dataSupport": True},
            "definition": LINKS,
            "rename": {"prepareSupport": True},
            "semanticTokens": {
                "requests": {"range": True, "full": {"delta": True}},
                "tokenTypes": ["class"],
                "tokenModifiers": ["declaration"],
                "formats": ["relative"],
            },
            "diagnostic": {"dynamicRegistration": True, "relatedDocumentSupport": False},
        },
        "window": {"workDoneProgress": True},
        "general": {"positionEncodings": ["utf-16"]},
    },
    "neovim": {
        "workspace": {"workspaceFolders": True, "applyEdit": True, "symbol": {"dynamicRegistration": False}},
        "textDocument": {
            "completion": {"completionItem": {"snippetSupport": False}},
            "publishDiagnostics": {"relatedInformation": True, "tagSupport": {"valueSet": [1, 2]}},
            "rename": {"prepareSupport": True},
        },
        "window": {"workDoneProgress": True},
    },
    "emacs": {
        "workspace": {"applyEdit": True, "didChangeWatchedFiles": {"dynamicRegistration": True}},
        "textDocument": {
            "completion": {"completionItem": {"snippetSupport": False}, "contextSupport": True},
            "hover": {"contentFormat": ["markdown", "plaintext"]},
            "codeAction": {"resolveSupport": {"properties": ["edit", "command"]}},
        },
        "general": {"positionEncodings": ["utf-32", "utf-8", "utf-16"]},
    },
}
