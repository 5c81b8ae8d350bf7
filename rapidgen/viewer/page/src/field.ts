// A figure that can be typed. It shows the reported value except while somebody types, so that a key never
// starts from a value that was typed before, refused, or has become old.

import { h } from "./dom";

export interface FieldOptions {
  readonly label: string;
  readonly disabled?: boolean;
  /** Send what was typed; false: it was refused. */
  commit(value: number): Promise<boolean>;
  /** Called for the keys up (1) and down (-1); absent: they change the value as the browser does. */
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

  /** Show the reported value, unless somebody types. */
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
