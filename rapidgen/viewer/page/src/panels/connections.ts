// The network: connections, their data, and faults at a click.

import { RequestState, type MakePanel, type View } from "../panel";
import { h, say, section, Rows, type Row } from "../dom";
import type { PendantAction, InjectFault, ShownSocket, SocketLogLine } from "../messages";

const FAULTS: readonly (readonly [PendantAction["action"], string])[] =
  [["e-stop", "Emergency stop"], ["release-e-stop", "Release emergency stop button"], ["motors-off", "Motors off"], ["stop", "Program stop"], ["power-loss", "Power failure"]];
const AILMENTS: readonly (readonly [InjectFault["ailment"], string])[] = [["well", "No fault"], ["delay", "Delay 0.5 s"],
  ["split", "Split"], ["slow", "Slow (400 B/s)"], ["silent", "Silent"], ["half-open", "Half open"]];
const WAYS = { open: "·", in: "→", out: "←", close: "·" } as const;
const MOST = 1000; // lines that are kept

export const connectionsPanel: MakePanel = (view) => {
  const body = h("tbody", {});
  const rows = new Rows<ShownSocket>(body,
    ({ number, task, local, peer, status }) => JSON.stringify([number, task, local, peer, status]), (socket) => row(socket, view));
  const none = h("p", { class: "soft" }, "No socket is open.");
  view.link.on("connections", ({ sockets }) => {
    rows.show(sockets);
    none.hidden = sockets.length > 0;
  });
  const faults = FAULTS.map(([action, text]) =>
    h("button", { type: "button", onclick: () => view.order({ do: "act", action }) }, text));
  const log = new ProtocolLog(view);
  const element = h("div", { class: "panel" },
    section("Sockets of the program", h("table", { class: "sockets" }, body), none),
    h("div", { class: "commands" }, section("Inject a fault", h("div", { class: "row" }, ...faults))),
    log.element);
  return {
    id: "connections", title: "Network", element, kinds: ["simulation", "recording"],
  };
};

function row(socket: ShownSocket, view: View): Row<ShownSocket> {
  const ill: HTMLSelectElement = h("select", { "aria-label": `Fault of ${socket.peer}`, onchange: () =>
    void faulted.ask({ do: "inject-fault", number: socket.number, ailment: ill.value as InjectFault["ailment"] }) },
    ...AILMENTS.map(([value, text]) => h("option", { value }, text)));
  const faulted = new RequestState<InjectFault["ailment"]>(view, (ailment) => { ill.value = ailment; });
  const element = h("tr", {},
    h("th", { scope: "row" }, socket.peer || `${socket.status} on ${socket.local}`,
      h("small", {}, `${socket.task}${socket.peer ? ` · ${socket.local}` : ""}`)),
    h("td", {}, socket.peer ? h("div", { class: "row commands" }, ill,
      h("button", { type: "button", onclick: () => view.order({ do: "cut", number: socket.number }) }, "Disconnect")) : null));
  return { element, show: (now) => faulted.report(now.ailment) };
}

interface LogRow {
  line: SocketLogLine;
  count: number;
}

class ProtocolLog {
  readonly element: HTMLElement;
  private lines: SocketLogLine[] = [];
  private missed = 0;
  private readonly listen: HTMLInputElement;
  private readonly words = h("input", { type: "search", placeholder: "Filter", "aria-label": "Filter the traffic",
    oninput: () => this.draw() });
  private readonly still = h("input", { type: "checkbox" });
  private readonly list = h("ol", { class: "log data", "aria-label": "Protocol log", tabindex: 0 });
  private readonly about = h("p", { class: "soft", role: "status" });

  constructor(view: View) {
    this.listen = h("input", { type: "checkbox", onchange: () => void listens.ask({ do: "listen", on: this.listen.checked }) });
    const listens = new RequestState<boolean>(view, (on) => { this.listen.checked = on; });
    this.element = section("Traffic",
      h("div", { class: "row" }, h("label", { class: "row" }, this.listen, "Capture"),
        h("label", { class: "row" }, this.still, "Freeze"), this.words,
        h("button", { type: "button", onclick: () => this.clear() }, "Clear")),
      this.about, this.list);
    view.link.on("conversation", ({ listening, lines, missed, fresh }) => {
      listens.report(listening);
      this.lines = [...(fresh ? [] : this.lines), ...lines].slice(-MOST);
      this.missed = fresh ? 0 : this.missed + (missed ?? 0);
      if (!this.still.checked) this.draw();
    });
  }

  private clear(): void {
    this.lines = [];
    this.missed = 0;
    this.draw();
  }

  /** The latest first; repeated lines are one row. */
  private draw(): void {
    const wanted = this.words.value.trim().toLowerCase();
    const rows: LogRow[] = [];
    const runs = new Map<string, { way: string; rows: Map<string, LogRow> }>();
    for (const line of this.lines) {
      if (wanted && !`${line.name} ${line.text} ${line.task} ${line.peer}`.toLowerCase().includes(wanted)) continue;
      const who = `${line.task} ${line.peer}`;
      let run = runs.get(who);
      if (!run || run.way !== line.way || !line.name) runs.set(who, run = { way: line.way, rows: new Map() });
      const same = run.rows.get(line.name);
      if (same) {
        same.line = line;
        same.count += 1;
      } else {
        const row = { line, count: 1 };
        run.rows.set(line.name, row);
        rows.push(row);
      }
    }
    rows.sort((a, b) => b.line.time - a.line.time);
    this.list.replaceChildren(...rows.slice(0, 200).map(({ line, count }) => h("li", { "data-kind": line.fault ? "error" : "info" },
      h("div", { class: "event" }, h("code", {}, line.time.toFixed(3)),
        h("span", {}, `${WAYS[line.way]} ${line.name || (line.way === "in" || line.way === "out" ? "bytes" : line.text)}${count > 1 ? ` ×${count}` : ""}`),
        h("small", {}, `${line.task} ${line.way === "out" ? "to" : "from"} ${line.peer}`)),
      line.way === "in" || line.way === "out" ? h("p", {}, line.text) : null)));
    say(this.about, this.missed ? `${this.missed} messages are not shown: they came too fast.` : "");
  }
}
