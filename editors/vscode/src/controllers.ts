// The view of controllers over Robot Web Services. It connects only when the user expands a controller, asks again while
// the view is visible, and ends at the first failure, with its reason and fix.
import * as vscode from "vscode";
import { ModuleTexts, uploadModule, workspaceFile } from "./modules";
import { follow, Passwords } from "./query";
import { datumText, fingerprintIn, moduleText, placeOf, remedyOf, shown, stateText, statusArguments, taskText, trustCommand, valueArguments, type Datum, type Failure, type State, type Task } from "./texts";

const STATE_EVERY = 2; // s
const VALUES_EVERY = 1; // s

export class ControllerNode {
  readonly kind = "controller";
  state: State | undefined;
  failure: Failure | undefined;
  isConnected = false;
  constructor(readonly host: string) {}
}

class TaskNode {
  readonly kind = "task";
  constructor(readonly controller: ControllerNode, readonly name: string) {}
  get task(): Task | undefined {
    return this.controller.state?.tasks.find((one) => one.name === this.name);
  }
}

export class ModuleNode {
  readonly kind = "module";
  data: readonly Datum[] | undefined;
  failure: Failure | undefined;
  constructor(readonly task: TaskNode, readonly name: string, readonly system: boolean) {}
  get host(): string {
    return this.task.controller.host;
  }
}

interface DatumNode {
  readonly kind: "datum";
  readonly module: ModuleNode;
  readonly name: string;
}

interface NoteNode {
  readonly kind: "note";
  readonly text: string;
  readonly tooltip?: string;
  readonly icon?: string;
  readonly command?: vscode.Command;
}

type Node = ControllerNode | TaskNode | ModuleNode | DatumNode | NoteNode;

export function registerControllers(context: vscode.ExtensionContext): void {
  const passwords = new Passwords(context.secrets);
  const texts = new ModuleTexts(passwords);
  const view = new Controllers(passwords, texts);
  context.subscriptions.push(
    view,
    texts,
    vscode.commands.registerCommand("rapidgen.connectController", (node?: ControllerNode) => node && view.connect(node)),
    vscode.commands.registerCommand("rapidgen.disconnectController", (node?: ControllerNode) => node && view.disconnect(node)),
    vscode.commands.registerCommand("rapidgen.setPassword", async (node?: ControllerNode) => {
      if (node && (await passwords.ask(node.host))) view.connect(node);
    }),
    vscode.commands.registerCommand("rapidgen.forgetPassword", async (node?: ControllerNode) => {
      if (!node) return;
      await passwords.forget(node.host);
      view.disconnect(node);
    }),
    vscode.commands.registerCommand("rapidgen.openModule", (node?: ModuleNode) => node && texts.open(node.host, node.task.name, node.name)),
    vscode.commands.registerCommand("rapidgen.compareModule", async (node?: ModuleNode) => {
      const file = node && (await workspaceFile(node.name));
      if (node && file) await texts.compare(node.host, node.task.name, node.name, file);
    }),
    vscode.commands.registerCommand("rapidgen.uploadModule", async (node?: ModuleNode) => {
      const file = node && (await workspaceFile(node.name));
      if (node && file) await uploadModule(passwords, texts, node.host, node.task.name, file);
    }),
    vscode.commands.registerCommand("rapidgen.showPointer", async (node?: TaskNode) => {
      const at = placeOf(node?.task?.pointer ?? "");
      if (node && at) await texts.open(node.controller.host, node.name, at.module, at.line);
      else if (node) void vscode.window.showInformationMessage(`${node.name} has no program pointer.`);
    }),
  );
}

class Controllers implements vscode.TreeDataProvider<Node>, vscode.Disposable {
  private readonly changed = new vscode.EventEmitter<Node | undefined>();
  readonly onDidChangeTreeData = this.changed.event;
  private readonly tree: vscode.TreeView<Node>;
  private readonly ends: vscode.Disposable[];
  private controllers: ControllerNode[] = [];
  private readonly tasks = new Map<string, TaskNode>();
  private readonly modules = new Map<string, ModuleNode>();
  /** Running commands: of a controller, or of an expanded module. */
  private readonly running = new Map<ControllerNode | ModuleNode, Promise<vscode.Disposable>>();
  /** Modules whose data are shown. */
  private readonly expanded = new Set<ModuleNode>();

  constructor(private readonly passwords: Passwords, private readonly texts: ModuleTexts) {
    this.tree = vscode.window.createTreeView<Node>("rapidgen.controllers", { treeDataProvider: this });
    this.configure();
    this.ends = [
      this.tree,
      this.changed,
      this.tree.onDidExpandElement(({ element }) => {
        if (element.kind === "controller" && !element.isConnected) this.connect(element);
        if (element.kind === "module") {
          this.expanded.add(element);
          element.failure = undefined;
          this.watch(element);
        }
      }),
      this.tree.onDidCollapseElement(({ element }) => {
        if (element.kind === "controller") this.disconnect(element);
        if (element.kind === "module") {
          this.expanded.delete(element);
          this.end(element);
        }
      }),
      this.tree.onDidChangeVisibility(({ visible }) => {
        if (!visible) return [...this.running.keys()].forEach((node) => this.end(node));
        for (const node of this.controllers) if (node.isConnected) this.poll(node);
        for (const node of this.expanded) if (!node.failure) this.watch(node);
      }),
      vscode.workspace.onDidChangeConfiguration((event) => {
        if (event.affectsConfiguration("rapidgen.controllers")) this.configure();
      }),
    ];
  }

  dispose(): void {
    for (const node of [...this.running.keys()]) this.end(node);
    for (const end of this.ends) end.dispose();
  }

  private configure(): void {
    const hosts = vscode.workspace.getConfiguration("rapidgen").get<unknown[]>("controllers") ?? [];
    const names = [...new Set(hosts.filter((one): one is string => typeof one === "string" && one !== ""))];
    for (const node of this.controllers) if (!names.includes(node.host)) this.disconnect(node);
    this.controllers = names.map((host) => this.controllers.find((node) => node.host === host) ?? new ControllerNode(host));
    this.changed.fire(undefined);
  }

  // -- connections ---------------------------------------------------------------------------------

  connect(node: ControllerNode): void {
    this.end(node);
    node.failure = undefined;
    node.state = undefined;
    node.isConnected = true;
    this.changed.fire(node);
    this.poll(node);
  }

  disconnect(node: ControllerNode, failure?: Failure): void {
    node.isConnected = false;
    node.state = undefined;
    node.failure = failure;
    this.end(node);
    for (const module of [...this.expanded])
      if (module.task.controller === node) {
        this.expanded.delete(module);
        this.end(module);
      }
    this.texts.point(node.host, []);
    this.changed.fire(node);
  }

  private poll(node: ControllerNode): void {
    if (this.running.has(node)) return;
    const take = (answer: unknown): void => {
      if (!node.isConnected) return;
      node.state = answer as State;
      this.texts.point(node.host, node.state.tasks);
      this.changed.fire(node);
    };
    this.running.set(node, follow(this.passwords, node.host, statusArguments(node.host, STATE_EVERY), take, (why) => {
      this.running.delete(node);
      this.disconnect(node, why);
    }));
  }

  private watch(node: ModuleNode): void {
    if (this.running.has(node)) return;
    const take = (answer: unknown): void => {
      node.data = answer as Datum[];
      this.changed.fire(node);
    };
    const words = valueArguments(node.host, node.task.name, node.name, VALUES_EVERY);
    this.running.set(node, follow(this.passwords, node.host, words, take, (why) => {
      this.running.delete(node);
      node.failure = why;
      this.changed.fire(node);
    }));
  }

  private end(node: ControllerNode | ModuleNode): void {
    void this.running.get(node)?.then((command) => command.dispose());
    this.running.delete(node);
  }

  // -- tree ----------------------------------------------------------------------------------------

  getChildren(node?: Node): Node[] {
    if (!node) return this.controllers;
    if (node.kind === "controller") return this.ofController(node);
    if (node.kind === "task") return (node.task?.modules ?? []).map((one) => this.module(node, one.name, one.system));
    if (node.kind !== "module") return [];
    // A module without persistents is refused as a wrong use of the command.
    if (node.failure) return [{ kind: "note", text: node.failure.code === "RG901" ? "no persistents" : shown(node.failure), tooltip: node.failure.help }];
    if (!node.data) return [{ kind: "note", text: "reading ..." }];
    return node.data.map((one) => ({ kind: "datum", module: node, name: one.name }));
  }

  private ofController(node: ControllerNode): Node[] {
    const connect = (title: string): vscode.Command => ({ command: "rapidgen.connectController", title, arguments: [node] });
    if (node.failure) return [...this.advice(node, node.failure), { kind: "note", text: "Connect again", icon: "refresh", command: connect("Connect again") }];
    if (!node.isConnected) return [{ kind: "note", text: "Not connected: connect", icon: "plug", command: connect("Connect") }];
    if (!node.state) return [{ kind: "note", text: "connecting ..." }];
    const notes = node.state.fixes.map((text): NoteNode => ({ kind: "note", text, tooltip: text, icon: "warning" }));
    return [...node.state.tasks.map((one) => this.task(node, one.name)), ...notes];
  }

  private advice(node: ControllerNode, failure: Failure): NoteNode[] {
    const all: NoteNode[] = [{ kind: "note", text: shown(failure), tooltip: [shown(failure), failure.help, ...failure.notes].filter(Boolean).join("\n"), icon: "error" }];
    if (failure.help) all.push({ kind: "note", text: failure.help, tooltip: failure.help, icon: "info" });
    const remedy = remedyOf(failure);
    if (remedy === "password")
      all.push({ kind: "note", text: "Enter the password", icon: "key", command: { command: "rapidgen.setPassword", title: "", arguments: [node] } });
    if (remedy === "certificate") {
      // Trust is given in a terminal, after a comparison with the controller's own fingerprint.
      const command = trustCommand(node.host, fingerprintIn(failure));
      all.push({ kind: "note", text: `If it is that of the controller, run: ${command}`, tooltip: command, icon: "terminal" });
    }
    return all;
  }

  private task(controller: ControllerNode, name: string): TaskNode {
    const key = JSON.stringify([controller.host, name]);
    const known = this.tasks.get(key) ?? new TaskNode(controller, name);
    this.tasks.set(key, known);
    return known;
  }

  private module(task: TaskNode, name: string, system: boolean): ModuleNode {
    const key = JSON.stringify([task.controller.host, task.name, name]);
    const known = this.modules.get(key) ?? new ModuleNode(task, name, system);
    this.modules.set(key, known);
    return known;
  }

  getTreeItem(node: Node): vscode.TreeItem {
    const { None, Collapsed } = vscode.TreeItemCollapsibleState;
    if (node.kind === "controller") {
      const item = new vscode.TreeItem(node.host, Collapsed);
      item.description = node.state ? stateText(node.state) : node.failure ? "failed" : "";
      item.tooltip = node.state ? `${node.state.name}, RobotWare ${node.state.robotware}` : node.host;
      item.iconPath = new vscode.ThemeIcon(node.state ? "vm-active" : "vm-outline");
      item.contextValue = node.isConnected ? "controller.connected" : "controller";
      return item;
    }
    if (node.kind === "task") {
      const item = new vscode.TreeItem(node.name, Collapsed);
      item.description = node.task ? taskText(node.task) : "";
      item.contextValue = "task";
      item.iconPath = new vscode.ThemeIcon("list-tree");
      return item;
    }
    if (node.kind === "module") {
      const item = new vscode.TreeItem(node.name, Collapsed);
      item.description = node.task.task ? moduleText(node.task.task, node) : "";
      item.contextValue = "module";
      item.iconPath = new vscode.ThemeIcon("file-code");
      return item;
    }
    if (node.kind === "datum") {
      const datum = node.module.data?.find((one) => one.name === node.name);
      const item = new vscode.TreeItem(node.name, None);
      item.description = datum ? datumText(datum) : "";
      item.tooltip = datum ? `${datum.path} := ${datum.value ?? "?"}` : "";
      item.iconPath = new vscode.ThemeIcon("symbol-variable");
      return item;
    }
    const item = new vscode.TreeItem(node.text, None);
    item.tooltip = node.tooltip;
    item.command = node.command;
    if (node.icon) item.iconPath = new vscode.ThemeIcon(node.icon);
    return item;
  }
}
