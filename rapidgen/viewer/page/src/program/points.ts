// Breakpoints: where they lie, how often they were reached, and what may be asked of each.

import { Asked } from "../asked";
import { h, say } from "../dom";
import type { SeenBreakpoint } from "../messages";
import type { View } from "../panel";
import { Rows, type Row } from "../rows";

export class Points {
  readonly element = h("ul", { class: "points" });
  private readonly rows: Rows<SeenBreakpoint>;

  constructor(view: View) {
    this.rows = new Rows(this.element, (point) => `${point.number} ${point.module} ${point.line}`,
      (point) => new PointRow(point, view));
  }

  show(points: readonly SeenBreakpoint[]): void {
    this.rows.show(points);
  }
}

class PointRow implements Row<SeenBreakpoint> {
  readonly element: HTMLElement;
  private readonly count = h("small", { class: "soft" });
  private readonly doubt = h("p", { class: "soft" });
  private readonly fields: Record<"condition" | "hits" | "log", HTMLInputElement>;
  private readonly wishes: Asked<SeenBreakpoint>;

  constructor({ number, task, module, line }: SeenBreakpoint, view: View) {
    // All that is written here goes out: what was written last may not have come back yet.
    const change = (): void => void this.wishes.ask({ do: "break", number, task, module, line,
      condition: this.fields.condition.value, hits: this.fields.hits.value, log: this.fields.log.value });
    const field = (hint: string): HTMLInputElement =>
      h("input", { type: "text", placeholder: hint, "aria-label": `${hint} of line ${line}`, onchange: change });
    this.wishes = new Asked(view, (point, refused) => this.write(point, refused));
    this.fields = { condition: field("Condition"), hits: field("Pass"), log: field("Tell, do not pause") };
    this.element = h("li", {},
      h("div", { class: "row" }, h("b", {}, `${module}, line ${line}`), this.count, h("span", { class: "space" }),
        h("button", { type: "button", class: "quiet", "aria-label": `Remove the breakpoint of line ${line}`,
          onclick: () => view.order({ do: "unbreak", number }) }, "×")),
      h("div", { class: "row" }, ...Object.values(this.fields)), this.doubt);
  }

  show(point: SeenBreakpoint): void {
    say(this.count, `reached ${point.count} ×`);
    say(this.doubt, point.doubt);
    this.doubt.hidden = !point.doubt;
    this.wishes.tell(point);
  }

  private write(point: SeenBreakpoint, refused: boolean): void {
    for (const [name, input] of Object.entries(this.fields) as [keyof PointRow["fields"], HTMLInputElement][])
      if (refused || document.activeElement !== input) input.value = point[name];
  }
}
