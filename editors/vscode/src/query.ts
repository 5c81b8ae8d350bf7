// Commands of rapidgen that talk to a controller: one answer, or one answer again and again until it is ended.
import { spawn, type ChildProcess } from "child_process";
import * as vscode from "vscode";
import { findProgram } from "./discovery";
import { failureIn, failureOf, JsonLines, type Failure } from "./texts";

/** A command that has failed, with the reason and the fix. */
export class QueryFailed extends Error {
  constructor(readonly failure: Failure) {
    super(failure.message);
  }
}

const INSTALL: Failure = { code: "", message: "The program rapidgen is not installed.", help: "pip install 'rapidgen[web]'", notes: [] };

/** Passwords of controllers, in the secret storage of VS Code; without one, RAPIDGEN_PASSWORD of the environment counts. */
export class Passwords {
  constructor(private readonly secrets: vscode.SecretStorage) {}

  async environment(host: string): Promise<NodeJS.ProcessEnv> {
    const password = await this.secrets.get(key(host));
    return password === undefined ? process.env : { ...process.env, RAPIDGEN_PASSWORD: password };
  }

  /** Ask once; false: the user has not given one. */
  async ask(host: string): Promise<boolean> {
    const password = await vscode.window.showInputBox({
      title: `Password of ${host}`,
      prompt: "It is stored in the secret storage of VS Code.",
      password: true,
      ignoreFocusOut: true,
    });
    if (password === undefined) return false;
    await this.secrets.store(key(host), password);
    return true;
  }

  async forget(host: string): Promise<void> {
    await this.secrets.delete(key(host));
  }
}

function key(host: string): string {
  return `rapidgen.password:${host}`;
}

/** Start a command; `take` receives its answers, `ended` why it has ended without a wish for it. */
export async function follow(
  passwords: Passwords,
  host: string,
  words: readonly string[],
  take: (answer: unknown) => void,
  ended: (failure: Failure) => void,
): Promise<vscode.Disposable> {
  const program = await findProgram();
  if (!program) {
    ended(INSTALL);
    return { dispose: () => undefined };
  }
  const child = start(program.path, words, await passwords.environment(host));
  const lines = new JsonLines();
  let failure: Failure | undefined;
  let stderr = "";
  let wished = false;
  child.stdout?.setEncoding("utf8").on("data", (piece: string) => {
    for (const answer of lines.take(piece)) {
      failure = failureIn(answer);
      if (!failure && !wished) take(answer);
    }
  });
  child.stderr?.setEncoding("utf8").on("data", (piece: string) => (stderr = (stderr + piece).slice(-2000)));
  child.on("error", (error) => !wished && ended(failureOf(null, String(error))));
  child.on("close", (code) => !wished && ended(failure ?? failureOf(code, stderr)));
  return {
    dispose: () => {
      wished = true;
      // The command logs out: a controller has few sessions.
      child.kill("SIGINT");
    },
  };
}

/** Run a command and return its answer; `say` receives its lines for the user. Throws QueryFailed. */
export async function query(
  passwords: Passwords,
  host: string,
  words: readonly string[],
  say: (line: string) => void = () => undefined,
): Promise<unknown> {
  const program = await findProgram();
  if (!program) throw new QueryFailed(INSTALL);
  const child = start(program.path, words, await passwords.environment(host));
  let stdout = "";
  let stderr = "";
  child.stdout?.setEncoding("utf8").on("data", (piece: string) => (stdout += piece));
  child.stderr?.setEncoding("utf8").on("data", (piece: string) => {
    stderr = (stderr + piece).slice(-2000);
    for (const line of piece.split("\n").filter(Boolean)) say(line);
  });
  const code = await new Promise<number | null>((resolve, reject) => {
    child.on("error", (error) => reject(new QueryFailed(failureOf(null, String(error)))));
    child.on("close", resolve);
  });
  let answer: unknown;
  try {
    answer = JSON.parse(stdout);
  } catch {
    throw new QueryFailed(failureOf(code, stderr));
  }
  const failure = failureIn(answer);
  if (failure) throw new QueryFailed(failure);
  return answer;
}

function start(program: string, words: readonly string[], env: NodeJS.ProcessEnv): ChildProcess {
  // Without a shell, and without a terminal: nothing is asked for there.
  return spawn(program, [...words], {
    env,
    cwd: vscode.workspace.workspaceFolders?.[0]?.uri.fsPath,
    stdio: ["ignore", "pipe", "pipe"],
  });
}
