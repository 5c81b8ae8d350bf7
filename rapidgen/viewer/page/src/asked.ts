// A control that shows what the server tells. While what a person asked with it is under way it shows
// what was asked: older news, told before the request arrived, would turn it back under the hand.

import type { Request } from "./messages";
import type { View } from "./panel";

export class Asked<T> {
  private underWay = 0;
  private told: T | undefined;

  /** `show` also hears whether a refusal is why: then it shows the value whatever is typed. */
  constructor(private readonly view: View, private readonly show: (value: T, refused: boolean) => void) {}

  /** What the server tells. */
  tell(value: T): void {
    this.told = value;
    if (!this.underWay) this.show(value, false);
  }

  /** Ask; where it is refused, show again what was told. */
  async ask(request: Request): Promise<void> {
    this.underWay += 1;
    const done = await this.view.order(request);
    this.underWay -= 1;
    if (!done && !this.underWay && this.told !== undefined) this.show(this.told, true);
  }
}
