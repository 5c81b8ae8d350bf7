// Programs: their sources with pointers and breakpoints, steps, call stack, values.

import { RequestState, type View, type MakePanel } from "../panel";
import { h, say, section, Rows, type Row } from "../dom";
import type { SeenBreakpoint, Debugging, DebugCommand, Pointers, SeenPlace, SeenValue } from "../messages";
import { SourceEditor } from "../program/editor";
import { Origins, Sources } from "../program/sources";

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
  private readonly state: RequestState<SeenBreakpoint>;

  constructor({ number, task, module, line }: SeenBreakpoint, view: View) {
    // All fields are sent: the last input may not have been reported back yet.
    const change = (): void => void this.state.ask({ do: "break", number, task, module, line,
      condition: this.fields.condition.value, hits: this.fields.hits.value, log: this.fields.log.value });
    const field = (hint: string): HTMLInputElement =>
      h("input", { type: "text", placeholder: hint, "aria-label": `${hint} of line ${line}`, onchange: change });
    this.state = new RequestState(view, (point, refused) => this.write(point, refused));
    this.fields = { condition: field("Condition"), hits: field("Hit count"), log: field("Log message") };
    this.element = h("li", {},
      h("div", { class: "row" }, h("b", {}, `${module}, line ${line}`), this.count, h("span", { class: "space" }),
        h("button", { type: "button", class: "quiet", "aria-label": `Remove the breakpoint of line ${line}`,
          onclick: () => view.order({ do: "unbreak", number }) }, "×")),
      h("div", { class: "row" }, ...Object.values(this.fields)), this.doubt);
  }

  show(point: SeenBreakpoint): void {
    say(this.count, `hit ${point.count} ×`);
    say(this.doubt, point.doubt);
    this.doubt.hidden = !point.doubt;
    this.state.report(point);
  }

  private write(point: SeenBreakpoint, refused: boolean): void {
    for (const [name, input] of Object.entries(this.fields) as [keyof PointRow["fields"], HTMLInputElement][])
      if (refused || document.activeElement !== input) input.value = point[name];
  }
}

const REASONS = { breakpoint: "At a breakpoint", step: "Stepped", cursor: "At the cursor", error: "Error", pause: "Paused", time: "Paused after a time step" };
const KEYS: Record<string, DebugCommand["how"]> = { F5: "resume", F6: "pause", F10: "over", F11: "in" };

export const programPanel: MakePanel = (view) => new ProgramPanel(view);

/** Parts that a recording does not have. */
function live(element: HTMLElement): HTMLElement {
  element.classList.add("live");
  return element;
}

class ProgramPanel {
  readonly id = "program";
  readonly title = "Program";
  readonly kinds = ["simulation", "recording"] as const;
  readonly element: HTMLElement;
  private readonly sources: Sources;
  private readonly editor: SourceEditor;
  private readonly origins: Origins;
  private task = "";
  private module = "";
  private template = ""; // instead of the module that it has made
  private opening = Promise.resolve(); // the text of what is to be read
  private level = -1;
  private visible = false;
  private pointers: Pointers | null = null;
  private debugging: Debugging | null = null;
  private readonly covered = new Map<number, Readonly<Record<string, number>>>();
  private expressions: string[] = [];

  private readonly tasks = h("select", { "aria-label": "Task", onchange: () => this.choose(this.tasks.value) });
  private readonly templates = h("optgroup", { label: "Templates" });
  private readonly modules = h("select", { "aria-label": "Module", onchange: () => {
    this.follow.checked = false;
    void this.read(this.modules.value, 1);
  } });
  private readonly follow = h("input", { type: "checkbox", id: "follow", checked: true, onchange: () => this.point(true) });
  private readonly go = h("button", { type: "button", class: "primary", title: "F5, F6",
    onclick: () => this.drive(this.debugging?.halt ? "resume" : "pause") }, "Pause");
  private readonly steps = (["over", "in", "out"] as const).map((how) =>
    h("button", { type: "button", "data-step": how, title: { over: "F10", in: "F11", out: "Shift F11" }[how],
      onclick: () => this.drive(how) }, { over: "Step over", in: "Step in", out: "Step out" }[how]));
  private readonly cursor = h("button", { type: "button", onclick: () => this.view.order(
    { do: "run-to", task: this.task, module: this.module, line: this.editor.line }) }, "Run to cursor");
  private readonly errors = h("select", { "aria-label": "Pause at errors", onchange: () => void this.pauses.ask(
    { do: "errors", errors: this.errors.value as Debugging["errors"] }) },
    h("option", { value: "never" }, "Do not pause at errors"),
    h("option", { value: "unhandled" }, "Pause at unhandled errors"),
    h("option", { value: "all" }, "Pause at all errors"));
  private readonly counts = h("input", { type: "checkbox", id: "counts",
    onchange: () => void this.view.order({ do: "cover", on: this.counts.checked }).then((done) => {
      if (!done) this.counts.checked = !this.counts.checked;
    }) });
  private readonly pauses: RequestState<Debugging["errors"]>;
  private readonly halt = h("p", { class: "halt", role: "status", hidden: true });
  private readonly stack = h("ol", { class: "stack" });
  private readonly variables = h("table", { class: "values" });
  private readonly watch = h("table", { class: "values" });
  private readonly points: Points;
  private readonly output = h("pre", { class: "screen", role: "log", "aria-label": "Log points", tabindex: 0 });

  constructor(private readonly view: View) {
    const { link } = view;
    this.pauses = new RequestState(view, (errors) => { this.errors.value = errors; });
    this.points = new Points(view);
    this.sources = new Sources(link);
    this.origins = new Origins(link, this.sources, {
      module: (name, line) => void this.read(name, line),
      template: (name, line) => void this.read(name, line),
    });
    this.editor = new SourceEditor({
      moved: (line) => this.tellOrigin(line),
      toggle: (line) => this.toggle(line),
      value: (expression) => link.ask({ do: "evaluate", expression }).catch(() => null),
    });
    const added = h("input", { type: "text", placeholder: "Expression", "aria-label": "Watch an expression", maxlength: 1000 });
    const add = h("form", { class: "row", onsubmit: (event) => {
      event.preventDefault();
      if (added.value.trim()) this.watchAll([...this.expressions, added.value.trim()]);
      added.value = "";
    } }, added, h("button", {}, "Watch"));
    this.element = h("div", { class: "panel program" },
      h("div", { class: "tools" },
        h("div", { class: "row" }, this.tasks, this.modules, h("label", {}, this.follow, " Follow")),
        h("div", { class: "row commands" }, this.go, ...this.steps, this.cursor),
        this.halt),
      this.editor.element,
      this.origins.element,
      section("Call stack", this.stack),
      live(section("Values", this.variables)),
      section("Watch list", this.watch, live(add)),
      live(section("Breakpoints", this.points.element, h("div", { class: "row" }, this.errors),
        h("label", { class: "row" }, this.counts, "Count executions of lines"))),
      live(section("Log points", this.output)),
      live(h("p", { class: "soft" }, "A pause stops time and robots. Steps do not enter traps, event routines and NOSTEPIN modules; " +
        "breakpoints work there.")));
    // For any focus: an updated value removes it.
    document.addEventListener("keydown", (event) => {
      if (this.visible) this.key(event);
    });
    link.on("loaded", (loaded) => {
      this.sources.take(loaded);
      this.origins.forget();
      this.tasks.replaceChildren(...this.sources.tasks.map((name) => h("option", { value: name }, name)));
      this.choose(this.sources.tasks.includes(this.task) ? this.task : this.sources.tasks[0] ?? "");
    });
    link.on("pointers", (pointers) => {
      this.pointers = pointers;
      this.showStack();
      this.point();
    });
    link.on("debugging", (debugging) => this.showDebugging(debugging));
    link.on("held", (held) => {
      if (held.task !== this.task) return;
      this.level = held.level;
      this.variables.replaceChildren(...held.variables.map((value) => this.row(value)));
      this.expressions = held.watch.map((value) => value.name);
      this.watch.replaceChildren(...held.watch.map((value) => this.row(value, () =>
        this.watchAll(this.expressions.filter((own) => own !== value.name)))));
      this.showStack();
      this.point();
    });
    link.on("covered", ({ source, lines }) => {
      this.covered.set(source, lines);
      this.mark();
    });
    link.on("scene", () => this.covered.clear());
  }

  shown(visible: boolean): void {
    this.visible = visible;
    if (visible) this.point(true);
  }

  /** For tests: the content of the editor. */
  get seen(): SourceEditor["seen"] & { module: string; halted: number | null } {
    return { ...this.editor.seen, module: this.module, halted: this.debugging?.halt?.time ?? null };
  }

  private drive(how: DebugCommand["how"]): void {
    this.follow.checked = true;
    this.view.order({ do: "drive", how, task: this.task });
  }

  private key(event: KeyboardEvent): void {
    const how = event.key === "F11" && event.shiftKey ? "out" : KEYS[event.key];
    if (!how) return;
    event.preventDefault();
    this.drive(how);
  }

  private choose(task: string): void {
    this.task = this.tasks.value = task;
    const names = this.sources.modules(task);
    this.modules.replaceChildren(...names.map((name) => h("option", { value: name }, name)));
    if (task) this.view.order({ do: "look", task, level: -1 });
    void this.open(names.includes(this.module) ? this.module : names[0] ?? "", true).then(() => this.point(true));
  }

  /** Show a module; resolves when its text is loaded. */
  private open(module: string, again = false): Promise<void> {
    if (module && (module !== this.module || this.template || again)) this.opening = this.opened(module);
    return this.opening;
  }

  private async opened(module: string): Promise<void> {
    this.module = this.modules.value = module;
    this.template = "";
    const text = await this.sources.text(this.task, module).catch((why: Error) => `! ${why.message}`);
    if (module !== this.module || this.template) return;
    this.editor.open(text);
    this.mark();
    const origin = await this.origins.of(this.task, module);
    if (module !== this.module || this.template) return;
    this.templates.replaceChildren(...Object.keys(origin?.templates ?? {}).map((name) => h("option", { value: name }, name)));
    if (this.templates.childElementCount) this.modules.append(this.templates);
    else this.templates.remove();
    this.tellOrigin(this.editor.line);
  }

  /** Show a module, or the template of the shown one, at a line. */
  private async read(name: string, line: number): Promise<void> {
    this.follow.checked = false;
    const text = (await this.origins.of(this.task, this.module))?.templates[name];
    if (text === undefined) {
      await this.open(name);
    } else {
      this.template = this.modules.value = name;
      this.editor.open(text);
      this.mark();
    }
    this.editor.go(line);
  }

  private tellOrigin(line: number): void {
    void this.origins.show({ task: this.task, module: this.module, template: this.template, line });
  }

  private get seenTask(): Pointers["tasks"][number] | undefined {
    return this.pointers?.tasks.find((own) => own.name === this.task);
  }

  private get place(): SeenPlace | undefined {
    const stack = this.seenTask?.stack ?? [];
    return this.debugging?.halt && this.level >= 0 ? stack[this.level] : stack.at(-1);
  }

  /** Show the program pointer; `jump`: also if another place is shown and the pointer has not moved. */
  private point(jump = false): void {
    if (!this.visible) return;
    const place = this.place;
    if (place && this.follow.checked) {
      const go = jump || this.template !== "" || place.module !== this.module || this.debugging?.halt;
      void this.open(place.module).then(() => {
        // The program has continued, or another source is shown, by the time the text has arrived.
        const now = this.place;
        if (now?.module === this.module && !this.template && (go || this.editor.seen.program !== now.line)) this.editor.go(now.line);
        this.mark();
      });
    } else {
      this.mark();
    }
  }

  private mark(): void {
    const at = (place: SeenPlace | null | undefined): number | null => {
      if (!place) return null;
      if (!this.template) return place.module === this.module ? place.line : null;
      const [template, line] = place.made.split(":");
      return template === this.template ? Number(line) : null;
    };
    this.cursor.disabled = !this.debugging?.halt || this.template !== "";
    const own = this.template ? [] : this.debugging?.breakpoints.filter((point) => point.module.toLowerCase() === this.module.toLowerCase()) ?? [];
    const number = this.template ? undefined : this.sources.number(this.task, this.module);
    this.editor.mark({
      breakpoints: new Map(own.map((point) =>
        [point.line, point.log ? "log" : point.condition || point.hits ? "conditional" : "plain"])),
      program: at(this.place), motion: at(this.seenTask?.motion),
      covered: (number === undefined ? undefined : this.covered.get(number)) ?? {},
    });
  }

  private toggle(line: number): void {
    if (this.template) return this.view.notice("Set breakpoints in modules, not in templates.", "fault");
    const there = this.debugging?.breakpoints.find((point) => point.line === line && point.module === this.module);
    if (there) this.view.order({ do: "unbreak", number: there.number });
    else this.view.order({ do: "break", number: 0, task: "", module: this.module, line, condition: "", hits: "", log: "" });
  }

  private watchAll(expressions: readonly string[]): void {
    this.view.order({ do: "watch", expressions });
  }

  private showDebugging(debugging: Debugging): void {
    const before = this.debugging;
    this.debugging = debugging;
    const halt = debugging.halt;
    say(this.go, halt ? "Resume" : "Pause");
    for (const button of this.steps) button.disabled = !halt;
    this.halt.hidden = !halt;
    if (halt) {
      const place = halt.place ? `${halt.task} · ${halt.place.module}, line ${halt.place.line}` : halt.task;
      say(this.halt, [REASONS[halt.reason], place, halt.text, halt.place?.made].filter(Boolean).join(" · "));
      if (halt.task && halt.task !== this.task && halt !== before?.halt) this.choose(halt.task);
    }
    this.pauses.report(debugging.errors);
    this.points.show(debugging.breakpoints);
    say(this.output, debugging.output.join("\n"));
    this.point();
  }

  private showStack(): void {
    const stack = this.seenTask?.stack ?? [];
    const chosen = this.debugging?.halt ? this.level : -1;
    this.stack.replaceChildren(...stack.map((place, i) => {
      const where = `${place.module}, line ${place.line}${place.level === "program" ? "" : ` · ${place.level}`}`;
      return h("li", {}, h("button", {
        type: "button", class: "quiet", "aria-pressed": String(i === chosen), title: place.made,
        onclick: () => {
          this.follow.checked = true;
          this.view.order({ do: "look", task: this.task, level: i });
          this.level = i;
          this.point();
        },
      }, h("b", {}, place.routine), ` ${where}`));
    }).reverse());
  }

  private row(value: SeenValue, remove?: () => void): HTMLElement {
    const text = value.settable
      ? h("input", { type: "text", value: value.text, "aria-label": `Value of ${value.name}`, onchange: () =>
          void this.view.link.ask({ do: "assign", target: value.name, value: text instanceof HTMLInputElement ? text.value : "" })
            .catch((why: Error) => {
              if (text instanceof HTMLInputElement) text.value = value.text;
              this.view.notice(why.message, "fault");
            }) })
      : h("span", { class: "soft" }, value.text);
    return h("tr", {}, h("th", { scope: "row", title: value.kind }, value.name), h("td", {}, text),
      remove ? h("td", { class: "live" }, h("button", { type: "button", class: "quiet", "aria-label": `Do not watch ${value.name}`, onclick: remove }, "×")) : null);
  }
}
