// Editor and page of a simulation: the target under the cursor is drawn, and lines that the page asks for are opened.
import * as vscode from "vscode";
import { declaredTargets } from "./texts";

const DELAY = 150; // ms after the last movement of the cursor

/** Starts a paused session with a page on a file; resolves when the page is there. */
export type StartWithPage = (file: vscode.Uri) => Promise<vscode.DebugSession | undefined>;

export function registerTargets(context: vscode.ExtensionContext, startWithPage: StartWithPage): void {
  const lenses = new vscode.EventEmitter<void>();
  const refresh = (): void => lenses.fire();
  let timer: NodeJS.Timeout | undefined;
  context.subscriptions.push(
    lenses,
    vscode.debug.onDidStartDebugSession(refresh),
    vscode.debug.onDidTerminateDebugSession(refresh),
    vscode.languages.registerCodeLensProvider({ language: "rapid", scheme: "file" }, {
      onDidChangeCodeLenses: lenses.event,
      // Only a session has a page: without one, the lenses would be in the way of the text.
      provideCodeLenses: (document) =>
        session() && vscode.workspace.getConfiguration("rapidgen", document).get<boolean>("codeLens")
          ? declaredTargets(document.getText().split("\n")).map(({ line }) =>
              new vscode.CodeLens(document.lineAt(line).range, {
                title: "Show target", command: "rapidgen.showTarget", arguments: [document.uri, line + 1],
              }))
          : [],
    }),
    vscode.commands.registerCommand("rapidgen.showTarget", (file?: vscode.Uri, line?: number) => showTarget(startWithPage, file, line)),
    vscode.window.onDidChangeTextEditorSelection(({ textEditor, kind }) => {
      // Otherwise it is VS Code that moves the cursor, as to the line of a pause.
      const { Keyboard, Mouse } = vscode.TextEditorSelectionChangeKind;
      if (kind !== Keyboard && kind !== Mouse) return;
      clearTimeout(timer);
      const own = session();
      if (!own || textEditor.document.languageId !== "rapid" || !vscode.workspace.getConfiguration("rapidgen").get<boolean>("followCursor")) return;
      // A module that the program does not have is no target: nothing to report while the cursor moves.
      timer = setTimeout(() => void ask(own, place(textEditor)).catch(() => undefined), DELAY);
    }),
    vscode.debug.onDidReceiveDebugSessionCustomEvent(async (event) => {
      if (event.session.type !== "rapidgen" || event.event !== "rapidgen/open") return;
      const { source, line } = event.body as { source: { path?: string }; line: number };
      const uri = source.path ? vscode.Uri.file(source.path) : vscode.debug.asDebugSourceUri(source, event.session);
      const at = new vscode.Position(Math.max(0, line - 1), 0);
      await vscode.window.showTextDocument(uri, { selection: new vscode.Range(at, at), viewColumn: vscode.ViewColumn.One });
    }),
  );
}

function session(): vscode.DebugSession | undefined {
  const active = vscode.debug.activeDebugSession;
  return active?.type === "rapidgen" ? active : undefined;
}

interface Shown {
  readonly module: string;
  readonly targets: readonly string[];
  readonly doubt: string;
}

interface Asked {
  readonly source: { readonly path: string };
  readonly line: number;
  readonly name: string;
}

/** Return the place under the cursor, or a line from 1. */
function place(editor: vscode.TextEditor, line?: number): Asked {
  const at = editor.selection.active;
  const word = line === undefined ? editor.document.getWordRangeAtPosition(at) : undefined;
  return {
    source: { path: editor.document.uri.fsPath },
    line: line ?? at.line + 1,
    name: word ? editor.document.getText(word) : "",
  };
}

async function ask(own: vscode.DebugSession, asked: Asked): Promise<Shown> {
  return (await own.customRequest("rapidgen/showTarget", asked)) as Shown;
}

/** Show the target of a line, from 1, or that under the cursor. */
async function showTarget(startWithPage: StartWithPage, file?: vscode.Uri, line?: number): Promise<Shown | undefined> {
  if (file) await vscode.window.showTextDocument(file, { preserveFocus: false });
  const editor = vscode.window.activeTextEditor;
  if (editor?.document.languageId !== "rapid") return undefined;
  // Before the session begins: at its pause, VS Code moves the cursor there.
  const asked = place(editor, line);
  const own = session() ?? (await startWithPage(editor.document.uri));
  if (!own) return undefined;
  try {
    const shown = await ask(own, asked);
    if (shown.doubt) void vscode.window.showWarningMessage(shown.doubt);
    if (!shown.targets.length)
      void vscode.window.showInformationMessage("No move to a known target here: only a move knows the tool and the work object.");
    return shown;
  } catch (error) {
    void vscode.window.showWarningMessage(error instanceof Error ? error.message : String(error));
    return undefined;
  }
}
