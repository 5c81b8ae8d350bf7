// Modules of controllers: read-only documents with the program pointer, comparison with the workspace, and upload.
import * as path from "path";
import * as vscode from "vscode";
import { Passwords, query, QueryFailed } from "./query";
import { loadArguments, placeOf, shown, sourceArguments, type Task, type UploadPlan } from "./texts";

const SCHEME = "rapidgen-controller";
const PLAN = "rapidgen-plan";

interface Source {
  readonly host: string;
  readonly task: string;
  readonly module: string;
}

/** Documents with the texts of modules as the controller has them. */
export class ModuleTexts implements vscode.TextDocumentContentProvider, vscode.Disposable {
  private readonly plans = new Map<string, string>();
  private readonly pointers = new Map<string, readonly Task[]>();
  private readonly mark = vscode.window.createTextEditorDecorationType({
    isWholeLine: true,
    backgroundColor: new vscode.ThemeColor("editor.stackFrameHighlightBackground"),
    overviewRulerColor: new vscode.ThemeColor("editor.stackFrameHighlightBackground"),
  });
  private readonly ends: vscode.Disposable[];

  constructor(private readonly passwords: Passwords) {
    const plans = { provideTextDocumentContent: (uri: vscode.Uri) => this.plans.get(uri.path) ?? "" };
    this.ends = [
      this.mark,
      vscode.workspace.registerTextDocumentContentProvider(SCHEME, this),
      vscode.workspace.registerTextDocumentContentProvider(PLAN, plans),
      vscode.window.onDidChangeVisibleTextEditors(() => this.draw()),
    ];
  }

  dispose(): void {
    for (const end of this.ends) end.dispose();
  }

  async provideTextDocumentContent(uri: vscode.Uri): Promise<string> {
    const { host, task, module } = read(uri);
    try {
      const answer = (await query(this.passwords, host, sourceArguments(host, task, module))) as { source: string };
      return answer.source;
    } catch (error) {
      if (!(error instanceof QueryFailed)) throw error;
      void showFailure(error);
      return `! ${shown(error.failure)}\n! ${error.failure.help}\n`;
    }
  }

  /** Open a module read only, at a line from 1, as the controller has it now. */
  async open(host: string, task: string, module: string, line?: number): Promise<void> {
    const uri = uriOf({ host, task, module });
    const document = await vscode.workspace.openTextDocument(uri);
    const at = line === undefined ? undefined : new vscode.Position(Math.max(0, line - 1), 0);
    await vscode.window.showTextDocument(document, { preview: true, ...(at ? { selection: new vscode.Range(at, at) } : {}) });
    this.draw();
  }

  async compare(host: string, task: string, module: string, file: vscode.Uri): Promise<void> {
    const uri = uriOf({ host, task, module });
    await vscode.commands.executeCommand("vscode.diff", uri, file, `${module}: ${host} ↔ workspace`);
  }

  /** Show a plan beside the editor. */
  async showPlan(plan: UploadPlan): Promise<void> {
    const uri = vscode.Uri.from({ scheme: PLAN, path: `/${(opened += 1)}/plan for ${plan.module}.diff` });
    this.plans.set(uri.path, plan.text);
    const document = await vscode.workspace.openTextDocument(uri);
    await vscode.window.showTextDocument(document, { preview: true, preserveFocus: true });
  }

  /** Mark the program pointers of a controller in its open modules. */
  point(host: string, tasks: readonly Task[]): void {
    this.pointers.set(host, tasks);
    this.draw();
  }

  private draw(): void {
    for (const editor of vscode.window.visibleTextEditors) {
      if (editor.document.uri.scheme !== SCHEME) continue;
      const { host, task, module } = read(editor.document.uri);
      const at = placeOf(this.pointers.get(host)?.find((one) => one.name === task)?.pointer ?? "");
      const is = at && at.module.toLowerCase() === module.toLowerCase() && at.line <= editor.document.lineCount;
      editor.setDecorations(this.mark, is ? [editor.document.lineAt(at.line - 1).range] : []);
    }
  }
}

/** Number of opened documents: VS Code keeps the text of an address, which would be old by the next time. */
let opened = 0;

function uriOf(source: Source): vscode.Uri {
  const host = source.host.replace(/^\w+:\/\//, "").replace(/[/?#]/g, "_");
  const path = `/${(opened += 1)}/${source.task}/${source.module} (${host}).mod`;
  return vscode.Uri.from({ scheme: SCHEME, path, query: JSON.stringify(source) });
}

function read(uri: vscode.Uri): Source {
  return JSON.parse(uri.query) as Source;
}

/** Return the file of the workspace with a module, by its file name; undefined: there is none, or none was chosen. */
export async function workspaceFile(module: string): Promise<vscode.Uri | undefined> {
  const found = await vscode.workspace.findFiles("**/*.{mod,modx,sys,sysx,prg}", "**/{node_modules,.venv,.rapidgen}/**", 5000);
  const own = found.filter((one) => path.parse(one.path).name.toLowerCase() === module.toLowerCase());
  if (own.length < 2) {
    if (!own.length) void vscode.window.showErrorMessage(`No file of the workspace is called ${module}.mod.`);
    return own[0];
  }
  const names = own.map((one) => vscode.workspace.asRelativePath(one)).sort();
  const picked = await vscode.window.showQuickPick(names, { title: `File with the module ${module}` });
  return own.find((one) => vscode.workspace.asRelativePath(one) === picked);
}

/** Load a file into a task: plan, confirmation with the plan, exactly this plan. */
export async function uploadModule(passwords: Passwords, texts: ModuleTexts, host: string, task: string, file: vscode.Uri): Promise<void> {
  const open = vscode.workspace.textDocuments.find((one) => one.uri.toString() === file.toString());
  if (open?.isDirty && !(await open.save())) return;
  try {
    const plan = (await query(passwords, host, loadArguments(host, task, file.fsPath))) as UploadPlan;
    if (plan.action === "keep") {
      void vscode.window.showInformationMessage(`${plan.module} is on ${host} already.`);
      return;
    }
    await texts.showPlan(plan);
    const [obstacle] = plan.obstacles;
    if (obstacle) {
      void vscode.window.showErrorMessage(`${plan.module} cannot be loaded now: ${obstacle}`);
      return;
    }
    const verb = plan.action === "add" ? "Load" : "Replace";
    const answer = await vscode.window.showWarningMessage(
      `${verb} ${plan.module} in ${plan.task} at ${host}?`,
      { modal: true, detail: plan.text.length > 1500 ? `${plan.text.slice(0, 1500)}\n... the whole plan is in the editor` : plan.text },
      verb,
    );
    if (answer !== verb) return;
    await vscode.window.withProgress({ location: vscode.ProgressLocation.Notification, title: `Loading ${plan.module}` }, (progress) =>
      query(passwords, host, loadArguments(host, task, file.fsPath, plan.id), (message) => progress.report({ message })),
    );
    void vscode.window.showInformationMessage(`${plan.module} is loaded into ${plan.task} at ${host}.`);
  } catch (error) {
    if (!(error instanceof QueryFailed)) throw error;
    await showFailure(error);
  }
}

async function showFailure({ failure }: QueryFailed): Promise<void> {
  await vscode.window.showErrorMessage([shown(failure), failure.help].filter(Boolean).join(". "));
}
