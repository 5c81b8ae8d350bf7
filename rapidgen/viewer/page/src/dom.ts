// Elements made of data, lists of them, and number fields. Texts become text nodes, never HTML: names of
// robots, signals and events are untrusted.

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

/** Set the text of an element if it differs. */
export function say(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

/** A value that this browser has stored; null: none, or storage is switched off. */
export function remembered(key: string): string | null {
  try {
    return localStorage.getItem(key);
  } catch {
    return null;
  }
}

/** Store a value in this browser, if it permits. */
export function remember(key: string, value: string): void {
  try {
    localStorage.setItem(key, value);
  } catch {
    // Storage is switched off: the choice lasts as long as the page.
  }
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

export interface Row<T> {
  readonly element: HTMLElement;
  /** Show changed data; absent: it never changes. */
  show?(item: T): void;
}

export class Rows<T> {
  private shown = new Map<string, Row<T>>();

  /** `key` identifies an item across updates. */
  constructor(private readonly parent: HTMLElement, private readonly key: (item: T) => string,
    private readonly make: (item: T) => Row<T>) {}

  show(items: readonly T[]): void {
    const before = this.shown;
    this.shown = new Map(items.map((item) => {
      const key = this.key(item);
      return [key, before.get(key) ?? this.make(item)];
    }));
    for (const [key, row] of before) if (!this.shown.has(key)) row.element.remove();
    [...this.shown.values()].forEach((row, i) => {
      const there = this.parent.children[i] ?? null;
      if (there !== row.element) this.parent.insertBefore(row.element, there);
    });
    for (const item of items) this.shown.get(this.key(item))?.show?.(item);
  }
}

export interface FieldOptions {
  readonly label: string;
  readonly disabled?: boolean;
  /** Send the typed value; false: it was refused. */
  commit(value: number): Promise<boolean>;
  /** Called for the keys up (1) and down (-1); absent: the browser changes the value. */
  step?(direction: 1 | -1): void;
}

export class Field {
  readonly element: HTMLInputElement;
  private reported = "";
  private typing = false;

  constructor(options: FieldOptions) {
    this.element = h("input", {
      type: "number", step: "any", "aria-label": options.label, disabled: options.disabled === true,
      oninput: () => { this.typing = true; },
      onchange: () => void this.send(options),
      onblur: () => this.restore(),
      onkeydown: (event) => this.key(event as KeyboardEvent, options),
    });
  }

  /** Show the reported value, unless the user is typing. */
  show(text: string): void {
    this.reported = text;
    if (!this.typing) this.element.value = text;
  }

  private restore(): void {
    this.typing = false;
    this.element.value = this.reported;
  }

  private async send(options: FieldOptions): Promise<void> {
    this.typing = false;
    const value = this.element.value.trim() === "" ? NaN : Number(this.element.value);
    if (!Number.isFinite(value) || !(await options.commit(value))) this.restore();
  }

  private key(event: KeyboardEvent, { step }: FieldOptions): void {
    if (event.key === "Escape") return this.restore();
    const direction = event.key === "ArrowUp" ? 1 : event.key === "ArrowDown" ? -1 : 0;
    if (!direction || !step) return;
    event.preventDefault();
    this.restore();
    if (!event.repeat) step(direction);
  }
}
