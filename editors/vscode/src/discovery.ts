// Which program `rapidgen` is started: the setting, the Python environment, PATH; or how to install it.
import * as fs from "fs";
import * as path from "path";
import * as vscode from "vscode";

const NAME = process.platform === "win32" ? "rapidgen.exe" : "rapidgen";

/** The program and where it was found. */
export interface Program {
  readonly path: string;
  readonly origin: string;
}

/** Return the program, or undefined if there is none. */
export async function findProgram(): Promise<Program | undefined> {
  const named = vscode.workspace.getConfiguration("rapidgen").inspect<string>("path");
  // A workspace may not choose the program before the user trusts it.
  const chosen = vscode.workspace.isTrusted
    ? (named?.workspaceFolderValue ?? named?.workspaceValue ?? named?.globalValue)
    : named?.globalValue;
  if (chosen) {
    const place = expand(chosen);
    return isFile(place) ? { path: place, origin: "the setting rapidgen.path" } : undefined;
  }
  if (vscode.workspace.isTrusted) {
    for (const folder of await environments()) {
      const place = path.join(folder, NAME);
      if (isFile(place)) return { path: place, origin: "the Python environment" };
    }
  }
  for (const folder of (process.env["PATH"] ?? "").split(path.delimiter)) {
    // A relative entry would be a folder of the workspace.
    const place = path.join(folder, NAME);
    if (path.isAbsolute(folder) && isFile(place)) return { path: place, origin: "PATH" };
  }
  return undefined;
}

/** Return the program, or say how to install it. */
export async function requireProgram(): Promise<Program | undefined> {
  const program = await findProgram();
  if (program) return program;
  const setting = vscode.workspace.getConfiguration("rapidgen").get<string>("path");
  const message = setting
    ? `There is no program ${setting}: change the setting rapidgen.path.`
    : "The program rapidgen is not installed. Install the Python package: pip install rapidgen";
  const answer = await vscode.window.showErrorMessage(message, "Open settings", "Copy command");
  if (answer === "Open settings")
    await vscode.commands.executeCommand("workbench.action.openSettings", "rapidgen.path");
  if (answer === "Copy command") await vscode.env.clipboard.writeText("pip install rapidgen");
  return undefined;
}

/** Return folders with programs of Python environments: the selected one, then usual ones of the workspace. */
async function environments(): Promise<string[]> {
  const result: string[] = [];
  const python = vscode.extensions.getExtension("ms-python.python");
  if (python) {
    const api = python.isActive ? python.exports : await python.activate();
    const active: unknown = api?.environments?.getActiveEnvironmentPath?.()?.path;
    if (typeof active === "string") result.push(isFile(active) ? path.dirname(active) : programs(active));
  }
  for (const folder of vscode.workspace.workspaceFolders ?? [])
    for (const name of [".venv", "venv"]) result.push(programs(path.join(folder.uri.fsPath, name)));
  if (process.env["VIRTUAL_ENV"]) result.push(programs(process.env["VIRTUAL_ENV"]));
  return result;
}

function programs(environment: string): string {
  return path.join(environment, process.platform === "win32" ? "Scripts" : "bin");
}

function expand(text: string): string {
  const home = process.env["HOME"] ?? process.env["USERPROFILE"] ?? "";
  const folder = vscode.workspace.workspaceFolders?.[0]?.uri.fsPath ?? "";
  return text.replace(/^~(?=[/\\])/, home).replace("${workspaceFolder}", folder);
}

/** Return the file that a command was called for, or else that of the editor. */
export function placeOf(file: vscode.Uri | string | undefined): vscode.Uri | undefined {
  if (typeof file === "string") return vscode.Uri.file(file);
  return file ?? vscode.window.activeTextEditor?.document.uri;
}

function isFile(place: string): boolean {
  try {
    return fs.statSync(place).isFile();
  } catch {
    return false;
  }
}
