// The event log with ABB's numbers.

import { h, say } from "../dom";
import type { LogEntry } from "../messages";
import type { MakePanel } from "../panel";

const KEPT = 1000;

export const logPanel: MakePanel = ({ link }) => {
  const list = h("ol", { class: "log" });
  const words = h("input", { type: "search", placeholder: "Number or text", "aria-label": "Filter the log" });
  const least = h("select", { "aria-label": "Minimum severity" },
    h("option", { value: 0 }, "All events"), h("option", { value: 1 }, "Warnings"), h("option", { value: 2 }, "Errors"));
  const none = h("p", { class: "soft" }, "No events.");
  const known = new Map<number, { entry: LogEntry; element: HTMLElement }>();

  const fits = (entry: LogEntry): boolean => {
    const weight = { info: 0, warning: 1, error: 2 }[entry.kind];
    const text = `${entry.code} ${entry.title} ${entry.texts.join(" ")} ${entry.task}`.toLowerCase();
    return weight >= Number(least.value) && text.includes(words.value.trim().toLowerCase());
  };
  const tell = (): void => {
    none.hidden = [...known.values()].some(({ element }) => !element.hidden);
    say(none, known.size ? "No matching events." : "No events.");
  };
  const filter = (): void => {
    for (const { entry, element } of known.values()) element.hidden = !fits(entry);
    tell();
  };
  words.addEventListener("input", filter);
  least.addEventListener("change", filter);

  link.on("scene", () => {
    known.clear();
    list.replaceChildren();
  });
  link.on("log", ({ entries, fresh }) => {
    if (fresh) {
      known.clear();
      list.replaceChildren();
    }
    for (const entry of entries) {
      if (known.has(entry.sequence)) continue;
      const element = row(entry);
      element.hidden = !fits(entry);
      known.set(entry.sequence, { entry, element });
      list.prepend(element);
    }
    while (known.size > KEPT) {
      const [oldest] = known.keys();
      if (oldest === undefined) break;
      known.get(oldest)?.element.remove();
      known.delete(oldest);
    }
    tell();
  });
  return {
    id: "log", title: "Log", local: true,
    element: h("div", { class: "panel" }, h("div", { class: "row filter" }, words, least), none, list),
  };
};

function row(entry: LogEntry): HTMLElement {
  const head = h("div", { class: "event" },
    h("code", {}, String(entry.code)), h("span", {}, entry.title),
    h("small", {}, `${entry.time.toFixed(2)} s${entry.task ? ` · ${entry.task}` : ""}`));
  const texts = entry.texts.filter((text) => text !== "");
  return h("li", { "data-kind": entry.kind }, head,
    texts.length ? h("p", {}, texts.join("\n")) : null);
}
