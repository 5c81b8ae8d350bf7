// Signals by name: searched, and set if the page may.

import { h, say, Field } from "../dom";
import type { ShownSignal } from "../messages";
import type { MakePanel, View } from "../panel";

export const signalsPanel: MakePanel = (view) => {
  const rows = new Map<string, SignalRow>();
  const words = h("input", { type: "search", placeholder: "Name", "aria-label": "Search signals" });
  const body = h("tbody", {});
  const none = h("p", { class: "soft", hidden: true }, "No matching signals.");
  let commands = false;

  const filter = (): void => {
    const wanted = words.value.trim().toLowerCase();
    let found = 0;
    for (const [name, row] of rows) {
      row.element.hidden = !name.toLowerCase().includes(wanted);
      found += Number(!row.element.hidden);
    }
    none.hidden = found > 0;
    say(none, rows.size ? "No matching signals." : "This controller has no signals.");
  };
  words.addEventListener("input", filter);

  view.link.on("scene", (scene) => { commands = scene.may_command; });
  view.link.on("signals", ({ signals }) => {
    rows.clear();
    for (const signal of [...signals].sort((a, b) => a.name.localeCompare(b.name)))
      rows.set(signal.name, new SignalRow(signal, commands, view));
    body.replaceChildren(...[...rows.values()].map((row) => row.element));
    filter();
  });
  view.link.on("values", ({ values }) => {
    for (const [name, value] of Object.entries(values)) rows.get(name)?.show(value);
  });
  return {
    id: "signals", title: "Signals", kinds: ["simulation", "recording"],
    element: h("div", { class: "panel" }, h("div", { class: "row filter" }, words),
      h("table", { class: "signals" }, body), none),
  };
};

class SignalRow {
  readonly element: HTMLElement;
  private readonly control: HTMLButtonElement | Field;
  private readonly label: string;
  private now = 0;

  constructor(signal: ShownSignal, commands: boolean, view: View) {
    const set = (value: number): Promise<boolean> => view.order({ do: "signal", name: signal.name, value });
    const label = this.label = `Set ${signal.name}`;
    this.control = signal.largest === 1
      ? h("button", { type: "button", "aria-label": label, class: "lamp", disabled: !commands, onclick: () => void set(this.now ? 0 : 1) })
      : new Field({ label, disabled: !commands, commit: set });
    this.element = h("tr", {}, h("th", { scope: "row", title: signal.device }, signal.name),
      h("td", { class: "soft" }, signal.kind), h("td", {}, this.control instanceof Field ? this.control.element : this.control));
    this.show(signal.value);
  }

  show(value: number): void {
    this.now = value;
    if (this.control instanceof HTMLButtonElement) {
      say(this.control, String(value));
      this.control.setAttribute("aria-pressed", String(value !== 0));
      this.control.setAttribute("aria-label", `${this.label}, now ${value}`);
    } else {
      this.control.show(String(value));
    }
  }
}
