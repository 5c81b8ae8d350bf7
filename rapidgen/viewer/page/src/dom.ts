// Elements made of data. Texts become text nodes, never HTML: names of robots, signals and events are
// written by anybody.

type Child = Node | string | null;
type Properties = Record<string, string | number | boolean | ((event: Event) => void)>;

/** An element: `onclick` and the like are listeners, the rest are attributes (true: without a value). */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  properties: Properties = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (typeof value === "function") element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false) element.setAttribute(name, String(value));
  }
  element.append(...children.filter((child) => child !== null));
  return element;
}

/** Set the text of an element, where it differs. */
export function say(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

/** A section of a panel, with its heading. */
export function section(title: string, ...children: Child[]): HTMLElement {
  return h("section", {}, h("h2", {}, title), ...children);
}

/** Buttons of which one is chosen. */
export class Choice<T extends string> {
  readonly element: HTMLElement;
  private readonly buttons = new Map<T, HTMLButtonElement>();

  constructor(label: string, choices: readonly (readonly [T, string])[], chosen: (value: T) => void) {
    this.element = h("div", { class: "choice", role: "group", "aria-label": label });
    for (const [value, text] of choices) {
      const button = h("button", { type: "button", onclick: () => chosen(value) }, text);
      this.buttons.set(value, button);
      this.element.append(button);
    }
  }

  show(value: T | null): void {
    for (const [own, button] of this.buttons) button.setAttribute("aria-pressed", String(own === value));
  }
}
