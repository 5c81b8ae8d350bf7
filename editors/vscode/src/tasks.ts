// Commands of rapidgen as tasks in a terminal, with the problem matcher of `check --format concise`.
import * as vscode from "vscode";
import { placeOf, requireProgram } from "./discovery";

interface Definition extends vscode.TaskDefinition {
  readonly command: string;
  readonly args?: readonly string[];
}

/** Register the task type and the commands that run one. */
export function registerTasks(context: vscode.ExtensionContext): void {
  context.subscriptions.push(
    vscode.tasks.registerTaskProvider("rapidgen", {
      async provideTasks() {
        const task = await made({ type: "rapidgen", command: "check", args: ["."] }, "check the folder");
        return task ? [task] : [];
      },
      resolveTask: (task) => made(task.definition as Definition, task.name),
    }),
    vscode.commands.registerCommand("rapidgen.check", async (file?: vscode.Uri) => {
      const place = placeOf(file);
      if (place) await execute("check", [place.fsPath]);
    }),
    vscode.commands.registerCommand("rapidgen.run", async (file?: vscode.Uri | string, _task?: string, entry?: string) => {
      const place = placeOf(file);
      await vscode.window.activeTextEditor?.document.save();
      if (place) await execute("run", [place.fsPath, ...(entry ? ["--entry", entry] : [])]);
    }),
    vscode.commands.registerCommand("rapidgen.build", async (file?: vscode.Uri) => {
      const place = await configuration(file);
      if (place) await execute("build", [place, ...backup()]);
    }),
    vscode.commands.registerCommand("rapidgen.test", async (file?: vscode.Uri) => {
      const place = await configuration(file);
      if (place) await execute("test", [place, ...backup()]);
    }),
    vscode.commands.registerCommand("rapidgen.plan", async (file?: vscode.Uri) => {
      const place = await configuration(file);
      const known = vscode.workspace.getConfiguration("rapidgen").get<string>("controller");
      const address = place && (await vscode.window.showInputBox({ title: "Address of the controller", value: known || "rwss://" }));
      // A plan only reads; the password is asked for in the terminal.
      if (place && address) await execute("plan", [place, "--to", address, "--diff", ...backup()]);
    }),
    vscode.commands.registerCommand("rapidgen.newConfiguration", newConfiguration),
  );
}

async function newConfiguration(): Promise<void> {
  const folder = vscode.workspace.workspaceFolders?.[0]?.uri;
  if (!folder) {
    void vscode.window.showErrorMessage("Open a folder first: the configuration is written there.");
    return;
  }
  const name = await vscode.window.showInputBox({ title: "File of the configuration", value: "cell.yaml" });
  const robot = name && (await vscode.window.showInputBox({ title: "Robot model, such as irb120" }));
  if (!name || !robot) return;
  const file = vscode.Uri.joinPath(folder, name);
  if ((await execute("new", [file.fsPath, "--robot", robot])) === 0) await vscode.window.showTextDocument(file);
}

async function configuration(file?: vscode.Uri): Promise<string | undefined> {
  const open = file ?? vscode.window.activeTextEditor?.document.uri;
  if (open && /\.ya?ml$/i.test(open.path)) return open.fsPath;
  const found = await vscode.workspace.findFiles("**/*.{yaml,yml}", "**/{node_modules,rapid_out,.venv}/**", 200);
  const names = found.map((one) => vscode.workspace.asRelativePath(one)).sort();
  const picked = await vscode.window.showQuickPick(names, { title: "Configuration" });
  return found.find((one) => vscode.workspace.asRelativePath(one) === picked)?.fsPath;
}

function backup(): string[] {
  const folder = vscode.workspace.getConfiguration("rapidgen").get<string>("backup");
  return folder ? ["--backup", folder] : [];
}

/** Run a command in a terminal and return its exit code. */
async function execute(command: string, args: string[]): Promise<number | undefined> {
  const task = await made({ type: "rapidgen", command, args }, command);
  if (!task) return undefined;
  const execution = await vscode.tasks.executeTask(task);
  return new Promise((resolve) => {
    const end = vscode.tasks.onDidEndTaskProcess((event) => {
      if (event.execution !== execution) return;
      end.dispose();
      resolve(event.exitCode);
    });
  });
}

async function made(definition: Definition, name: string): Promise<vscode.Task | undefined> {
  const program = await requireProgram();
  if (!program) return undefined;
  const format = definition.command === "check" ? ["--format", "concise"] : [];
  // Without a shell: a file's name cannot contain commands.
  const execution = new vscode.ProcessExecution(program.path, [definition.command, ...format, ...(definition.args ?? [])]);
  const task = new vscode.Task(definition, vscode.TaskScope.Workspace, name, "rapidgen", execution, "$rapidgen");
  task.presentationOptions = { clear: true, reveal: vscode.TaskRevealKind.Always };
  return task;
}
