// Texts of the controller view and of targets, without VS Code: results of `rapidgen ... --json` as labels and advice.

/** A task in the answer of `rapidgen status --json --modules`. */
export interface Task {
  readonly name: string;
  readonly type: string;
  readonly execution: string;
  readonly selected: boolean;
  /** MODULE/ROUTINE:LINE, or empty. */
  readonly pointer: string;
  readonly modules: readonly { readonly name: string; readonly system: boolean }[];
}

export interface State {
  readonly name: string;
  readonly robotware: string;
  readonly state: string;
  readonly mode: string;
  readonly speed: number;
  readonly running: boolean;
  readonly tasks: readonly Task[];
  readonly fixes: readonly string[];
}

/** A datum in the answer of `rapidgen symbols --json --values`. */
export interface Datum {
  readonly path: string;
  readonly name: string;
  readonly type: string;
  readonly dims: readonly number[];
  readonly value: string | null;
}

/** The answer of `rapidgen load --plan --json`. */
export interface UploadPlan {
  readonly id: string;
  readonly task: string;
  readonly module: string;
  readonly action: "add" | "replace" | "keep";
  readonly obstacles: readonly string[];
  readonly text: string;
}

/** Why a command failed: the first diagnostic of its answer. */
export interface Failure {
  readonly code: string;
  readonly message: string;
  readonly help: string;
  readonly notes: readonly string[];
}

export interface Place {
  readonly module: string;
  readonly routine: string;
  readonly line: number;
}

/** Return the failure that a line of the answer reports, if it does. */
export function failureIn(answer: unknown): Failure | undefined {
  const errors = typeof answer === "object" && answer !== null ? (answer as { errors?: unknown }).errors : undefined;
  if (!Array.isArray(errors)) return undefined;
  const first = (errors[0] ?? {}) as Record<string, unknown>;
  const text = (key: string): string => (typeof first[key] === "string" ? (first[key] as string) : "");
  const notes = Array.isArray(first["notes"]) ? first["notes"].filter((one) => typeof one === "string") : [];
  return { code: text("code"), message: text("message") || "no reason given", help: text("help"), notes };
}

/** Return the failure of a program that has ended without an answer. */
export function failureOf(code: number | null, stderr: string): Failure {
  const last = stderr.trim().split("\n").pop() ?? "";
  return { code: "", message: last || `rapidgen has ended with exit code ${code ?? "?"}`, help: "", notes: [] };
}

/** Return a failure in one line. */
export function shown(failure: Failure): string {
  return failure.code ? `${failure.code}: ${failure.message}` : failure.message;
}

/** Return what the user can do here about a failure, besides its help. */
export function remedyOf(failure: Failure): "password" | "certificate" | undefined {
  if (failure.code === "RG512" || failure.code === "RG651") return "password";
  return failure.code === "RG652" && fingerprintIn(failure) ? "certificate" : undefined;
}

/** Return the fingerprint that the controller has shown. */
export function fingerprintIn(failure: Failure): string {
  const there = failure.notes.find((note) => note.startsWith("there: ")) ?? "";
  const text = there.slice("there: ".length).trim();
  return /^[0-9A-Fa-f: ]+$/.test(text) ? text.replace(/ /g, "") : "";
}

/** Return the command that trusts a certificate, after a comparison with the controller's. */
export function trustCommand(host: string, fingerprint: string): string {
  return `rapidgen status --fingerprint ${fingerprint} -- ${quoted(host)}`;
}

function quoted(text: string): string {
  return /^[\w@:/.[\]-]+$/.test(text) ? text : `'${text.replace(/'/g, "'\\''")}'`;
}

/** Return the state of a controller in one line. */
export function stateText(state: State): string {
  return `${state.mode}, ${state.state}, ${state.speed} %, ${state.running ? "running" : "stopped"}`;
}

/** Return the state of a task, with its program pointer. */
export function taskText(task: Task): string {
  return [task.execution, task.selected ? "" : "not selected", task.pointer].filter(Boolean).join(", ");
}

/** Read MODULE/ROUTINE:LINE. */
export function placeOf(pointer: string): Place | undefined {
  const found = /^([^/]+)\/([^:]*):(\d+)$/.exec(pointer);
  return found ? { module: found[1] as string, routine: found[2] as string, line: Number(found[3]) } : undefined;
}

/** Return a mark of a module: its pointer, or its kind. */
export function moduleText(task: Task, module: { readonly name: string; readonly system: boolean }): string {
  const at = placeOf(task.pointer);
  if (at && at.module.toLowerCase() === module.name.toLowerCase()) return `▶ ${at.routine}:${at.line}`;
  return module.system ? "system module" : "";
}

/** Return type and value of a datum. */
export function datumText(datum: Datum): string {
  const dims = datum.dims.length ? `{${datum.dims.join(",")}}` : "";
  return `${datum.value ?? "no value given"}  ${datum.type}${dims}`;
}

/** Cut whole lines from a stream of JSON lines; a line that is not JSON is left out. */
export class JsonLines {
  private rest = "";

  take(piece: string): unknown[] {
    const lines = (this.rest + piece).split("\n");
    this.rest = lines.pop() ?? "";
    return lines.flatMap((line) => {
      try {
        return [JSON.parse(line) as unknown];
      } catch {
        return [];
      }
    });
  }
}

/** Return the arguments that show a controller, module data or a source; hosts come after `--`. */
export function statusArguments(host: string, seconds: number): string[] {
  return ["status", "--json", "--modules", "--every", String(seconds), "--", host];
}

export function valueArguments(host: string, task: string, module: string, seconds: number): string[] {
  return ["symbols", "--json", "--values", "--every", String(seconds), "--", host, `${task}/${module}`];
}

export function sourceArguments(host: string, task: string, module: string): string[] {
  return ["symbols", "--json", "--source", "--", host, `${task}/${module}`];
}

/** Return the arguments that plan an upload, or apply the plan with an id. */
export function loadArguments(host: string, task: string, file: string, id?: string): string[] {
  const how = id === undefined ? ["--plan"] : [`--expect=${id}`, "--yes"];
  return ["load", "--json", ...how, `--to=${host}`, `--task=${task}`, "--", file];
}

const TARGET = /^\s*(?:LOCAL\s+|TASK\s+)?(?:CONST|PERS|VAR)\s+(?:robtarget|jointtarget)\s+(\w+)/i;
const MOST = 500;

/** Return lines, from 0, and names of the targets that a module declares, the first 500. */
export function declaredTargets(lines: readonly string[]): { line: number; name: string }[] {
  const found: { line: number; name: string }[] = [];
  for (let line = 0; line < lines.length && found.length < MOST; line += 1) {
    const name = TARGET.exec(lines[line] ?? "")?.[1];
    if (name) found.push({ line, name });
  }
  return found;
}
