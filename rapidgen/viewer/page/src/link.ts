// The connection to the server, re-established after a loss.

import type { PageRequest, PageReply, Request, ToPage } from "./messages";

export type Connection = "connecting" | "open" | "lost" | "refused";
type Of<T extends ToPage["type"]> = Extract<ToPage, { type: T }>;

const AGAIN = 700; // ms between two attempts

export class Link {
  private socket: WebSocket | null = null;
  private number = 0;
  private readonly listeners = new Map<string, ((message: never) => void)[]>();
  private readonly watchers: ((state: Connection) => void)[] = [];
  private readonly pending = new Map<number, (error: string, text: string) => void>();

  get isOpen(): boolean {
    return this.socket?.readyState === WebSocket.OPEN;
  }

  /** Call a function for each message of a type. */
  on<T extends ToPage["type"]>(type: T, listener: (message: Of<T>) => void): void {
    this.listeners.set(type, [...(this.listeners.get(type) ?? []), listener as (m: never) => void]);
  }

  /** Call a function when the connection is opened or lost. */
  watch(watcher: (state: Connection) => void): void {
    this.watchers.push(watcher);
  }

  /** Connect, with the token of the address if there is one. */
  async open(): Promise<void> {
    this.notify("connecting");
    const token = new URLSearchParams(location.hash.slice(1)).get("token");
    try {
      if (token !== null) {
        // The token was exchanged for a cookie; history and bookmarks do not need it.
        history.replaceState(null, "", location.pathname);
        await fetch("session", { method: "POST", body: token });
      }
      const admitted = await fetch("session");
      if (!admitted.ok) return this.notify("refused");
    } catch {
      return this.again();
    }
    const socket = new WebSocket(`ws://${location.host}/link`);
    this.socket = socket;
    socket.onopen = () => this.notify("open");
    socket.onmessage = (event) => {
      for (const message of JSON.parse(event.data as string) as ToPage[]) this.take(message);
    };
    socket.onclose = () => {
      this.socket = null;
      for (const settle of this.pending.values()) settle("the connection was lost", "");
      this.pending.clear();
      this.again();
    };
  }

  private again(): void {
    this.notify("lost");
    setTimeout(() => void this.open(), AGAIN);
  }

  private notify(state: Connection): void {
    for (const watcher of this.watchers) watcher(state);
  }

  private take(message: ToPage): void {
    if (message.type === "reply") this.settle(message);
    for (const listener of this.listeners.get(message.type) ?? []) listener(message as never);
  }

  private settle(reply: PageReply): void {
    this.pending.get(reply.id)?.(reply.error, reply.text);
    this.pending.delete(reply.id);
  }

  /** Send a request; resolves to the text of the answer. Rejected with the reason of a refusal. */
  ask(request: Request): Promise<string> {
    const id = ++this.number;
    const message: PageRequest = { id, request };
    return new Promise((resolve, reject) => {
      if (this.socket?.readyState !== WebSocket.OPEN) return reject(new Error("not connected"));
      this.pending.set(id, (error, text) => (error ? reject(new Error(error)) : resolve(text)));
      this.socket.send(JSON.stringify(message));
    });
  }
}
