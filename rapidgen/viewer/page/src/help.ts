// Help: the keys of the page, and a hint on first use.

import { h, remember, remembered } from "./dom";
import type { Scene } from "./messages";

/** Keys by place; docs/use/view.md has the same table. */
export const KEYS: readonly (readonly [place: string, keys: string, action: string])[] = [
  ["Everywhere", "?", "Show or close this help"],
  ["Everywhere", "F8", "Stop the program"],
  ["Everywhere", "Tab, Shift Tab", "Next, previous control"],
  ["Tabs", "Left, Right, Home, End", "Previous, next, first, last tab"],
  ["Border of the panels", "Left, Right", "Wider, narrower panels"],
  ["3D view", "Arrow keys", "Pan"],
  ["Jog: slider or number", "Up, Down", "One step forward, backward"],
  ["Jog: number", "Enter, Esc", "Go there, restore the value"],
  ["Program", "F5, F6", "Resume, pause"],
  ["Program", "F10, F11, Shift F11", "Step over, into, out"],
  ["Program: source", "F9", "Set or remove a breakpoint"],
];

const HINTS: Record<Scene["kind"], readonly string[]> = {
  simulation: [
    "Drag to turn the view, use the wheel to zoom.",
    "Stop the program before you move the robot in the tab Jog, or with “Drag TCP”.",
    "Drop a trajectory (CSV or JSON) on the page to check and execute it.",
  ],
  robot: ["Drag to turn the view, use the wheel to zoom.", "The page only reads the real robot: nothing here moves it."],
  recording: ["Drag to turn the view, use the wheel to zoom.", "Press Play, or move the slider in the tab Recording."],
};
const SEEN = "rapidgen.hint";

export class Help {
  readonly button: HTMLElement;
  readonly dialog: HTMLDialogElement;
  /** The hint on first use; hidden once it was closed. */
  readonly hint = h("div", { class: "hint", role: "note", "aria-label": "First use", hidden: true });

  constructor() {
    const rows = KEYS.map(([place, keys, action]) =>
      h("tr", {}, h("th", { scope: "row" }, place), h("td", {}, h("kbd", {}, keys)), h("td", {}, action)));
    this.dialog = h("dialog", { "aria-labelledby": "help-title" },
      h("h2", { id: "help-title" }, "Keyboard"),
      h("table", { class: "keys" }, h("thead", {}, h("tr", {}, ...["Where", "Keys", "Action"].map((text) => h("th", { scope: "col" }, text)))),
        h("tbody", {}, ...rows)),
      h("form", { method: "dialog" }, h("button", { class: "primary" }, "Close")));
    this.button = h("button", { type: "button", class: "quiet", title: "Keyboard (?)", "aria-label": "Keyboard help",
      onclick: () => this.toggle() }, "?");
    addEventListener("keydown", (event) => {
      if (event.key === "?" && !isTyping(event)) this.toggle();
    });
  }

  toggle(): void {
    if (this.dialog.open) this.dialog.close();
    else this.dialog.showModal();
  }

  /** Show the hint unless it was closed once in this browser. */
  greet(kind: Scene["kind"]): void {
    if (remembered(SEEN) !== null) return;
    this.hint.hidden = false;
    this.hint.replaceChildren(
      h("ul", {}, ...HINTS[kind].map((text) => h("li", {}, text)), h("li", {}, "Press ? for the keyboard.")),
      h("button", { type: "button", onclick: () => this.dismiss() }, "Close hint"));
  }

  private dismiss(): void {
    this.hint.hidden = true;
    remember(SEEN, "closed");
  }
}

/** True if a key belongs to the text that the user types. */
function isTyping(event: KeyboardEvent): boolean {
  const [target] = event.composedPath();
  return target instanceof HTMLElement && (target.isContentEditable || target.matches("input:not([type=range], [type=checkbox]), textarea, select"));
}
