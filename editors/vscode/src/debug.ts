// Debug sessions: how one starts without launch.json, dialogs of the program, and the page of the simulator.
import * as vscode from "vscode";
import { placeOf, requireProgram } from "./discovery";
import { registerTargets } from "./targets";

interface Question {
  readonly number: number;
  readonly task: string;
  readonly dialog: string;
  readonly text: string;
  readonly choices: readonly string[];
  readonly proposed: string;
}

/** Register everything for debug sessions. */
export function registerDebugger(context: vscode.ExtensionContext, log: vscode.LogOutputChannel): void {
  const questions = new Questions(log);
  const pages = new Pages();
  registerTargets(context, async (file) => {
    const shown = pages.next();
    // Paused before the first statement: the user has not asked for a run.
    const started = await start(file, { view: true, stopOnEntry: true });
    return started ? shown : undefined;
  });
  context.subscriptions.push(
    vscode.debug.registerDebugAdapterDescriptorFactory("rapidgen", {
      async createDebugAdapterDescriptor() {
        const program = await requireProgram();
        if (!program) return undefined;
        log.info(`debug adapter: ${program.path} dap (${program.origin})`);
        return new vscode.DebugAdapterExecutable(program.path, ["dap"]);
      },
    }),
    vscode.debug.registerDebugConfigurationProvider("rapidgen", {
      // F5 without launch.json: the module in the editor.
      resolveDebugConfiguration(_folder, config) {
        if (config.type || config.request || config.name) return config;
        const editor = vscode.window.activeTextEditor;
        if (editor?.document.languageId !== "rapid") return config;
        return moduleConfiguration(editor.document.uri);
      },
      resolveDebugConfigurationWithSubstitutedVariables(folder, config) {
        const cwd = folder?.uri.fsPath ?? vscode.workspace.workspaceFolders?.[0]?.uri.fsPath;
        return config.request === "attach" || config.cwd || !cwd ? config : { ...config, cwd };
      },
    }),
    vscode.debug.registerDebugAdapterTrackerFactory("rapidgen", {
      createDebugAdapterTracker: () => ({
        // The adapter leaves dialogs out of the console for a client that shows them itself.
        onWillReceiveMessage(message: { command?: string; arguments?: Record<string, unknown> }) {
          if (message.command === "initialize" && message.arguments)
            message.arguments["supportsRapidgenQuestions"] = true;
        },
      }),
    }),
    vscode.debug.onDidReceiveDebugSessionCustomEvent((event) => {
      if (event.session.type !== "rapidgen") return;
      if (event.event === "rapidgen/question") void questions.ask(event.session, event.body as Question);
      if (event.event === "rapidgen/questionClosed") questions.close(event.session, (event.body as Question).number);
      if (event.event === "rapidgen/page") void pages.show(event.session, (event.body as { url: string }).url);
    }),
    vscode.debug.onDidTerminateDebugSession((session) => {
      questions.closeAll(session);
      pages.forget(session);
    }),
    // The lenses of the language server give path, task and routine; menus give an address.
    vscode.commands.registerCommand("rapidgen.debug", (file?: vscode.Uri | string, _task?: string, entry?: string) =>
      start(file, entry ? { entry } : {}),
    ),
    vscode.commands.registerCommand("rapidgen.showInPage", (file?: vscode.Uri | string, _task?: string, entry?: string) =>
      start(file, { view: true, ...(entry ? { entry } : {}) }),
    ),
    vscode.commands.registerCommand("rapidgen.openPage", () => pages.open()),
    vscode.commands.registerCommand("rapidgen.runToCursor", async () => {
      const editor = vscode.window.activeTextEditor;
      const session = vscode.debug.activeDebugSession;
      const item = vscode.debug.activeStackItem;
      if (!editor || session?.type !== "rapidgen") return;
      await session.customRequest("rapidgen/runTo", {
        threadId: item?.threadId ?? 1,
        source: { path: editor.document.uri.fsPath },
        line: editor.selection.active.line + 1,
      });
    }),
  );
}

async function start(file: vscode.Uri | string | undefined, options: Record<string, unknown>): Promise<boolean> {
  const place = placeOf(file);
  if (!place) return false;
  const folder = vscode.workspace.getWorkspaceFolder(place);
  return vscode.debug.startDebugging(folder, { ...moduleConfiguration(place), ...options });
}

function moduleConfiguration(place: vscode.Uri): vscode.DebugConfiguration {
  const name = place.path.split("/").pop() ?? "RAPID";
  return { type: "rapidgen", request: "launch", name: `Debug ${name}`, program: place.fsPath };
}

/** Dialogs of the programs, as quick picks and input boxes. */
class Questions {
  private readonly open = new Map<string, vscode.CancellationTokenSource>();

  constructor(private readonly log: vscode.LogOutputChannel) {}

  async ask(session: vscode.DebugSession, question: Question): Promise<void> {
    const source = new vscode.CancellationTokenSource();
    this.open.set(key(session, question.number), source);
    while (!source.token.isCancellationRequested) {
      const value = await this.answer(question, source.token);
      if (value === undefined) break;
      try {
        await session.customRequest("rapidgen/answer", { number: question.number, value });
        break;
      } catch (error) {
        void vscode.window.showWarningMessage(`${question.task}: ${String(error)}`);
      }
    }
    if (!source.token.isCancellationRequested)
      this.log.info(`${question.task}: dialog ${question.number} may be answered by :answer in the debug console`);
  }

  private async answer(question: Question, token: vscode.CancellationToken): Promise<string | undefined> {
    const title = `${question.task}: ${question.dialog}`;
    if (question.choices.length > 0)
      return vscode.window.showQuickPick([...question.choices], { title, placeHolder: question.text, ignoreFocusOut: true }, token);
    return vscode.window.showInputBox({ title, prompt: question.text, value: question.proposed, ignoreFocusOut: true }, token);
  }

  close(session: vscode.DebugSession, number: number): void {
    this.open.get(key(session, number))?.cancel();
    this.open.delete(key(session, number));
  }

  closeAll(session: vscode.DebugSession): void {
    for (const [name, source] of this.open)
      if (name.startsWith(`${session.id} `)) {
        source.cancel();
        this.open.delete(name);
      }
  }
}

function key(session: vscode.DebugSession, number: number): string {
  return `${session.id} ${number}`;
}

/** Pages of simulators, in the browser. */
class Pages {
  private readonly addresses = new Map<string, string>();
  private readonly waiting: ((session: vscode.DebugSession | undefined) => void)[] = [];

  /** Resolves to the session of the next page; undefined: none within 30 s. */
  next(): Promise<vscode.DebugSession | undefined> {
    return new Promise((resolve) => {
      this.waiting.push(resolve);
      setTimeout(() => resolve(undefined), 30_000);
    });
  }

  async show(session: vscode.DebugSession, address: string): Promise<void> {
    this.addresses.set(session.id, address);
    for (const resolve of this.waiting.splice(0)) resolve(session);
    await display(address);
  }

  forget(session: vscode.DebugSession): void {
    this.addresses.delete(session.id);
  }

  async open(): Promise<void> {
    const known = [...this.addresses.values()].pop();
    const address =
      known ??
      (await vscode.window.showInputBox({
        title: "Page of a simulator",
        prompt: "Address from the line `ready` of `rapidgen sim --view`",
        validateInput: (text) => (/^http:\/\/(127\.0\.0\.1|localhost):\d+\//.test(text) ? undefined : "http://127.0.0.1:PORT/..."),
      }));
    if (address) await display(address);
  }
}

async function display(address: string): Promise<void> {
  // The page forbids frames of other pages, such as VS Code's simple browser: a page around it could click in it.
  await vscode.env.openExternal(vscode.Uri.parse(address));
}
