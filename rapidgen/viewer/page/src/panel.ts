// Interface between the page and its panels.

import type { Link } from "./link";
import type { Request, Scene } from "./messages";
import type { Stage } from "./stage/stage";

/** Services of the page for a panel. */
export interface View {
  readonly link: Link;
  /** The scene with the robots; null without WebGL. */
  readonly stage: Stage | null;
  /** Send a request and show the reason of a rejection; resolves to whether it was done. */
  order(request: Request): Promise<boolean>;
  /** Show a short message. */
  notice(text: string, kind?: "plain" | "fault"): void;
}

/** A tab next to the scene. */
export interface Panel {
  readonly id: string;
  readonly title: string;
  /** Another title for a kind of subject. */
  titleOf?(kind: Scene["kind"]): string | undefined;
  /** True if no control sends a request: then all of them work without a connection. */
  readonly local?: boolean;
  readonly element: HTMLElement;
  /** Subjects that have this panel; absent: all. */
  readonly kinds?: readonly Scene["kind"][];
  /** Called when the tab is shown and hidden: a hidden one need not be updated. */
  shown?(visible: boolean): void;
}

export type MakePanel = (view: View) => Panel;

/**
 * A control that shows the server's value. During a request it shows the requested value instead: a message
 * sent before the request arrived would reset the control.
 */
export class RequestState<T> {
  private underWay = 0;
  private reported: T | undefined;

  /** `show` receives whether a rejection is the reason: then it replaces typed text too. */
  constructor(private readonly view: View, private readonly show: (value: T, refused: boolean) => void) {}

  /** Take the server's value. */
  report(value: T): void {
    this.reported = value;
    if (!this.underWay) this.show(value, false);
  }

  /** Send a request; after a rejection show the server's value again. */
  async ask(request: Request): Promise<void> {
    this.underWay += 1;
    const done = await this.view.order(request);
    this.underWay -= 1;
    if (!done && !this.underWay && this.reported !== undefined) this.show(this.reported, true);
  }
}
