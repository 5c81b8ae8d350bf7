// Tabs of panels, by mouse and by keyboard (arrow keys, as in the ARIA pattern).

import { h } from "./dom";
import type { Scene } from "./messages";
import type { Panel } from "./panel";

export class Tabs {
  readonly element: HTMLElement;
  private readonly buttons: HTMLButtonElement[];
  private shown: Panel | null = null;

  constructor(private readonly panels: readonly Panel[]) {
    this.buttons = panels.map((panel) =>
      h("button", {
        type: "button", role: "tab", id: `tab-${panel.id}`, "aria-controls": `panel-${panel.id}`,
        // None before the fitting ones are known: they would move under the mouse.
        hidden: true, onclick: () => this.show(panel),
      }, panel.title));
    const list = h("div", { role: "tablist", "aria-label": "Panels", onkeydown: (event) => this.key(event) },
      ...this.buttons);
    for (const panel of panels) {
      panel.element.id = `panel-${panel.id}`;
      panel.element.setAttribute("role", "tabpanel");
      panel.element.setAttribute("aria-labelledby", `tab-${panel.id}`);
      panel.element.hidden = true;
    }
    this.element = h("aside", {}, list, ...panels.map((panel) => panel.element));
    const first = panels[0];
    if (first) this.show(first);
  }

  /** Show the tabs of the subject's panels. */
  fit(kind: Scene["kind"]): void {
    const fitting = this.panels.filter((panel) => panel.kinds?.includes(kind) ?? true);
    this.panels.forEach((panel, i) => {
      const button = this.buttons[i];
      if (button) button.hidden = !fitting.includes(panel);
    });
    const first = fitting[0];
    if (first && this.shown && !fitting.includes(this.shown)) this.show(first);
  }

  private show(panel: Panel): void {
    if (this.shown === panel) return;
    const before = this.shown;
    this.shown = panel;
    this.panels.forEach((own, i) => {
      const button = this.buttons[i];
      own.element.hidden = own !== panel;
      button?.setAttribute("aria-selected", String(own === panel));
      if (button) button.tabIndex = own === panel ? 0 : -1;
    });
    before?.shown?.(false);
    panel.shown?.(true);
  }

  private key(event: Event): void {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[(event as KeyboardEvent).key];
    if (!step || !this.shown) return;
    const count = this.panels.length;
    let at = this.panels.indexOf(this.shown);
    do at = (at + step + count) % count;
    while (this.buttons[at]?.hidden);
    const panel = this.panels[at];
    if (panel) this.show(panel);
    this.buttons[at]?.focus();
  }
}
