// Sources of loaded modules, and the template lines that made generated RAPID.

import type { Link } from "../link";
import type { LoadedPrograms, SourceOrigin } from "../messages";
import { h, say } from "../dom";

export class Sources {
  private texts = new Map<number, Promise<string>>();
  private loaded: LoadedPrograms | null = null;

  constructor(private readonly link: Link) {}

  take(loaded: LoadedPrograms): void {
    this.loaded = loaded;
    this.texts.clear();
  }

  get tasks(): readonly string[] {
    return this.loaded?.tasks.map((task) => task.task) ?? [];
  }

  modules(task: string): readonly string[] {
    return Object.keys(this.loaded?.tasks.find((own) => own.task === task)?.modules ?? {});
  }

  number(task: string, module: string): number | undefined {
    return this.loaded?.tasks.find((own) => own.task === task)?.modules[module];
  }

  /** The text of a module; rejected if it is no longer loaded. */
  text(task: string, module: string): Promise<string> {
    const number = this.number(task, module);
    if (number === undefined) return Promise.reject(new Error(`${module} is not loaded`));
    let text = this.texts.get(number);
    if (text === undefined) {
      text = this.link.ask({ do: "source", number });
      this.texts.set(number, text);
    }
    return text;
  }
}

const MOST = 8; // lines that one line of a template made, with a button each

/** The shown source: a module, or the template that made the module. */
export interface Read {
  readonly task: string;
  readonly module: string;
  /** Empty: the module itself. */
  readonly template: string;
  readonly line: number;
}

export interface OriginActions {
  module(name: string, line: number): void;
  template(name: string, line: number): void;
}

interface TemplatePlace {
  readonly text: string;
  readonly places: readonly (readonly [string, () => void])[];
  readonly more?: string;
}

export class Origins {
  private readonly text = h("span");
  private readonly more = h("span");
  readonly element = h("p", { class: "row origin", role: "note", hidden: true }, this.text, this.more);
  private readonly known = new Map<number, Promise<SourceOrigin | null>>();
  /** They stay while the program moves from line to line: one of them may have the focus. */
  private readonly buttons: HTMLButtonElement[] = [];
  private places: TemplatePlace["places"] = [];
  private shown = "";

  constructor(private readonly link: Link, private readonly sources: Sources, private readonly actions: OriginActions) {}

  /** Take newly loaded sources. */
  forget(): void {
    this.known.clear();
  }

  /** Template lines of a module; null: no template made it. */
  of(task: string, module: string): Promise<SourceOrigin | null> {
    const number = this.sources.number(task, module);
    if (number === undefined) return Promise.resolve(null);
    let found = this.known.get(number);
    if (!found) {
      found = this.link.ask({ do: "origin", number }).then((text) => JSON.parse(text) as SourceOrigin).catch(() => null);
      this.known.set(number, found);
    }
    return found;
  }

  /** Show the template's line of a line, or the lines it made. */
  async show(read: Read): Promise<void> {
    const now = this.shown = JSON.stringify(read);
    const place = read.template ? await this.made(read) : await this.maker(read);
    if (now !== this.shown) return; // another line is shown now
    this.element.hidden = !place;
    say(this.text, place?.text ?? "");
    say(this.more, place?.more ?? "");
    this.places = place?.places ?? [];
    while (this.buttons.length < this.places.length) this.more.before(this.button(this.buttons.length));
    this.buttons.forEach((button, i) => {
      button.hidden = i >= this.places.length;
      say(button, this.places[i]?.[0] ?? "");
    });
  }

  private async maker({ task, module, line }: Read): Promise<TemplatePlace | null> {
    const origin = await this.of(task, module);
    const [, template, number] = origin?.lines.find(([own]) => own === line) ?? [];
    if (!origin || template === undefined || number === undefined) return null;
    const name = `${template}, line ${number}`;
    if (!(template in origin.templates)) return { text: `Line ${line} is made by ${name} of another version`, places: [] };
    return { text: `Line ${line} is made by`, places: [[name, () => this.actions.template(template, number)]] };
  }

  private async made({ task, module, template, line }: Read): Promise<TemplatePlace> {
    // The module that was shown before comes first.
    const modules = [module, ...this.sources.modules(task).filter((own) => own !== module)];
    const found = (await Promise.all(modules.map(async (own) => ((await this.of(task, own))?.lines ?? [])
      .filter(([, name, number]) => name === template && number === line).map(([number]) => [own, number] as const)))).flat();
    if (!found.length) return { text: `Line ${line} of the template has made no line of RAPID`, places: [] };
    return {
      text: `Line ${line} of the template has made`,
      places: found.slice(0, MOST).map(([own, number]) => [`${own}, line ${number}`, () => this.actions.module(own, number)]),
      more: found.length > MOST ? `and ${found.length - MOST} more` : "",
    };
  }

  private button(place: number): HTMLElement {
    const button = h("button", { type: "button", class: "place", onclick: () => this.places[place]?.[1]() });
    this.buttons.push(button);
    return button;
  }
}
