"""Capabilities of the server, and what it asks the client to watch."""

from typing import Final

from rapidgen._json import Json, Members
from rapidgen.editor.tokens import TOKEN_MODIFIERS, TOKEN_TYPES
from rapidgen.lsp.conversion import Client

WATCHED: Final = (
    "**/*.{mod,modx,sys,sysx,prg,pgf,MOD,MODX,SYS,SYSX,PRG,PGF}",
    "**/SYSPAR/*.cfg",
    "**/{rapidgen.toml,manifest.json}",
    "**/*.{yaml,yml}",
)
"""Files whose changes the server wants to know."""


def of_server(client: Client) -> Members:
    """Return the capabilities for a client."""
    return {
        "positionEncoding": client.units,
        "textDocumentSync": {
            "openClose": True,
            "change": 2,
            "save": {"includeText": False},
        },
        "diagnosticProvider": {
            "identifier": "rapidgen",
            "interFileDependencies": True,
            "workspaceDiagnostics": False,
        },
        "completionProvider": {
            "triggerCharacters": ["\\", ".", "%"],
            "resolveProvider": True,
        },
        "signatureHelpProvider": {
            "triggerCharacters": [" ", "(", ",", "\\"],
            "retriggerCharacters": [",", "\\", ":"],
        },
        "hoverProvider": True,
        "definitionProvider": True,
        "typeDefinitionProvider": True,
        "implementationProvider": True,
        "referencesProvider": True,
        "documentHighlightProvider": True,
        "documentSymbolProvider": True,
        "workspaceSymbolProvider": True,
        "codeActionProvider": {"codeActionKinds": ["quickfix", "source.fixAll"]},
        "codeLensProvider": {"resolveProvider": False},
        "documentLinkProvider": {"resolveProvider": False},
        "documentFormattingProvider": True,
        "documentRangeFormattingProvider": True,
        "documentOnTypeFormattingProvider": {
            "firstTriggerCharacter": "\n",
            "moreTriggerCharacter": [";"],
        },
        "renameProvider": {"prepareProvider": True},
        "foldingRangeProvider": True,
        "selectionRangeProvider": True,
        "callHierarchyProvider": True,
        "semanticTokensProvider": {
            "legend": {
                "tokenTypes": list[Json](TOKEN_TYPES),
                "tokenModifiers": list[Json](TOKEN_MODIFIERS),
            },
            "full": {"delta": True},
            "range": True,
        },
        "inlayHintProvider": {"resolveProvider": False},
        "workspace": {
            "workspaceFolders": {"supported": True, "changeNotifications": True},
        },
    }


def watchers() -> Members:
    """Return the registration of watched files."""
    return {
        "registrations": [
            {
                "id": "rapidgen-files",
                "method": "workspace/didChangeWatchedFiles",
                "registerOptions": {"watchers": [{"globPattern": glob} for glob in WATCHED]},
            }
        ]
    }
