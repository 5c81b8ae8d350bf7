// Uses the extension as a user does, by the commands of VS Code, and writes what it sees as JSON into RAPIDGEN_PROBE.
"use strict";
const fs = require("fs");
const vscode = require("vscode");

const report = {};
const events = [];

exports.activate = async () => {
  try {
    await main();
    report.passed = true;
  } catch (error) {
    report.error = String(error && error.stack);
  }
  report.events = events;
  fs.writeFileSync(process.env.RAPIDGEN_PROBE + ".part", JSON.stringify(report));
  fs.renameSync(process.env.RAPIDGEN_PROBE + ".part", process.env.RAPIDGEN_PROBE);
};

async function until(what, look) {
  for (let i = 0; i < 600; i += 1) {
    const found = await look();
    if (found) return found;
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  throw new Error(`never: ${what}`);
}

async function main() {
  const folder = vscode.workspace.workspaceFolders[0].uri;
  const file = vscode.Uri.joinPath(folder, "cell.mod");
  const editor = await vscode.window.showTextDocument(file);
  report.language = editor.document.languageId;
  const other = await vscode.workspace.openTextDocument(vscode.Uri.joinPath(folder, "go.mod"));
  report.goMod = other.languageId;
  if (process.env.RAPIDGEN_PROBE_LSP) await languageServer(editor, file);
  await debugSession(file);
  await targets(vscode.Uri.joinPath(folder, "points.mod"));
}

async function languageServer(editor, file) {
  const found = await until("a finding", () => {
    const all = vscode.languages.getDiagnostics(file);
    return all.length > 0 && all;
  });
  report.findings = found.map((one) => ({ line: one.range.start.line + 1, code: String(one.code?.value ?? one.code), message: one.message }));
  const at = positionOf(editor.document, "work i", 1);
  const places = await vscode.commands.executeCommand("vscode.executeDefinitionProvider", file, at);
  report.definition = places.map((one) => (one.range ?? one.targetRange).start.line + 1);
  const actions = await vscode.commands.executeCommand("vscode.executeCodeActionProvider", file, found[0].range);
  report.fixes = actions.map((one) => one.title);
  const edit = await vscode.commands.executeCommand("vscode.executeDocumentRenameProvider", file, at, "labour");
  report.renamed = edit.entries().flatMap(([, edits]) => edits.map((one) => one.range.start.line + 1)).sort((a, b) => a - b);
  const symbols = await vscode.commands.executeCommand("vscode.executeDocumentSymbolProvider", file);
  report.symbols = symbols.flatMap((one) => [one.name, ...(one.children ?? []).map((child) => child.name)]);
}

function positionOf(document, text, offset) {
  return document.positionAt(document.getText().indexOf(text) + offset);
}

async function debugSession(file) {
  vscode.debug.registerDebugAdapterTrackerFactory("rapidgen", {
    createDebugAdapterTracker: () => ({
      onDidSendMessage: (message) => {
        if (message.type === "event") events.push(message);
      },
    }),
  });
  const line = (number) => new vscode.Location(file, new vscode.Position(number - 1, 0));
  vscode.debug.addBreakpoints([new vscode.SourceBreakpoint(line(13), true, "n = 2")]);
  // As F5 without launch.json.
  await vscode.commands.executeCommand("rapidgen.debug", file);
  await until("a breakpoint", () => events.some((one) => one.event === "stopped"));
  const session = vscode.debug.activeDebugSession;
  const stack = await session.customRequest("stackTrace", { threadId: 1 });
  report.stack = stack.stackFrames.map((one) => one.line);
  const frameId = stack.stackFrames[0].id;
  report.value = (await session.customRequest("evaluate", { expression: "n + 1", frameId, context: "watch" })).result;
  events.length = 0;
  await vscode.commands.executeCommand("workbench.action.debug.stepOver");
  await until("a step", () => events.some((one) => one.event === "stopped"));
  report.afterStep = (await session.customRequest("stackTrace", { threadId: 1 })).stackFrames[0].line;
  events.length = 0;
  await vscode.commands.executeCommand("workbench.action.debug.continue");
  await until("a dialog", () => events.some((one) => one.event === "rapidgen/question"));
  report.questionInConsole = events.some((one) => one.event === "output" && one.body.output.includes(":answer"));
  // The first choice of the quick pick.
  await until("an answer", async () => {
    await vscode.commands.executeCommand("workbench.action.acceptSelectedQuickOpenItem");
    return events.some((one) => one.event === "rapidgen/questionClosed");
  });
  await until("the end", () => events.some((one) => one.event === "exited"));
  report.output = events.filter((one) => one.event === "output" && one.body.category === "stdout").map((one) => one.body.output);
}

// Points of the editor and its page: showTarget starts a paused session with a page.
async function targets(file) {
  const editor = await vscode.window.showTextDocument(file);
  const at = positionOf(editor.document, "p10", 1);
  editor.selection = new vscode.Selection(at, at);
  vscode.debug.removeBreakpoints(vscode.debug.breakpoints);
  vscode.debug.addBreakpoints([new vscode.SourceBreakpoint(new vscode.Location(file, new vscode.Position(7, 0)))]);
  events.length = 0;
  const shown = await vscode.commands.executeCommand("rapidgen.showTarget");
  report.shownTargets = shown?.targets;
  const lenses = await vscode.commands.executeCommand("vscode.executeCodeLensProvider", file, 100);
  report.lenses = lenses.filter((one) => one.command?.title === "Show target").map((one) => one.range.start.line + 1);
  const page = events.find((one) => one.event === "rapidgen/page");
  fs.writeFileSync(process.env.RAPIDGEN_PROBE_PAGE + ".part", page.body.url);
  fs.renameSync(process.env.RAPIDGEN_PROBE_PAGE + ".part", process.env.RAPIDGEN_PROBE_PAGE);
  await until("the pointer of the page in the editor", () => events.some((one) => one.event === "rapidgen/open"));
  await until("its line", () => vscode.window.activeTextEditor?.selection.active.line === 5);
  const active = vscode.window.activeTextEditor;
  report.opened = [active.document.uri.path.split("/").pop(), active.selection.active.line + 1];
  await vscode.debug.stopDebugging();
}
