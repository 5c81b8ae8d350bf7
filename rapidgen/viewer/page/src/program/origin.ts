// Where generated RAPID comes from: the template's line of a line, and the lines of a template's one.

import { h, say } from "../dom";
import type { Link } from "../link";
import type { SourceOrigin } from "../messages";
import type { Sources } from "./sources";

const MOST = 8; // lines that one line of a template made, with a button each

/** What the source is that is read: a module's, or the template's that made the module. */
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

interface Told {
  readonly text: string;
  readonly places: readonly (readonly [string, () => void])[];
  readonly more?: string;
}

export class Origins {
  private readonly text = h("span");
  private readonly more = h("span");
  readonly element = h("p", { class: "row origin", role: "note", hidden: true }, this.text, this.more);
  private readonly known = new Map<number, Promise<SourceOrigin | null>>();
  /** They stay while the program goes on from line to line: one of them may have the focus. */
  private readonly buttons: HTMLButtonElement[] = [];
  private places: Told["places"] = [];
  private shown = "";

  constructor(private readonly link: Link, private readonly sources: Sources, private readonly actions: OriginActions) {}

  /** Other sources are loaded. */
  forget(): void {
    this.known.clear();
  }

  /** What made a module; null: no template did. */
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

  /** Say where a line comes from, or what became of it. */
  async show(read: Read): Promise<void> {
    const now = this.shown = JSON.stringify(read);
    const told = read.template ? await this.made(read) : await this.maker(read);
    if (now !== this.shown) return; // another line is read by now
    this.element.hidden = !told;
    say(this.text, told?.text ?? "");
    say(this.more, told?.more ?? "");
    this.places = told?.places ?? [];
    while (this.buttons.length < this.places.length) this.more.before(this.button(this.buttons.length));
    this.buttons.forEach((button, i) => {
      button.hidden = i >= this.places.length;
      say(button, this.places[i]?.[0] ?? "");
    });
  }

  private async maker({ task, module, line }: Read): Promise<Told | null> {
    const origin = await this.of(task, module);
    const [, template, number] = origin?.lines.find(([own]) => own === line) ?? [];
    if (!origin || template === undefined || number === undefined) return null;
    const name = `${template}, line ${number}`;
    if (!(template in origin.templates)) return { text: `Line ${line} is made by ${name} of another version`, places: [] };
    return { text: `Line ${line} is made by`, places: [[name, () => this.actions.template(template, number)]] };
  }

  private async made({ task, module, template, line }: Read): Promise<Told> {
    // The module that it was come from first.
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
