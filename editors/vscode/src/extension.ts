// The extension: starts `rapidgen lsp` and `rapidgen dap`, and offers commands and tasks of rapidgen.
import * as vscode from "vscode";
import { LanguageClient, State } from "vscode-languageclient/node";
import { registerControllers } from "./controllers";
import { registerDebugger } from "./debug";
import { findProgram, requireProgram } from "./discovery";
import { registerTasks } from "./tasks";

let client: LanguageClient | undefined;

/** Called by VS Code when a RAPID file is opened, or a session or task begins. */
export async function activate(context: vscode.ExtensionContext): Promise<void> {
  const log = vscode.window.createOutputChannel("RAPID", { log: true });
  const server = new Server(log);
  context.subscriptions.push(
    log,
    vscode.commands.registerCommand("rapidgen.showLog", () => log.show()),
    vscode.commands.registerCommand("rapidgen.restartServer", () => server.restart(true)),
    vscode.workspace.onDidChangeConfiguration(async (event) => {
      if (event.affectsConfiguration("rapidgen.path") || event.affectsConfiguration("rapidgen.languageServer"))
        await server.restart(false);
    }),
    vscode.workspace.onDidGrantWorkspaceTrust(() => server.restart(false)),
  );
  registerDebugger(context, log);
  registerTasks(context);
  registerControllers(context);
  await server.restart(false);
}

/** Called by VS Code at the end. */
export async function deactivate(): Promise<void> {
  await client?.stop();
}

/** The language server; one at a time. */
class Server {
  private queue: Promise<void> = Promise.resolve();

  constructor(private readonly log: vscode.LogOutputChannel) {}

  /** Stop the server and start it again; `asked`: say so if it is not installed. */
  restart(asked: boolean): Promise<void> {
    this.queue = this.queue.then(() => this.start(asked)).catch((error) => this.log.error(String(error)));
    return this.queue;
  }

  private async start(asked: boolean): Promise<void> {
    const old = client;
    client = undefined;
    if (old && old.state !== State.Stopped) await old.stop();
    await old?.dispose();
    if (!vscode.workspace.getConfiguration("rapidgen").get<boolean>("languageServer")) return;
    const rapidIsOpen = vscode.workspace.textDocuments.some((one) => one.languageId === "rapid");
    const program = asked || rapidIsOpen ? await requireProgram() : await findProgram();
    if (!program) {
      this.log.warn("rapidgen was not found: pip install rapidgen");
      return;
    }
    this.log.info(`language server: ${program.path} lsp (${program.origin})`);
    client = new LanguageClient(
      "rapidgen",
      "RAPID",
      { command: program.path, args: ["lsp"] },
      {
        documentSelector: [
          { scheme: "file", language: "rapid" },
          { scheme: "untitled", language: "rapid" },
          { scheme: "file", pattern: "**/SYSPAR/*.cfg" },
          { scheme: "file", pattern: "**/*.pgf" },
          { scheme: "file", language: "yaml" },
          { scheme: "file", pattern: "**/rapidgen.toml" },
        ],
        outputChannel: this.log,
        initializationOptions: { ...vscode.workspace.getConfiguration("rapidgen") },
        synchronize: { configurationSection: "rapidgen" },
      },
    );
    await client.start();
  }
}
