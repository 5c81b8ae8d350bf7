// Tabs of panels, by mouse and by keyboard (as in the ARIA patterns), and the border that sets their width.
//
// All panels have the same width, so that the scene does not jump as the user goes from one to another.

import { h, remember, remembered, say } from "./dom";
import type { Scene } from "./messages";
import type { Panel } from "./panel";

const NARROWEST = 320; // px
const STEP = 24; // px that an arrow key moves the border
const WIDTH = "rapidgen.width";

export class Tabs {
  readonly element: HTMLElement;
  private readonly buttons: HTMLButtonElement[];
  private readonly fields: HTMLFieldSetElement[];
  private readonly views: HTMLElement[];
  private shown: Panel | null = null;

  constructor(private readonly panels: readonly Panel[]) {
    this.buttons = panels.map((panel) =>
      h("button", {
        type: "button", role: "tab", id: `tab-${panel.id}`, "aria-controls": `panel-${panel.id}`,
        // None before the fitting ones are known: they would move under the mouse.
        hidden: true, onclick: () => this.show(panel),
      }, panel.title));
    const list = h("div", { role: "tablist", "aria-label": "Panels", onkeydown: (event) => this.key(event as KeyboardEvent) },
      ...this.buttons);
    // A disabled fieldset disables every control in it.
    this.fields = panels.map((panel) => h("fieldset", {}, panel.element));
    this.views = panels.map((panel, i) => h("div", {
      class: "view", role: "tabpanel", id: `panel-${panel.id}`, "aria-labelledby": `tab-${panel.id}`, tabindex: 0, hidden: true,
    }, this.fields[i] ?? null));
    this.element = h("aside", { "aria-label": "Panels" }, list, ...this.views);
    this.element.prepend(this.makeBorder());
    const first = panels[0];
    if (first) this.show(first);
  }

  /** Show the tabs of the subject's panels. */
  fit(kind: Scene["kind"]): void {
    const fitting = this.panels.filter((panel) => panel.kinds?.includes(kind) ?? true);
    this.panels.forEach((panel, i) => {
      const button = this.buttons[i];
      if (!button) return;
      button.hidden = !fitting.includes(panel);
      say(button, panel.titleOf?.(kind) ?? panel.title);
    });
    const first = fitting[0];
    if (first && this.shown && !fitting.includes(this.shown)) this.show(first);
  }

  /** Enable or disable the controls of all panels that send requests. */
  enable(on: boolean): void {
    this.fields.forEach((field, i) => { field.disabled = !on && !this.panels[i]?.local; });
  }

  private show(panel: Panel): void {
    if (this.shown === panel) return;
    const before = this.shown;
    this.shown = panel;
    this.panels.forEach((own, i) => {
      const [button, view] = [this.buttons[i], this.views[i]];
      if (view) view.hidden = own !== panel;
      button?.setAttribute("aria-selected", String(own === panel));
      if (button) button.tabIndex = own === panel ? 0 : -1;
    });
    before?.shown?.(false);
    panel.shown?.(true);
  }

  private key(event: KeyboardEvent): void {
    const seen = this.panels.filter((_, i) => !this.buttons[i]?.hidden);
    const at = this.shown ? seen.indexOf(this.shown) : -1;
    const to = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: seen.length - 1 }[event.key];
    const panel = to === undefined ? undefined : seen.at(to % seen.length);
    if (!panel) return;
    event.preventDefault();
    this.show(panel);
    this.buttons[this.panels.indexOf(panel)]?.focus();
  }

  private makeBorder(): HTMLElement {
    const border: HTMLElement = h("div", {
      class: "border", role: "separator", tabindex: 0, "aria-orientation": "vertical", "aria-label": "Width of the panels",
      onpointerdown: (event) => border.setPointerCapture((event as PointerEvent).pointerId),
      onpointermove: (event) => {
        const { pointerId, clientX } = event as PointerEvent;
        if (border.hasPointerCapture(pointerId)) this.resize(innerWidth - clientX);
      },
      onkeydown: (event) => {
        const by = { ArrowLeft: STEP, ArrowRight: -STEP }[(event as KeyboardEvent).key];
        if (by === undefined) return;
        event.preventDefault();
        this.resize(this.element.offsetWidth + by);
      },
    });
    const saved = Number(remembered(WIDTH));
    if (saved) this.element.style.setProperty("--side", `${saved}px`);
    const tell = (): void => {
      border.setAttribute("aria-valuemin", String(NARROWEST));
      border.setAttribute("aria-valuemax", String(Math.max(NARROWEST, innerWidth - NARROWEST)));
      border.setAttribute("aria-valuenow", String(this.element.offsetWidth));
    };
    tell();
    new ResizeObserver(tell).observe(this.element);
    return border;
  }

  private resize(width: number): void {
    const size = Math.round(Math.min(Math.max(width, NARROWEST), innerWidth - NARROWEST));
    this.element.style.setProperty("--side", `${size}px`);
    remember(WIDTH, String(size));
  }
}
