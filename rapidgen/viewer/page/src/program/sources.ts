// Which modules tasks have loaded, and their texts as they are wanted.

import type { Link } from "../link";
import type { LoadedPrograms } from "../messages";

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

  /** The text of a module; rejected when it has gone. */
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
