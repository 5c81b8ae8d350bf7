// An element for each thing of a list. It stays as long as its thing does, so that what somebody types in
// it, or is about to click, is not taken away by news of others.

export interface Row<T> {
  readonly element: HTMLElement;
  /** Show what may have changed; absent: nothing may. */
  show?(item: T): void;
}

export class Rows<T> {
  private shown = new Map<string, Row<T>>();

  /** `key`: what makes a thing the same one as before. */
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
